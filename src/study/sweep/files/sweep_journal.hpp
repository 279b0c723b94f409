// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "study/sweep/block.hpp"

namespace trueaxis {

/// What is finished of a sweep, on disk: a head with the hash of the sweep and the build that began
/// it, then one record a block with a checksum of its own, only ever appended. A process that is
/// killed at any instant leaves at most one torn record at the end, which the next one takes off.
class SweepJournal {
 public:
  /// Opens or begins journal.bin in `folder`, which is there, and reads what is finished.
  /// @throws InputError for a journal of another sweep or build, one that another process is
  ///         writing, and a folder that cannot be written.
  SweepJournal(const std::string& folder, const study::Sweep& sweep);
  ~SweepJournal();
  SweepJournal(const SweepJournal&) = delete;
  SweepJournal& operator=(const SweepJournal&) = delete;

  /// Finished blocks, each once; taken over by the caller.
  std::vector<study::BlockResult> take_finished();
  /// On disk when it returns, as far as the process is concerned. @throws InputError.
  void append(const study::BlockResult& result);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// A result as bytes (CBOR), and back. @throws InputError for bytes that are not a journal.
std::string encode(const study::BlockResult& result);
study::BlockResult decode(std::string_view bytes);

/// Blocks of the sweep that are not among `finished`.
std::vector<study::Block> blocks_to_do(const study::Sweep& sweep,
                                       const std::vector<study::BlockResult>& finished);

}  // namespace trueaxis

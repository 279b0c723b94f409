// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "trueaxis/probe_stream.hpp"

namespace trueaxis {

/// A stream while it arrives. All readings are kept up to `most`; from then on every second of
/// those that are there is dropped, and of the new ones as many, so that the memory stays.
class LiveStream {
 public:
  explicit LiveStream(std::size_t most);

  /// The next readings, of one and the same recording: C goes on.
  void add(ProbeStream next);

  const ProbeStream& kept() const { return kept_; }
  std::size_t readings() const { return readings_; }  ///< that arrived
  std::size_t stride() const { return stride_; }      ///< 1: nothing was thinned
  /// At most `count` of those that are kept, spread evenly, but at no period of the sampling.
  ProbeStream sample(std::size_t count) const;

 private:
  void take(const ProbeStream& next, std::size_t row);

  ProbeStream kept_;
  std::size_t most_, readings_ = 0, stride_ = 1;
};

}  // namespace trueaxis

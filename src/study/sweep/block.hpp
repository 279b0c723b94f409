// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "study/bound/bound.hpp"
#include "study/sweep/sweep.hpp"

namespace trueaxis::study {

/// Repeats of one cell that are run together: the unit of work, of the journal and of a message.
struct Block {
  std::size_t cell = 0, first_repeat = 0, count = 0;
  bool operator==(const Block&) const = default;
};

/// All of a sweep's work, cell by cell; how it is cut does not depend on who does it.
std::vector<Block> blocks_of(const Sweep& sweep);

/// What does not depend on the repeat.
struct CellFacts {
  std::size_t readings = 0;
  std::vector<double> truth;  ///< of quantities(); where numbers are drawn, at their middles
  Bound bound;                ///< where numbers are drawn, root mean square over the first repeats
  /// Of every quantity's mean square bound: its variance over its square, as far as it comes from
  /// the draws; NaN of a single draw, empty where nothing is drawn.
  std::vector<double> bound_spread{};
  /// Of a diagnosis: effects that change the clean readings (where numbers are drawn, of repeat 0);
  /// one of size 0 hides nothing.
  std::uint64_t hidden = 0;
};

struct BlockResult {
  Block block;
  std::size_t quantities = 0;
  std::vector<double> error, u;  ///< count × quantities: estimate − truth; NaN: not determined
  std::size_t failures = 0;      ///< repeats without a stream or a converged fit
  std::vector<std::uint8_t> found;  ///< diagnosis: 1 something was found, 2 all that was hidden is
                                    ///< in the class of a cause, 3 both; else empty
  std::vector<CellFacts> facts;     ///< one in the block of repeat 0, else none
  std::string why;                  ///< of the first repeat that failed
  double seconds = 0.0;             ///< of one thread; no part of the result
};

/// Runs blocks one after the other; what the repeats of a cell share is prepared once for all
/// blocks of it that follow each other. The sweep must outlive it.
class Worker {
 public:
  explicit Worker(const Sweep& sweep);
  ~Worker();
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;
  /// A function of sweep and block alone: who runs a block, and when, does not show.
  BlockResult run(const Block& block);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Runs blocks on `threads` threads (0: as many as there are), in about their order; `finished` is
/// called for each as it is done, one call at a time. What it throws, or a block throws, ends the
/// run and is thrown again.
void run_blocks(const Sweep& sweep, std::span<const Block> blocks, int threads,
                const std::function<void(BlockResult&&)>& finished);

}  // namespace trueaxis::study

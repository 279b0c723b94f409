// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <span>

#include "study/sweep/block.hpp"

namespace trueaxis::study {

/// Runs blocks on `threads` threads (0: as many as there are), in about their order; `finished` is
/// called for each as it is done, one call at a time. What it throws, or a block throws, ends the
/// run and is thrown again.
void run_blocks(const Sweep& sweep, std::span<const Block> blocks, int threads,
                const std::function<void(BlockResult&&)>& finished);

}  // namespace trueaxis::study

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "study/sweep/block.hpp"

namespace trueaxis::mpi {

/// Rank 0: hands blocks to the ranks as they finish what they have, runs some itself on a thread of
/// its own, and calls `finished` for each on the calling thread. At the end the others are let go.
void distribute(const study::Sweep& sweep, const std::vector<study::Block>& blocks,
                const std::function<void(study::BlockResult&&)>& finished);

/// The other ranks: runs what rank 0 sends until it lets go.
void serve(const study::Sweep& sweep);

/// What rank 0 gives, on all ranks: the hash of the sweep, or nothing when there is none to run.
std::string agree_on(std::string of_rank_0);

}  // namespace trueaxis::mpi

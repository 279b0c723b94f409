// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "trueaxis/inference.hpp"

namespace trueaxis::infer {

/// Sums of squares of a block that was left out, predicted by two models, and its readings.
struct HeldOutBlock {
  double before = 0.0, after = 0.0, rows = 0.0;
};

/// States the root mean squares of all blocks, with intervals of 95 % by the percentiles of 999
/// resamplings of whole blocks (block bootstrap, Efron and Tibshirani 1993; Eq. 101).
void cross_validate(std::span<const HeldOutBlock> blocks, Explained& out);

}  // namespace trueaxis::infer

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "infer/gram.hpp"
#include "trueaxis/inference.hpp"

namespace trueaxis::infer {

/// A block of readings for cross-validation: its Gram matrix, and mm² that its squares are over.
struct Fold {
  Eigen::MatrixXd gram;
  double rows = 0.0, unit2 = 1.0;
};

/// What two models predict of blocks, each excluded in turn (Eq. 82). States the root mean squares
/// of all blocks, with intervals of 95 % by the percentiles of 999 resamplings of whole blocks
/// (block bootstrap, Efron and Tibshirani 1993; Eq. 101). @param total Gram matrix of all blocks
void cross_validate(const Eigen::MatrixXd& total, std::span<const Fold> folds,
                    const Columns& before, const Columns& after, Explained& out);

}  // namespace trueaxis::infer

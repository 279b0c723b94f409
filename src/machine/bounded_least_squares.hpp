// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

namespace trueaxis {

using SmallMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 3, 6>;
using SmallVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 6, 1>;

/// The y with |yᵢ| ≤ bound_i (infinite: none) that makes |M y + c| least, and of those the one with
/// the least |y|. The problem is convex: where the free minimum is outside, every choice of
/// variables on their bounds is tried and the least that stays within is the answer.
SmallVector bounded_least_squares(const SmallMatrix& M, const Eigen::Vector3d& c,
                                  const SmallVector& bound);

}  // namespace trueaxis

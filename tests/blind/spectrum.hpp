// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Dense>
#include <vector>

namespace trueaxis::blind {

/// Frequencies to look at, radians per unit of the coordinate.
struct Band {
  double low, high;
};

/// The strongest lines |Σ v exp(−i(w x + offset))| of `values` over the coordinate x, strongest
/// first, at least a bin 2π/(range of x) apart; bins are an eighth of that.
std::vector<double> strongest_lines(const Eigen::VectorXd& values, const Eigen::VectorXd& x,
                                    const Eigen::VectorXd& offset_rad, Band band, std::size_t most);

}  // namespace trueaxis::blind

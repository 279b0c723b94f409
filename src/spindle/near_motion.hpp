// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Dense>
#include <vector>

namespace trueaxis {

inline constexpr double standing_out = 16.0;  // of the median power: noise does so in 1 of 65 000
inline constexpr double least_away = 3.0;     // nearer lines may be the order's own skirts

/// A line of the spectrum next to an order, `away` in lines.
struct NearLine {
  Eigen::VectorXcd at;
  double away;  ///< towards higher orders
};

/// A motion of one frequency less than `least_away` lines off an order: as nₓ = n + x/K it reads
/// like the order, and what the order has not taken of it is in the lines next to it.
struct NearMotion {
  Eigen::VectorXcd in_order;    ///< what the order has taken of it; empty: there is none
  Eigen::MatrixXcd covariance;  ///< of that
};

/// The motion that explains the lines, if their power is far above the others', averaged over where
/// it may lie (Eq. 143a). The lines keep what they have without it.
NearMotion take_motion(std::vector<NearLine>& near);

}  // namespace trueaxis

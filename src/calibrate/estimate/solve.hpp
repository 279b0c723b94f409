// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "calibrate/estimate/determined.hpp"
#include "calibrate/estimate/problem.hpp"

namespace trueaxis::calibrate_detail {

/// The least squares estimate of what is determined, and of every place.
struct Solution {
  bool converged = false;
  std::string message;
  Determined determined;
  Eigen::VectorXd unknowns;  ///< mm and rad; 0 of those that are held
  Eigen::VectorXd places;
  Eigen::VectorXd residuals;  ///< over σ
  Eigen::MatrixXd jacobian;   ///< over σ: the kept unknowns per largest size, then the places
  double variance = 1.0;      ///< of a residual over its σ
  double freedom = 0.0;
};

/// Which unknowns the start tells, then Levenberg-Marquardt through the exact chain (Eq. 176).
Solution solve(const Problem& problem, const ErrorModel& given,
               const std::vector<Unknown>& unknowns);

/// The places that fit best when the machine has `errors`: what is known before.
Eigen::VectorXd best_places(const Problem& problem, const ErrorModel& errors);

/// Columns of the kept unknowns and the places at a point, over σ.
Eigen::MatrixXd weighted_jacobian(const Problem& problem, const ErrorModel& errors,
                                  const std::vector<Unknown>& kept, const Eigen::VectorXd& places);

/// Divides every equation by the σ of its row.
void weigh(const Problem& problem, Eigen::MatrixXd& columns);

}  // namespace trueaxis::calibrate_detail

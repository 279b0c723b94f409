// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

namespace trueaxis::calibrate_detail {

/// Random columns that follow each other: normal, of variance (t s)² share each.
struct RandomGroup {
  double size = 0.0;       ///< s
  Eigen::VectorXd shares;  ///< one a column
  bool known = false;      ///< t is 1; else it is log-normal
};

/// How the sizes of groups spread: ln t of every group about a number that all have, that about 0.
struct SizeSpread {
  double group = 2.0, all = 3.0;  ///< factors within which two in three lie
};

struct RandomEffects {
  Eigen::VectorXd fixed;       ///< change of the fixed columns' coefficients
  Eigen::VectorXd random;      ///< of the random columns
  Eigen::MatrixXd covariance;  ///< of both, the fixed ones first
  std::vector<double> times;   ///< t of every group
  double times_all = 1.0;      ///< about which they lie
  double variance = 1.0;       ///< φ: of a residual over its σ
};

/// Regression of residuals r = F x + R a + e with x free, a random and e of variance φ (Eqs.
/// 211-214): mean of x and a together at the most probable t and φ, and the covariance, in which t
/// is uncertain (Eq. 334). φ is 1, or what the residuals show if that is more; what they show where
/// no noise was stated.
RandomEffects regress(const Eigen::VectorXd& residuals, const Eigen::MatrixXd& fixed,
                      const Eigen::MatrixXd& random, const std::vector<RandomGroup>& groups,
                      bool noise_stated, const SizeSpread& spread = {});

}  // namespace trueaxis::calibrate_detail

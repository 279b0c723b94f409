// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Dense>
#include <vector>

#include "diagnose/regression/normal_equations.hpp"
#include "infer/fitted.hpp"

namespace trueaxis::diagnose_detail {

/// Surface and terms fitted together, about the point; and what each question of the report needs.
/// Eqs. 54, 83.
struct Joint {
  NormalEquations equations;
  std::vector<Columns> places;  ///< of every term
  Solution solution;            ///< base, then terms
  double sigma_mm = 0.0;        ///< of the innovations: √(RSS/ν)

  Joint(const Problem& problem, const std::vector<double>& phi, std::vector<Hypothesis> hypotheses,
        std::size_t fitted, bool blocks = false);

  /// Coefficients and covariance of the base alone (x, y, slopes at mid length of every axis …).
  Eigen::VectorXd base() const;
  Eigen::MatrixXd base_covariance() const;
  /// Coefficients of a term, and what it does to X, one entry a reading, mm.
  Eigen::VectorXd of(std::size_t term) const;
  std::vector<double> contribution_of(std::size_t term) const;
  Solution without(std::size_t term) const { return solve(equations.total(), besides(term)); }
  /// Columns of the base and of the fitted terms but one.
  Columns besides(std::size_t but = infer::none) const {
    return infer::besides(equations.base(), {places.data(), fitted}, but);
  }

  std::vector<Hypothesis> terms;
  std::size_t fitted;  ///< how many of the terms are in the solution; the others are outside it
};

/// Largest distance over the probed length between two positions of the last axis, and its u; from
/// the change of its four base coefficients and their covariance.
struct AxisShift {
  double value_mm = 0.0, u_mm = 0.0;
};
/// Eq. 85.
AxisShift axis_shift(const LinearisationPoint& point, const Eigen::VectorXd& change,
                     const Eigen::MatrixXd& covariance);

/// Covariance of the base where x, y of the last axis at both ends of the probed length are each
/// known to u_mm, and independent.
Eigen::MatrixXd covariance_of_ends(const LinearisationPoint& point, Eigen::Index base, double u_mm);

/// Largest standard uncertainty of the last axis over the probed length, in its worse direction,
/// and the root mean square of its distance from the true one.
struct AxisUncertainty {
  double u_mm = 0.0, rms_mm = 0.0;
};
AxisUncertainty axis_uncertainty(const LinearisationPoint& point,
                                 const Eigen::MatrixXd& base_covariance);

}  // namespace trueaxis::diagnose_detail

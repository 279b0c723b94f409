// SPDX-License-Identifier: Apache-2.0
#include "calibrate/diagnose/uncertain.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "math/covariance.hpp"
#include "math/linear_algebra.hpp"

namespace trueaxis::calibrate_detail {

using Eigen::Index;
using Eigen::MatrixXd;

std::vector<UncertainParameter> uncertain_of(const TipFit& fit, const MachineDiagnosis& found,
                                             const MachineDiagnoseOptions& options) {
  std::vector<UncertainParameter> out;
  for (const Unknown& one : fit.unknowns) out.push_back({one.name, one.unit, one.largest});
  const auto unit_of = [](ErrorTerm term, double size) {
    term.function = scaled(term.function, 1.0 / size);
    return term;
  };
  for (const MachineFinding& finding : found.findings)
    for (std::size_t k = 0; k < finding.errors.size(); ++k) {
      const double value = finding.parameters[k].estimate.value;
      if (value == 0.0) continue;
      out.push_back({finding.effect(), unit_of(finding.errors[k], value),
                     finding.errors[k].name.angular() ? options.calibration.largest_angle_rad
                                                      : options.calibration.largest_length_mm});
    }
  for (const MachineNotObservable& one : found.not_observable)
    for (const ErrorTerm& term : one.errors)
      out.push_back({one.effect, term,
                     term.name.angular() ? options.typical_angle_rad : options.typical_length_mm});
  return out;
}

Covariance covariance_of(const TipFit& fit, const Problem& problem, const Geometry& geometry,
                         const MatrixXd& base, const std::vector<UncertainParameter>& uncertain,
                         double variance) {
  const auto count = static_cast<Index>(uncertain.size());
  if (count == 0) return {};
  const auto known = static_cast<Index>(fit.unknowns.size());
  MatrixXd columns(problem.equations, count);
  columns.leftCols(known) = base.leftCols(known);
  for (Index j = known; j < count; ++j) {
    const UncertainParameter& one = uncertain[static_cast<std::size_t>(j)];
    columns.col(j) =
        one.prior * problem.weights.cwiseProduct(error_column(problem, geometry, one.unit));
  }
  const MatrixXd places = base.rightCols(problem.places);
  columns = linear::beside(linear::orthonormal_basis(places), columns);
  const MatrixXd normal = linear::gram(columns) / variance + MatrixXd::Identity(count, count);
  const MatrixXd inverse = linear::inverse_of_normal(normal);
  std::vector<std::string> names;
  VectorXd prior(count);
  for (const UncertainParameter& one : uncertain) {
    prior[static_cast<Index>(names.size())] = one.prior;
    names.push_back(one.effect);
  }
  return with_names(std::move(names), linear::scaled_both(inverse, prior));
}

}  // namespace trueaxis::calibrate_detail

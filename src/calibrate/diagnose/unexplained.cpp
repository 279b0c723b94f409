// SPDX-License-Identifier: Apache-2.0
#include "calibrate/diagnose/unexplained.hpp"

#include <algorithm>
#include <cmath>

#include "math/linear_algebra.hpp"

namespace trueaxis::calibrate_detail {

Unexplained::Unexplained(const TipFit& fit, const Calibration& counted)
    : problem_(fit.problem),
      residuals_(fit.problem.weights.cwiseProduct(
          fit.problem.residuals(counted.errors, best_places(fit.problem, counted.errors)))),
      variance_(
          std::pow(counted.noise_mm / fit.problem.rms_mm(fit.problem.weights.cwiseInverse()), 2)),
      noise_as_stated_(counted.noise_basis == NoiseBasis::stated) {}

MachineUnexplained Unexplained::pattern(const Term& term, const MachineFinding& found) const {
  double square = 0.0;
  for (const auto& one : found.parameters) square += one.estimate.u * one.estimate.u;
  const bool named = !term.is_pattern();
  return {{{found.size, std::sqrt(square / static_cast<double>(found.parameters.size())),
            found.cause.unit, ""},
           found.p_value},
          found.effect() + (named                 ? ", which may be part of something unknown"
                            : term.of_one_reading ? " (measure it again, or leave the row out)"
                                                  : ""),
          named,
          std::min(found.size, amplitude_of(term)),
          found.parameters,
          found.covariance,
          term.error ? ErrorOfPosition{*term.error, {}, {}} : found.cause.term};
}

MachineUnexplained Unexplained::scatter(double noise_mm, double freedom, double p) const {
  return {{{noise_mm, noise_mm / std::sqrt(2.0 * freedom), "mm", ""}, p},
          "scatter above the stated noise",
          false,
          noise_as_stated_ ? 0.0 : noise_mm};
}

/// mm or rad, with all other numbers as they are. No more than noise makes is 0, because U counts
/// noise.
double Unexplained::amplitude_of(const Term& term) const {
  constexpr double beyond_noise = 3.0;  // standard deviations of χ²
  const MatrixXd columns = linear::scaled_rows(problem_.weights, term.columns);
  const auto fit = linear::shortest_solution(columns, residuals_);
  const auto freedom = static_cast<double>(fit.rank);
  const double squares = (columns * fit.x).squaredNorm();
  return squares > variance_ * (freedom + beyond_noise * std::sqrt(2.0 * freedom)) ? fit.x.norm()
                                                                                   : 0.0;
}

}  // namespace trueaxis::calibrate_detail

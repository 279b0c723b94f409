// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <complex>

#include "diagnose/explain/averaged_axis.hpp"
#include "infer/cross_validation.hpp"
#include "math/fourier_sums.hpp"

namespace trueaxis::diagnose_detail {
namespace {

double root_mean(double sum, double rows) { return rows > 0.0 ? std::sqrt(sum / rows) : 0.0; }

}  // namespace

Gain measure_gain(const Problem& problem, const Joint& joint, const AveragedAxis& average,
                  double noise_floor_mm) {
  Gain out;
  out.noise_floor_mm = noise_floor_mm;
  // In the readings' own units: not whitened.
  const Joint plain(problem, {}, joint.terms, joint.terms.size(), true);
  const NormalEquations& equations = plain.equations;
  const Columns& before = equations.base();
  const Columns& after = plain.solution.columns;
  const auto rows = static_cast<double>(equations.count());
  out.rms_before_mm = root_mean(solve(equations.total(), before).rss, rows);
  out.rms_after_mm = root_mean(plain.solution.rss, rows);
  std::vector<Fold> folds;
  for (std::size_t f = 0; f < equations.folds().size(); ++f) {
    Fold fold{equations.folds()[f]};
    for (std::size_t i = problem.mask.fold_begin[f]; i < problem.mask.fold_begin[f + 1]; ++i)
      fold.rows += problem.mask.used[i] != 0;
    if (fold.rows > 0.0) folds.push_back(std::move(fold));
  }
  cross_validate(equations.total(), folds, before, after, out);
  out.blocks = std::to_string(folds.size()) + " blocks, each " + problem.mask.block;

  const Solution bare = solve(joint.equations.total(), before);
  const Eigen::MatrixXd extended = average.within + average.between;
  // Of nested least squares Cov(difference) = Cov(larger) − Cov(smaller), at the same σ.
  const Eigen::MatrixXd difference = extended - joint.sigma_mm * joint.sigma_mm * bare.inverse;
  const AxisShift shift =
      axis_shift(problem.point, joint.base() + average.shift - bare.coefficients, difference);
  out.axis_shift = {shift.value_mm, shift.u_mm, "mm", ""};
  const AxisUncertainty u = axis_uncertainty(problem.point, extended);
  // About either axis, of a part whose axis is the stated one to its u.
  out.coaxiality_after = {2.0 * u.rms_mm, 2.0 * u.u_mm, "mm", ""};
  out.coaxiality_before = {2.0 * std::hypot(shift.value_mm, u.rms_mm), 2.0 * u.u_mm, "mm", ""};
  return out;
}

std::vector<SpectrumBin> spectrum_of(const LinearisationPoint& point, const Resolution& resolution,
                                     const std::vector<double>& before_mm,
                                     const std::vector<double>& after_mm) {
  constexpr double most_bins = 400.0;
  const double highest = std::min(15.0, 0.5 * resolution.per_turn);
  if (resolution.turns < 0.5 || highest < 1.0) return {};
  // Whole orders are bins: next to one a line of a long stream looks smaller than it is.
  const double per_order = std::max(
      1.0, std::floor(1.0 / std::max(highest / most_bins, std::min(1.0, 0.5 / resolution.turns)) +
                      1e-9));
  const auto bins = static_cast<std::size_t>(highest * per_order) + 1;
  const FourierSums plan(point.c, 0.0, 1.0 / per_order, bins);
  const std::span<const double> both[] = {before_mm, after_mm};
  const std::vector<FourierSums::Sums> sums = plan.of(both);
  const auto &before = sums[0], &after = sums[1];
  std::vector<SpectrumBin> out;
  for (std::size_t k = 0; k < bins; ++k) {
    const double factor = (k == 0 ? 1.0 : 2.0) / static_cast<double>(point.size());
    out.push_back({static_cast<double>(k) / per_order, factor * std::abs(before[k]),
                   factor * std::abs(after[k])});
  }
  return out;
}

}  // namespace trueaxis::diagnose_detail

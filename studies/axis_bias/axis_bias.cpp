// SPDX-License-Identifier: Apache-2.0
#include "studies/axis_bias/axis_bias.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "simulate/clean_stream.hpp"
#include "study/bound/estimated_parameters.hpp"
#include "study/bound/quantities.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis::study {
namespace {

using namespace virtual_lathe;

// What contact and fit leave of a noise-free axis: some hundred units of the last place of 40 mm.
constexpr double rounding_mm = 1e-11;

/// Displacements of the axis per unit of the effect, one for each of its directions.
using Moves = std::vector<AxisEnds>;

/// Largest over both ends and all mixtures c, s (c² + s² = 1) of the directions.
double worst(const Moves& moves) {
  double most = 0.0;
  for (const std::size_t end : {0, 2}) {
    Eigen::MatrixXd at(2, static_cast<Eigen::Index>(moves.size()));
    for (std::size_t d = 0; d < moves.size(); ++d) {
      at(0, static_cast<Eigen::Index>(d)) = moves[d][end];
      at(1, static_cast<Eigen::Index>(d)) = moves[d][end + 1];
    }
    most = std::max(most, Eigen::JacobiSVD<Eigen::MatrixXd>(at).singularValues()(0));
  }
  return most;
}

Moves combined(const Moves& a, double times_a, const Moves& b, double times_b) {
  Moves out = a;
  for (std::size_t d = 0; d < a.size(); ++d) {
    for (std::size_t i = 0; i < 4; ++i) out[d][i] = times_a * a[d][i] + times_b * b[d][i];
  }
  return out;
}

ProbeStream probed_with(const Scenario& ideal, const AxisBiasCase& of, std::size_t direction,
                        double size) {
  Scenario scenario = ideal;
  virtual_lathe::Effect effect{of.effect, of.shape_of_lathe};
  for (const auto& [name, per_unit] : of.directions[direction].lathe) {
    const bool is_angle = name == "phase_rad" || name == "direction_rad" || name == "jaw_angle_rad";
    effect.parameters[name] = is_angle ? per_unit : per_unit * size;
  }
  scenario.effects = {std::move(effect)};
  return simulate_clean(scenario).stream;
}

AxisEnds true_ends(const Scenario& scenario, const FitResult& fit) {
  const std::vector<double> truth =
      true_values(scenario, {fit.position_min_mm, fit.position_max_mm}, fit.surface);
  const std::vector<Quantity> names = quantities(fit.surface);
  AxisEnds out{};
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (names[i].name == "x_at_min_z")
      std::copy_n(truth.begin() + static_cast<long>(i), 4, out.begin());
  }
  return out;
}

AxisEnds difference(const AxisEnds& a, const AxisEnds& b) {
  AxisEnds out{};
  for (std::size_t i = 0; i < 4; ++i) out[i] = a[i] - b[i];
  return out;
}

/// Distance of the identified axis from the true one.
struct AxisError {
  AxisEnds alone{}, extended{};
};

AxisError axis_error(const Scenario& scenario, const EffectOnAxis& found) {
  const AxisEnds truth = true_ends(scenario, found.alone);
  return {difference(found.alone_ends, truth), difference(ends_of(found.extended), truth)};
}

/// Lathe, fit and extended fit at one size.
struct AtSize {
  Moves alone, extended;
  bool separable = true;
};

/// @param without error of the same fits of the same readings without the effect: 0 of an absolute
/// probe, while a relative gauge's nominal radius is never quite that of the part
AtSize at_size(const Scenario& ideal, const FitOptions& options, const AxisBiasCase& of,
               const AxisError& without, double size) {
  AtSize out;
  for (std::size_t d = 0; d < of.directions.size(); ++d) {
    const EffectOnAxis found = effect_on_axis(probed_with(ideal, of, d, size), options, of.known);
    if (found.alone.status != FitStatus::converged)
      throw InputError(of.effect, "the surface cannot be fitted: " + found.alone.message);
    const AxisError with = axis_error(ideal, found);
    const auto per_unit = [&](const AxisEnds& error, const AxisEnds& error_without) {
      AxisEnds moved = difference(error, error_without);
      for (double& one : moved) one /= size;
      return moved;
    };
    out.alone.push_back(per_unit(with.alone, without.alone));
    out.extended.push_back(
        difference(per_unit(with.extended, found.separable ? without.extended : AxisEnds{}),
                   of.directions[d].rigid));
    out.separable = out.separable && found.separable;
  }
  return out;
}

/// The column's projection, along each direction.
Moves predicted_moves(const EffectOnAxis& linearised, const AxisBiasCase& of) {
  Moves out;
  for (const AxisBiasDirection& direction : of.directions) {
    AxisEnds sum = direction.rigid;
    for (std::size_t j = 0; j < linearised.shift_per_unit.size(); ++j) {
      for (std::size_t i = 0; i < 4; ++i)
        sum[i] += direction.linear[j] * linearised.shift_per_unit[j][i];
    }
    out.push_back(sum);
  }
  return out;
}

}  // namespace

AxisBiasRow axis_bias_of(const Scenario& scenario, const AxisBiasCase& of) {
  Scenario ideal = scenario;
  ideal.effects.clear();
  ideal.noise = {};
  FitOptions options;
  options.surface = surface_of(ideal.part.kind);
  options.bore = ideal.part.bore;
  const ProbeStream probed = simulate_clean(ideal).stream;
  refuse_moving_axis(ideal, probed, "axis-bias");
  const EffectOnAxis linearised = effect_on_axis(probed, options, of.known);
  if (linearised.alone.status != FitStatus::converged)
    throw InputError(of.effect, "the surface cannot be fitted: " + linearised.alone.message);
  ideal.u_start_mm = linearised.z_mid_mm - linearised.z_half_mm;  // the same u in both
  ideal.u_end_mm = linearised.z_mid_mm + linearised.z_half_mm;
  const AxisError without =
      ideal.probe.relative_zero_mm ? axis_error(ideal, linearised) : AxisError{};
  const AtSize whole = at_size(ideal, options, of, without, of.size),
               half = at_size(ideal, options, of, without, 0.5 * of.size);
  const Moves predicted = predicted_moves(linearised, of),
              limit = combined(half.alone, 2.0, whole.alone, -1.0);
  const auto apart = [&](const Moves& a, const Moves& b) {
    return worst(combined(a, 1.0, b, -1.0)) / of.edge;
  };
  AxisBiasRow row;
  row.of = of;
  row.lathe = worst(whole.alone) / of.edge, row.lathe_half = worst(half.alone) / of.edge;
  row.limit = worst(limit) / of.edge, row.predicted = worst(predicted) / of.edge;
  row.second_order = apart(whole.alone, half.alone);
  row.off = apart(limit, predicted);
  row.off_whole = apart(whole.alone, predicted), row.off_half = apart(half.alone, predicted);
  row.rounding = 5.0 * rounding_mm / of.size / of.edge;  // of 2 × half − whole, half its size
  const double tilt2 = ideal.part.l * ideal.part.l + ideal.part.m * ideal.part.m;
  for (const AxisBiasDirection& direction : of.directions) {  // given to the tilt's square
    for (const double moved : direction.rigid)
      row.rounding = std::max(row.rounding, 2.0 * tilt2 * std::abs(moved) / of.edge);
  }
  row.agrees = row.off <= row.second_order + row.rounding;
  row.left = linearised.left;
  row.separable = linearised.separable && whole.separable && half.separable;
  row.u_ratio = linearised.u_ratio;
  row.extended = worst(whole.extended) / of.edge;
  row.extended_half = worst(half.extended) / of.edge;
  return row;
}

}  // namespace trueaxis::study

// SPDX-License-Identifier: Apache-2.0
#include "studies/axis_bias/axis_bias.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <complex>
#include <variant>

#include "resimulate/diagnosed_scenarios.hpp"
#include "simulate/clean_stream.hpp"
#include "study/bound/bound.hpp"
#include "study/bound/quantities.hpp"
#include "trueaxis/error.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis::study {
namespace {

using namespace virtual_lathe;

// What contact and fit leave of a noise-free axis: some hundred units of the last place of 40 mm.
constexpr double rounding_mm = 1e-11;

/// x and y of the axis at both ends (see AxisEnds), mm.
using Move = Eigen::Vector4d;
Move vector_of(const AxisEnds& ends) { return Move(ends.data()); }

/// Displacements of the axis per unit of the effect, one for each of its directions.
using Moves = Eigen::Matrix4Xd;

/// Largest over both ends and all mixtures c, s (c² + s² = 1) of the directions.
double worst(const Moves& moves) {
  const auto largest = [](const Eigen::MatrixXd& at_end) {
    return Eigen::JacobiSVD<Eigen::MatrixXd>(at_end).singularValues()(0);
  };
  return std::max(largest(moves.topRows<2>()), largest(moves.bottomRows<2>()));
}

/// How far the lathe's X is above that of the fitted surface, outwards: the error of the nominal
/// radius for a gauge, else 0.
double beyond_model_mm(const Scenario& scenario, const EffectOnAxis& found) {
  const double mm = found.indication_mm + scenario.probe.relative_zero_mm.value_or(0.0);
  const auto& setups = scenario.plan.setups;
  return !setups.empty() && setups.front().rear ? -mm : mm;
}

/// A response to X, for an X that is counted from a place so much lower.
void count_from_below(TermValue& term, double mm) {
  const auto* response = std::get_if<Response>(&term.effect->term);
  if (response == nullptr) return;
  term.shape.reference_x_mm += mm;
  if (response->of != Response::Of::cyclic) return;
  const std::complex<double> turned = std::complex(term.linear[0], term.linear[1]) *
                                      std::polar(1.0, two_pi * mm / term.shape.period_mm);
  term.linear = {turned.real(), turned.imag()};
}

/// The term at a size, as a diagnosis would have found it.
/// @param beyond_mm of the lathe's X, above that of the surface fitted
std::vector<virtual_lathe::Effect> played(const AxisBiasCase& of,
                                          const AxisBiasDirection& direction, double size,
                                          const LatheFrame& frame, double beyond_mm) {
  if (direction.lathe) return {direction.lathe(size)};
  TermValue term;
  term.effect = find_effect(of.effect);
  term.shape = of.known.shape;
  term.linear.resize(linear_parameters(term.effect->term, term.shape).size());
  for (std::size_t j = 0; j < direction.linear.size(); ++j)
    term.linear[of.known.free.empty() ? j : of.known.free[j]] = size * direction.linear[j];
  count_from_below(term, beyond_mm);
  return lathe_effects(term, frame);
}

Move true_ends(const Scenario& scenario, const FitResult& fit) {
  const std::vector<double> truth =
      true_values(scenario, {fit.position_min_mm, fit.position_max_mm}, fit.surface);
  if (fit.surface == SurfaceKind::plane) {  // what its tilt makes at the outer end
    const double end_mm = std::max(std::abs(fit.position_min_mm), std::abs(fit.position_max_mm));
    const double secant = 1.0 / std::sqrt(1.0 - truth[0] * truth[0] - truth[1] * truth[1]);
    const double x = end_mm * truth[0] * secant, y = end_mm * truth[1] * secant;
    return {x, y, x, y};
  }
  const std::vector<Quantity> names = quantities(fit.surface);
  const auto from = std::ranges::find(names, "x_at_min_z", &Quantity::name) - names.begin();
  return Move(truth.data() + from);
}

/// Distance of the identified axis from the true one.
struct AxisError {
  Move alone = Move::Zero(), extended = Move::Zero();
};

AxisError axis_error(const Scenario& scenario, const EffectOnAxis& found) {
  const Move truth = true_ends(scenario, found.alone);
  return {vector_of(found.alone_ends) - truth, vector_of(ends_of(found.extended)) - truth};
}

/// Lathe, fit and extended fit at one size.
struct AtSize {
  Moves alone, extended;
  bool separable = true;
};

/// @param without error of the same fits of the same readings without the effect: 0 of an absolute
/// probe, while a relative gauge's nominal radius is never quite that of the part
AtSize at_size(const Scenario& ideal, const FitOptions& options, const AxisBiasCase& of,
               const AxisError& without, double beyond_mm, double size) {
  const auto count = static_cast<Eigen::Index>(of.directions.size());
  AtSize out{Moves(4, count), Moves(4, count)};
  const LatheFrame frame{0.5 * (*ideal.u_start_mm + *ideal.u_end_mm),
                         0.5 * (*ideal.u_end_mm - *ideal.u_start_mm)};
  Scenario scenario = ideal;
  Eigen::Index column = 0;
  for (const AxisBiasDirection& direction : of.directions) {
    scenario.effects = played(of, direction, size, frame, beyond_mm);
    const EffectOnAxis found = effect_on_axis(simulate_clean(scenario).stream, options, of.known);
    if (found.alone.status != FitStatus::converged)
      throw InputError(of.effect, "the surface cannot be fitted: " + found.alone.message);
    AxisError error = axis_error(ideal, found);
    error.alone -= without.alone;
    if (found.separable) error.extended -= without.extended;
    out.alone.col(column) = error.alone / size;
    out.extended.col(column++) = error.extended / size - vector_of(direction.rigid);
    out.separable = out.separable && found.separable;
  }
  return out;
}

/// The column's projection, along each direction.
Moves predicted_moves(const EffectOnAxis& linearised, const AxisBiasCase& of) {
  Moves out(4, static_cast<Eigen::Index>(of.directions.size()));
  Eigen::Index column = 0;
  for (const AxisBiasDirection& direction : of.directions) {
    Move sum = vector_of(direction.rigid);
    for (std::size_t j = 0; j < linearised.shift_per_unit.size(); ++j)
      sum += direction.linear[j] * vector_of(linearised.shift_per_unit[j]);
    out.col(column++) = sum;
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
  const double beyond_mm = beyond_model_mm(ideal, linearised);
  const AtSize whole = at_size(ideal, options, of, without, beyond_mm, of.size),
               half = at_size(ideal, options, of, without, beyond_mm, 0.5 * of.size);
  const Moves predicted = predicted_moves(linearised, of), limit = 2.0 * half.alone - whole.alone;
  const auto apart = [&](const Moves& a, const Moves& b) { return worst(a - b) / of.edge; };
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
  if (ideal.part.kind == PartKind::face)  // its columns too
    row.rounding = std::max(row.rounding, 2.0 * tilt2 * row.predicted);
  row.agrees = row.off <= row.second_order + row.rounding;
  row.left = linearised.left;
  row.separable = linearised.separable && whole.separable && half.separable;
  row.u_ratio = linearised.u_ratio;
  row.extended = worst(whole.extended) / of.edge;
  row.extended_half = worst(half.extended) / of.edge;
  return row;
}

}  // namespace trueaxis::study

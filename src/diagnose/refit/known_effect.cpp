// SPDX-License-Identifier: Apache-2.0
#include "diagnose/refit/known_effect.hpp"

#include <algorithm>
#include <cmath>

#include "diagnose/refit/extended_fit.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis {

using namespace diagnose_detail;

namespace {

constexpr int rounds = 6;  // of linearising again; the third already moves by rounding
constexpr double settled_mm = 1e-12;

/// Surface and one effect, linear about a fitted surface.
struct Linearised {
  LinearisationPoint point;
  ObservationMask mask;
  Resolution resolution;
  std::vector<double> deviation_mm;
  Joint joint;

  Linearised(const ProbeStream& stream, const FitResult& about, const FitOptions& options,
             const Hypothesis& effect)
      : point(point_of(stream, about, options)),
        mask(make_observation_mask(point)),
        resolution(resolution_of(point, mask)),
        deviation_mm(deviation_from(stream, point)),
        joint(Problem{point, mask, resolution, deviation_mm}, {}, {effect}, 1) {}

  static LinearisationPoint point_of(const ProbeStream& stream, const FitResult& about,
                                     const FitOptions& options) {
    const double ball_mm = std::max(stream.ball_radius_mm.value_or(0.0), options.ball_radius_mm);
    const std::vector<Clamping> clampings = clampings_of(about, ball_mm);
    return linearise_at(stream, clampings, base_of(stream, about, clampings), options.bore);
  }
};

/// How the axis moves at the ends of the probed Z, from the coefficients of the last axis: a shift
/// and a turn about (0, 0, z_mid), which displaces a point by (δ lever, −δ·(x, y)). What the axis
/// moves along itself is a shift, its slope that much.
AxisEnds ends_from(const LinearisationPoint& point, const FitResult& fit,
                   const Eigen::VectorXd& base) {
  const auto from = static_cast<Eigen::Index>((point.base.axes - 1) * point.base.per_axis());
  AxisEnds out{base(from), base(from + 1), base(from), base(from + 1)};
  if (point.base.face) {
    for (double& moved : out) moved *= point.end_mm();
    return out;
  }
  if (!point.base.tilts) return out;
  const Axis& axis = fit.axis.axis;
  const auto middle = axis.at(point.z_mid_mm);
  const double turn_x = base(from + 2), turn_y = base(from + 3);
  const double down = turn_x * middle[0] + turn_y * middle[1];
  const double along = turn_x * axis.slope_x + turn_y * axis.slope_y;
  for (const std::size_t end : {0, 2}) {
    const double lever = (end == 0 ? fit.position_min_mm : fit.position_max_mm) - point.z_mid_mm;
    out[end] += axis.slope_x * down + lever * (turn_x + axis.slope_x * along);
    out[end + 1] += axis.slope_y * down + lever * (turn_y + axis.slope_y * along);
  }
  return out;
}

void look_about(const ProbeStream& stream, const Linearised& at, EffectOnAxis& out) {
  const Joint& joint = at.joint;
  const Solution without = joint.without(0);
  const Eigen::MatrixXd& gram = joint.equations.total();
  const Projection projection = project(gram, without.columns);
  const auto n = static_cast<Eigen::Index>(joint.equations.base().size());
  const AxisEnds step = ends_from(at.point, out.alone, without.coefficients.head(n));
  out.alone_ends = ends_of(out.alone);
  for (std::size_t i = 0; i < step.size(); ++i) out.alone_ends[i] += step[i];
  double kept = 0.0, whole = 0.0;
  for (const std::size_t column : joint.places[0]) {
    const auto c = static_cast<Eigen::Index>(column);
    Eigen::VectorXd right(static_cast<Eigen::Index>(without.columns.size()));
    for (Eigen::Index i = 0; i < right.size(); ++i)
      right(i) = gram(static_cast<Eigen::Index>(without.columns[static_cast<std::size_t>(i)]), c);
    out.shift_per_unit.push_back(ends_from(at.point, out.alone, without.inverse * right));
    kept += std::max(0.0, projection.gram(c, c)), whole += projection.norm2(c);
  }
  out.left = whole > 0.0 ? std::sqrt(kept / whole) : 0.0;
  out.z_mid_mm = at.point.z_mid_mm, out.z_half_mm = at.point.z_half_mm;
  out.sensed_mid_mm = 0.5 * (at.point.outward_mm.low + at.point.outward_mm.high);
  at.point.for_each_part([&](const PointPart& part) {
    for (std::size_t k = 0; k < part.size(); ++k)
      out.indication_mm +=
          (stream.reading_mm[part.begin + k] - part.x[k]) / static_cast<double>(stream.size());
  });
  out.separable = joint.solution.rank == joint.solution.columns.size();
  out.u_ratio = axis_uncertainty(at.point, joint.solution.inverse.topLeftCorner(n, n)).u_mm /
                axis_uncertainty(at.point, without.inverse).u_mm;
}

double apart(const AxisEnds& a, const AxisEnds& b) {
  return std::max(std::hypot(a[0] - b[0], a[1] - b[1]), std::hypot(a[2] - b[2], a[3] - b[3]));
}

}  // namespace

AxisEnds ends_of(const FitResult& fit) {
  if (fit.surface == SurfaceKind::plane) {
    const double end_mm = std::max(std::abs(fit.position_min_mm), std::abs(fit.position_max_mm));
    const double x = end_mm * fit.axis.axis.slope_x, y = end_mm * fit.axis.axis.slope_y;
    return {x, y, x, y};
  }
  const auto low = fit.axis.axis.at(fit.position_min_mm),
             high = fit.axis.axis.at(fit.position_max_mm);
  return {low[0], low[1], high[0], high[1]};
}

EffectOnAxis effect_on_axis(const ProbeStream& stream, const FitOptions& options,
                            const KnownEffect& known) {
  const Effect* effect = find_effect(known.effect);
  expects(effect != nullptr && !effect->check, "an effect of the catalogue");
  EffectOnAxis out;
  out.alone = out.extended = fit(stream, options);
  if (out.alone.status != FitStatus::converged) return out;
  const Hypothesis hypothesis = of_effect(known.effect.c_str(), known.shape, known.free);
  for (int round = 0; round < rounds; ++round) {
    const Linearised at(stream, out.extended, options, hypothesis);
    if (round == 0) look_about(stream, at, out);
    if (!out.separable) return out;
    const Eigen::VectorXd coefficients = at.joint.of(0);
    FitResult next =
        extended_fit(fit_cleaned(stream, options, at.joint.contribution_of(0), at.mask, {}),
                     at.point, uncertainty_of(at.joint));
    if (next.status != FitStatus::converged) {
      out.separable = false;
      return out;
    }
    out.linear.assign(coefficients.data(), coefficients.data() + coefficients.size());
    const double moved = apart(ends_of(next), ends_of(out.extended));
    out.extended = std::move(next);
    if (moved < settled_mm) break;
  }
  return out;
}

}  // namespace trueaxis

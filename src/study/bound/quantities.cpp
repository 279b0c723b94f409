// SPDX-License-Identifier: Apache-2.0
#include "study/bound/quantities.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "simulate/axis_at_end.hpp"
#include "surface/surface.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis::study {
namespace {

using namespace virtual_lathe;

/// A line through (x0, y0, 0) in the spindle frame.
struct TrueAxis {
  double x0, y0, l, m, n;
  double from_origin_mm;  ///< along it, from (x0, y0, 0) to the origin of the part's frame

  double x_at(double z) const { return x0 + l / n * z; }
  double y_at(double z) const { return y0 + m / n * z; }
};

Chucking last_chucking(const Scenario& scenario) {
  int number = 1;
  for (const PlannedPass& pass : scenario.plan.passes) number = std::max(number, pass.setup);
  for (const Chucking& setup : scenario.plan.setups) {
    if (setup.number == number) return setup;
  }
  return {};
}

TrueAxis axis_of(const Scenario& scenario, const Probed& probed) {
  const Chucking setup = last_chucking(scenario);
  const Part& part = scenario.part;
  TrueAxis axis{setup.x0_mm.value_or(part.x0_mm),
                setup.y0_mm.value_or(part.y0_mm),
                setup.l.value_or(part.l),
                setup.m.value_or(part.m),
                1.0,
                0.0};
  // As it is at the end: slips and creeps have moved it, and of a bow it is the nearest line.
  if (const auto now = axis_at_end(scenario, setup, probed.low_mm, probed.high_mm, probed.end_s)) {
    axis.x0 = now->x0_mm, axis.y0 = now->y0_mm, axis.l = now->l, axis.m = now->m;
    axis.n = std::sqrt(1.0 - axis.l * axis.l - axis.m * axis.m);
    axis.from_origin_mm = setup.z_shift_mm / axis.n;
    return axis;
  }
  axis.n = std::sqrt(1.0 - axis.l * axis.l - axis.m * axis.m);
  axis.x0 -= axis.l / axis.n * setup.z_shift_mm;
  axis.y0 -= axis.m / axis.n * setup.z_shift_mm;
  axis.from_origin_mm = setup.z_shift_mm / axis.n;
  return axis;
}

/// Position of the apex along the axis, in the part's frame.
double apex_of(const Part& part) {
  if (part.apex_mm) return *part.apex_mm;
  const double tangent = std::tan(part.half_angle_rad);
  return tangent == 0.0 ? std::numeric_limits<double>::quiet_NaN()
                        : part.radius_at_mm - part.radius_mm / tangent;
}

/// For a cone, `along` the axis from the spindle's origin.
double radius_at(const Part& part, double apex, double along) {
  return std::abs(apex - along) * std::tan(std::abs(part.half_angle_rad));
}

/// n·p = d of the face as it is last: through its origin's height, turned about that origin.
std::vector<double> face_of(const Scenario& scenario) {
  const Part& part = scenario.part;
  const Chucking setup = last_chucking(scenario);
  const double l = setup.l.value_or(part.l), m = setup.m.value_or(part.m);
  const double height = part.d_mm - part.l * part.x0_mm - part.m * part.y0_mm;
  return {l, m,
          height + l * setup.x0_mm.value_or(part.x0_mm) + m * setup.y0_mm.value_or(part.y0_mm) +
              std::sqrt(1.0 - l * l - m * m) * setup.z_shift_mm};
}

}  // namespace

SurfaceKind surface_of(PartKind kind) {
  static constexpr SurfaceKind fitted[] = {SurfaceKind::cone, SurfaceKind::cylinder,
                                           SurfaceKind::plane};
  return fitted[static_cast<std::size_t>(kind)];
}

std::vector<Quantity> quantities(SurfaceKind surface) {
  const SurfaceInfo& info = surface_info(surface);
  std::vector<Quantity> out;
  for (std::size_t i = 0; i < info.parameters.size(); ++i)
    out.push_back({std::string(info.parameters[i]),
                   info.units[i] == "rad" ? "deg" : std::string(info.units[i])});
  if (surface == SurfaceKind::plane || surface == SurfaceKind::section) return out;
  for (const char* name : {"x_at_min_z", "y_at_min_z", "x_at_max_z", "y_at_max_z"})
    out.push_back({name, "mm"});
  if (surface == SurfaceKind::cone) out.push_back({"radius_mid", "mm"});
  return out;
}

Probed probed_length(const ProbeStream& stream) {
  const std::vector<SetUp> set_ups = list_set_ups(stream);
  auto first = set_ups.end() - 1;
  while (first != set_ups.begin() && first->clamped_as(*(first - 1))) --first;
  Probed out{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (std::size_t i = 0; i < stream.size(); ++i) {
    const int number = stream.setup.empty() ? first->number : stream.setup[i];
    if (std::none_of(first, set_ups.end(), [&](const SetUp& s) { return s.number == number; }))
      continue;
    out.low_mm = std::min(out.low_mm, stream.position_mm[i]);
    out.high_mm = std::max(out.high_mm, stream.position_mm[i]);
    if (!stream.time_s.empty()) out.end_s = std::max(out.end_s, stream.time_s[i]);
  }
  return out;
}

std::vector<double> true_values(const Scenario& scenario, const Probed& probed,
                                SurfaceKind surface) {
  const Part& part = scenario.part;
  if (part.kind == PartKind::face) return face_of(scenario);
  const TrueAxis axis = axis_of(scenario, probed);
  std::vector<double> out{axis.x0, axis.y0, axis.l, axis.m};
  const double apex = apex_of(part) + axis.from_origin_mm;
  if (surface == SurfaceKind::section) {
    const double z = 0.5 * (probed.low_mm + probed.high_mm);
    const bool tapers = part.kind == PartKind::cone && part.half_angle_rad != 0.0;
    return {axis.x_at(z), axis.y_at(z),
            tapers ? radius_at(part, apex, z / axis.n) : part.radius_mm};
  }
  if (part.kind == PartKind::cone) {
    out.insert(out.end(), {apex, std::abs(part.half_angle_rad) / rad_per_deg});
  } else {
    out.push_back(part.radius_mm);
  }
  for (const double z : {probed.low_mm, probed.high_mm})
    out.insert(out.end(), {axis.x_at(z), axis.y_at(z)});
  if (part.kind == PartKind::cone) {
    const double along = 0.5 * (probed.low_mm + probed.high_mm) / axis.n;
    out.push_back(radius_at(part, apex, along));
  }
  return out;
}

Estimated estimated(const FitResult& fit) {
  Estimated out;
  const auto put = [&](double value, double u) {
    out.value.push_back(value);
    out.u.push_back(u);
  };
  for (const FitParameter& parameter : fit.parameters) {
    const Estimate edge = at_edge(parameter.estimate);
    put(edge.value, edge.u);
  }
  if (fit.surface == SurfaceKind::plane || fit.surface == SurfaceKind::section) return out;
  const Axis& axis = fit.axis.axis;
  const auto& c = fit.axis.covariance;
  for (const double z : {fit.position_min_mm, fit.position_max_mm}) {
    const double from = z - axis.z_ref_mm;
    const auto u = [&](AxisRow i, AxisRow slope) {
      return std::sqrt(c(i, i) + 2.0 * from * c(i, slope) + from * from * c(slope, slope));
    };
    const auto [x, y] = axis.at(z);
    put(x, u(AxisRow::x, AxisRow::slope_x));
    put(y, u(AxisRow::y, AxisRow::slope_y));
  }
  for (const FitParameter& derived : fit.derived) {
    if (derived.name == "radius_mid") put(derived.estimate.value, derived.estimate.u);
  }
  return out;
}

}  // namespace trueaxis::study

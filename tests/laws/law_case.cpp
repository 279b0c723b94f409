// SPDX-License-Identifier: Apache-2.0
#include "laws/law_case.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "trueaxis/error.hpp"
#include "trueaxis/units.hpp"
#include "trueaxis/virtual_lathe.hpp"

namespace trueaxis::laws {
namespace {

constexpr double relative_zero_share = 0.87;  // of the radius: what a relative gauge hides

}  // namespace

double LawCase::half_angle_rad() const { return half_angle_deg * rad_per_deg; }

std::string to_literal(const LawCase& c) {
  char text[640];
  std::snprintf(
      text, sizeof text,
      "LawCase{.surface = \"%s\", .x_mm = %.17g, .y_mm = %.17g, .slope_x = %.17g, "
      ".slope_y = %.17g, .radius_mm = %.17g, .half_angle_deg = %.17g, .start_mm = %.17g, "
      ".end_mm = %.17g, .revolutions = %.17g, .readings_per_revolution = %.17g, "
      ".c_start_rad = %.17g, .ball_mm = %.17g, .noise_mm = %.17g, .rear = %d, .bore = %d, "
      ".relative = %d, .returns = %d, .seed = %llu}",
      std::string(c.surface).c_str(), c.x_mm, c.y_mm, c.slope_x, c.slope_y, c.radius_mm,
      c.half_angle_deg, c.start_mm, c.end_mm, c.revolutions, c.readings_per_revolution,
      c.c_start_rad, c.ball_mm, c.noise_mm, c.rear, c.bore, c.relative, c.returns,
      static_cast<unsigned long long>(c.seed));
  return text;
}

virtual_lathe::Scenario scenario_of(const LawCase& c) {
  using virtual_lathe::PartKind;
  const double n = 1.0 / std::sqrt(1.0 + c.slope_x * c.slope_x + c.slope_y * c.slope_y);
  virtual_lathe::Scenario scenario;
  virtual_lathe::Part& part = scenario.part;
  part.l = c.slope_x * n, part.m = c.slope_y * n;
  expects(c.surface == "cone" || c.surface == "cylinder" || c.surface == "section" ||
              c.surface == "plane",
          "a surface that the law cases know: add it to every function of this file");
  if (c.surface == "plane") {
    part.kind = PartKind::face;
    part.d_mm = c.radius_mm;
  } else {
    part.kind = c.surface == "cone" ? PartKind::cone : PartKind::cylinder;
    part.bore = c.bore;
    part.x0_mm = c.x_mm - c.slope_x * c.middle_mm();
    part.y0_mm = c.y_mm - c.slope_y * c.middle_mm();
    part.radius_mm = c.radius_mm;
    part.radius_at_mm = c.middle_mm() / n;
    part.half_angle_rad = c.half_angle_rad();
  }
  scenario.probe.ball_radius_mm = c.ball_mm;
  if (c.relative) {
    scenario.probe.relative_zero_mm = relative_zero_share * c.radius_mm;
    scenario.probe.nominal_radius_mm = c.radius_mm;
  }
  virtual_lathe::PlannedPass pass;
  pass.start_mm = c.start_mm, pass.end_mm = c.end_mm;
  pass.revolutions = c.revolutions;
  pass.feed_mm_per_rev = std::abs(c.end_mm - c.start_mm) / c.revolutions;
  pass.readings_per_revolution = c.readings_per_revolution;
  pass.c_start_rad = c.c_start_rad;
  scenario.plan.passes = {pass};
  if (c.returns) {
    std::swap(pass.start_mm, pass.end_mm);
    scenario.plan.passes.push_back(pass);
  }
  if (c.rear) {
    scenario.plan.setups.resize(1);
    scenario.plan.setups[0].rear = true;
  }
  scenario.noise.sigma_mm = c.noise_mm;
  scenario.probe.states_noise = false;
  scenario.seed = c.seed;
  return scenario;
}

ProbeStream probe(const LawCase& c) {
  ProbeStream stream = virtual_lathe::simulate(scenario_of(c));
  if (c.surface == "section") stream.position_mm.clear();
  if (c.relative && c.surface == "cone") {  // the nominal radius is that at the middle of the data
    const auto [low, high] = std::ranges::minmax(stream.position_mm);
    const double secant = std::sqrt(1.0 + c.slope_x * c.slope_x + c.slope_y * c.slope_y);
    stream.nominal_radius_mm =
        c.radius_mm + std::tan(c.half_angle_rad()) * secant * (0.5 * (low + high) - c.middle_mm());
  }
  return stream;
}

double single_reading(const LawCase& c, double c_rad, double position_mm, double height_mm) {
  virtual_lathe::Scenario scenario = scenario_of(c);
  scenario.noise = {};
  virtual_lathe::PlannedPass& pass = scenario.plan.passes.front();
  scenario.plan.passes.resize(1);
  pass.start_mm = pass.end_mm = position_mm;
  pass.c_start_rad = c_rad;
  pass.readings_per_revolution = pass.revolutions = 1e-3;
  if (height_mm != 0.0) scenario.effects = {{"probe.height", {{"height_mm", height_mm}}}};
  return virtual_lathe::simulate(scenario).reading_mm.front();
}

FitOptions options_of(const LawCase& c) {
  FitOptions options;
  options.surface = surface_from_id(c.surface);
  options.bore = c.bore;
  options.ball_radius_mm = c.ball_mm;
  return options;
}

std::vector<double> expected_parameters(const LawCase& c) {
  const double n = 1.0 / std::sqrt(1.0 + c.slope_x * c.slope_x + c.slope_y * c.slope_y);
  const double z = c.middle_mm(), l = c.slope_x * n, m = c.slope_y * n;
  if (c.surface == "plane") return {l, m, c.radius_mm};
  if (c.surface == "section") return {c.x_mm, c.y_mm, c.radius_mm};
  std::vector<double> values{c.x_mm - c.slope_x * z, c.y_mm - c.slope_y * z, l, m};
  if (c.surface == "cylinder") {
    values.push_back(c.radius_mm);
  } else {
    values.push_back(z / n - c.radius_mm / std::tan(c.half_angle_rad()));
    values.push_back(std::abs(c.half_angle_rad()));
  }
  return values;
}

SurfaceFrame frame_of(const LawCase& c) {
  SurfaceFrame frame;
  frame.root = c.rear ? Root::rear : Root::front;
  frame.indication = c.relative ? Indication::relative : Indication::absolute;
  frame.nominal_radius_mm = c.relative ? c.radius_mm : 0.0;
  frame.ball_mm = c.bore ? -c.ball_mm : c.ball_mm;
  if (c.surface != "section") {
    frame.position_ref_mm = c.middle_mm();
    frame.half_length_mm = 0.5 * std::abs(c.end_mm - c.start_mm);
  }
  return frame;
}

std::vector<double> working_of(const LawCase& c) {
  const double tangent = c.surface == "cone" ? std::tan(c.half_angle_rad()) : 0.0;
  const double ball = c.bore ? -c.ball_mm : c.ball_mm;
  if (c.surface == "plane") {
    const double secant = std::sqrt(1.0 + c.slope_x * c.slope_x + c.slope_y * c.slope_y);
    return {(c.radius_mm + ball) * secant, -c.slope_x, -c.slope_y};
  }
  const double level = c.relative ? -relative_zero_share * c.radius_mm
                                  : c.radius_mm + ball * std::sqrt(1.0 + tangent * tangent);
  if (c.surface == "section") return {c.x_mm, c.y_mm, level};
  std::vector<double> working{c.x_mm, c.y_mm, c.slope_x, c.slope_y, level};
  if (c.surface == "cone") working.push_back(tangent);
  return working;
}

std::vector<double> rounding_of_parameters(const LawCase& c, const FitResult& result) {
  constexpr double epsilon = std::numeric_limits<double>::epsilon();
  // Four roundings of the size each: the virtual lathe's part frame and root, the engine's
  // prediction, and the floor at which the minimiser stops.
  const double reading = 16.0 * epsilon * rounding_size_mm(c);
  const double norm = reading * std::sqrt(static_cast<double>(result.points));
  std::vector<double> out;
  const std::vector<double> expected = expected_parameters(c);
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const double root_inverse =
        result.parameters.at(i).estimate.u / result.sigma_mm / result.u_factor / result.widened;
    out.push_back(norm * root_inverse + 8.0 * epsilon * std::abs(expected[i]));
  }
  return out;
}

std::vector<std::string> catalogue_ids() {
  std::vector<std::string> ids;
  for (const SurfaceInfo& info : surface_catalogue())
    if (is_diagnosed(info.kind)) ids.emplace_back(info.id);  // others: unit/sphere_torus_test.cpp
  return ids;
}

std::vector<std::string> lateral_ids() {
  std::vector<std::string> ids = catalogue_ids();
  std::erase_if(ids, [](const std::string& id) {
    return surface_info(surface_from_id(id)).stream == StreamKind::face;
  });
  return ids;
}

std::string name_of(const ::testing::TestParamInfo<std::string>& info) { return info.param; }

double rounding_size_mm(const LawCase& c) {
  const double reach = std::max(std::abs(c.start_mm), std::abs(c.end_mm));
  const double tilt = std::hypot(c.slope_x, c.slope_y);
  if (c.surface == "plane") return std::abs(c.radius_mm) + tilt * reach;
  const double tangent = c.surface == "cone" ? std::tan(c.half_angle_rad()) : 0.0;
  // The kernel's |q|² − s² cancels to the section's size: ζ²/R is what is lost on a long thin part.
  const double longest = 0.5 * std::abs(c.end_mm - c.start_mm);
  const double size = c.radius_mm + std::hypot(c.x_mm, c.y_mm) + c.ball_mm +
                      (std::abs(tangent) + tilt) * reach +
                      std::abs(tangent * (c.end_mm - c.start_mm)) + longest * longest / c.radius_mm;
  double cosine = 1.0;  // of the incidence on the worst end
  for (const double z : {c.start_mm, c.end_mm}) {
    const double dz = z - c.middle_mm();
    const double e = std::hypot(c.x_mm + c.slope_x * dz, c.y_mm + c.slope_y * dz);
    const double share = std::min(0.999, e / (c.radius_mm + tangent * dz));
    cosine = std::min(cosine, std::sqrt(1.0 - share * share));
  }
  return size / cosine;
}

double Draw::uniform(double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(engine_);
}

double Draw::log_uniform(double low, double high) {
  return std::exp(uniform(std::log(low), std::log(high)));
}

namespace {

bool spindle_axis_inside(const ProbeStream& stream, double radius_mm, bool rear) {
  return std::ranges::all_of(stream.reading_mm,
                             [&](double x) { return (rear ? -x : x) > 1e-3 * radius_mm; });
}

LawCase draw_once(std::string_view surface, Draw& draw, const Domain& domain) {
  LawCase c;
  c.surface = surface;
  const double tilt = domain.tilt_rad * draw.uniform(0.0, 1.0), towards = draw.uniform(0, two_pi);
  c.slope_x = std::tan(tilt) * std::cos(towards), c.slope_y = std::tan(tilt) * std::sin(towards);
  c.readings_per_revolution = draw.log_uniform(2.3, 360.0);
  const double readings = draw.log_uniform(domain.readings_min, domain.readings_max);
  c.revolutions = std::max(1.1, readings / c.readings_per_revolution);
  c.readings_per_revolution = readings / c.revolutions;
  c.c_start_rad = draw.uniform(-20.0, 20.0);
  c.returns = draw.chance(0.2);
  if (surface == "plane") {
    c.radius_mm = draw.uniform(-domain.z_offset_mm, domain.z_offset_mm);
    c.start_mm = draw.uniform(-100.0, 100.0);
    c.end_mm = draw.uniform(-100.0, 100.0);
    c.ball_mm = draw.chance(0.3) ? draw.uniform(0.5, 3.0) : 0.0;
    return c;
  }
  if (surface == "cone") {
    c.half_angle_deg =
        draw.sign() *
        (draw.chance(0.5)
             ? draw.log_uniform(domain.least_half_angle_deg, domain.largest_half_angle_deg)
             : draw.uniform(domain.least_half_angle_deg, domain.largest_half_angle_deg));
  }
  const double tangent = std::abs(std::tan(c.half_angle_rad()));
  const double small_end = draw.log_uniform(2.0, 150.0);
  const double length = std::min(draw.log_uniform(domain.length_min_mm, domain.length_max_mm),
                                 300.0 / std::max(tangent, 1e-9));
  c.radius_mm = small_end + 0.5 * length * tangent;
  const double z = draw.uniform(-domain.z_offset_mm, domain.z_offset_mm);
  c.start_mm = z, c.end_mm = surface == "section" ? z : z + length * draw.sign();
  if (surface == "section") c.slope_x = c.slope_y = 0.0;
  const double e = small_end * domain.eccentricity *
                   (draw.chance(0.5) ? draw.uniform(0, 1) : draw.log_uniform(1e-4, 1.0));
  const double phase = draw.uniform(0, two_pi);
  c.x_mm = e * std::cos(phase), c.y_mm = e * std::sin(phase);
  c.rear = draw.chance(0.25);
  c.bore = draw.chance(0.25);
  const double largest_ball = std::min(5.0, 0.5 * small_end);
  c.ball_mm = draw.chance(0.3) ? draw.uniform(0.1, largest_ball) : 0.0;
  return c;
}

}  // namespace

LawCase draw_case(std::string_view surface, Draw& draw, const Domain& domain) {
  for (;;) {
    const LawCase c = draw_once(surface, draw, domain);
    if (surface == "plane") return c;
    try {
      if (spindle_axis_inside(probe(c), c.radius_mm, c.rear)) return c;
    } catch (const InputError&) {  // the probe misses the part somewhere
    }
  }
}

}  // namespace trueaxis::laws

// SPDX-License-Identifier: Apache-2.0
#include "blind/plans.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "trueaxis/units.hpp"

namespace trueaxis::blind {
namespace {

using virtual_lathe::Chucking;
using virtual_lathe::PlannedPass;
using virtual_lathe::Scenario;

constexpr double slow_rpm = 60.0, fast_rpm = 151.0;  // an irrational ratio, nearly
constexpr double reindex_rad = 70.0 * rad_per_deg;

PlannedPass helical(double feed_mm_per_rev, double speed_rpm, bool back) {
  PlannedPass pass;
  pass.start_mm = back ? end_mm : start_mm;
  pass.end_mm = back ? start_mm : end_mm;
  pass.feed_mm_per_rev = feed_mm_per_rev;
  pass.speed_rpm = speed_rpm;
  pass.readings_per_revolution = readings_per_revolution;
  pass.pause_s = 2.3;
  return pass;
}

PlannedPass dwell() {
  PlannedPass pass = helical(1.0, slow_rpm, false);
  pass.start_mm = pass.end_mm = 0.5 * (start_mm + end_mm);
  pass.revolutions = 8.0;
  return pass;
}

PlannedPass stationary() {
  PlannedPass pass = dwell();
  pass.speed_rpm = 0.0;
  pass.duration_s = 10.0;
  pass.rate_hz = 11.3;
  return pass;
}

PlannedPass in_setup(PlannedPass pass, int setup) {
  pass.setup = setup;
  return pass;
}

// Clamped anew, the part has another eccentricity and tilt.
Chucking clamped_anew(int number, int variant) {
  Chucking setup;
  setup.number = number;
  const double at = 1.1 + 1.7 * number + 0.9 * variant;
  setup.x0_mm = eccentricity_mm * std::cos(at), setup.y0_mm = eccentricity_mm * std::sin(at);
  setup.l = tilt_rad * std::cos(at + 2.0), setup.m = tilt_rad * std::sin(at + 2.0);
  return setup;
}

Chucking rechucked(int number, int variant) {
  Chucking setup = clamped_anew(number, variant);
  setup.reindex_rad = reindex_rad;
  return setup;
}

Chucking from_behind(int number) {
  Chucking setup;
  setup.number = number, setup.rear = true;
  return setup;
}

void lay_out(PlanId plan, int variant, virtual_lathe::Plan& out) {
  const auto there_and_back = [&](double feed) {
    out.passes = {helical(feed, slow_rpm, false), helical(feed, fast_rpm, true)};
  };
  switch (plan) {
    case PlanId::p1:
      out.passes = {helical(0.953, slow_rpm, false)};
      break;
    case PlanId::p2:
      out.passes = {helical(1.907, slow_rpm, false), helical(1.907, slow_rpm, true)};
      break;
    case PlanId::p3:
      there_and_back(1.907);
      break;
    case PlanId::p4:
      out.passes = {helical(1.907, slow_rpm, false), helical(1.907, -slow_rpm, true)};
      break;
    case PlanId::p5:
      there_and_back(2.371);
      out.passes.push_back(dwell());
      out.passes.push_back(stationary());
      break;
    case PlanId::p6:
      there_and_back(2.837);
      out.passes.push_back(in_setup(helical(2.837, slow_rpm, false), 2));
      out.setups = {rechucked(2, variant)};
      break;
    case PlanId::p7:
      there_and_back(2.837);
      out.passes.push_back(in_setup(helical(2.837, slow_rpm, false), 2));
      out.setups = {from_behind(2)};
      break;
    case PlanId::p8:
      there_and_back(5.903);
      out.passes.push_back(helical(5.903, -slow_rpm, false));
      out.passes.push_back(dwell());
      out.passes.push_back(stationary());
      out.passes.push_back(in_setup(helical(5.903, slow_rpm, true), 2));
      out.passes.push_back(in_setup(helical(5.903, slow_rpm, false), 3));
      out.setups = {from_behind(2), rechucked(3, variant)};
      break;
  }
}

}  // namespace

std::string to_string(PlanId plan) {
  constexpr const char* names[] = {"P1", "P2", "P3", "P4", "P5", "P6", "P7", "P8"};
  return names[static_cast<int>(plan)];
}

std::string to_string(SurfaceId surface) {
  return surface == SurfaceId::cone ? "cone" : "cylinder";
}

std::vector<PlanId> all_plans() {
  return {PlanId::p1, PlanId::p2, PlanId::p3, PlanId::p4,
          PlanId::p5, PlanId::p6, PlanId::p7, PlanId::p8};
}

PlanId plan_from(std::string_view text) {
  for (const PlanId plan : all_plans()) {
    if (to_string(plan) == text) return plan;
  }
  throw std::invalid_argument("no plan `" + std::string(text) + "`: P1 … P8");
}

SurfaceId surface_from(std::string_view text) {
  if (text == "cone") return SurfaceId::cone;
  if (text == "cylinder") return SurfaceId::cylinder;
  throw std::invalid_argument("no surface `" + std::string(text) + "`: cone, cylinder");
}

Scenario plain_scenario(PlanId plan, SurfaceId surface, int variant) {
  Scenario scenario;
  virtual_lathe::Part& part = scenario.part;
  part.kind = surface == SurfaceId::cone ? virtual_lathe::PartKind::cone
                                         : virtual_lathe::PartKind::cylinder;
  part.half_angle_rad = surface == SurfaceId::cone ? std::atan(tangent) : 0.0;
  part.radius_mm = radius_mm;
  const double at = 0.4 + 1.9 * variant;
  part.x0_mm = eccentricity_mm * std::cos(at), part.y0_mm = eccentricity_mm * std::sin(at);
  part.l = tilt_rad * std::cos(at - 2.2), part.m = tilt_rad * std::sin(at - 2.2);
  scenario.u_start_mm = start_mm, scenario.u_end_mm = end_mm;
  lay_out(plan, variant, scenario.plan);
  return scenario;
}

std::optional<Scenario> with_measurement(Scenario scenario, std::string_view code) {
  virtual_lathe::Plan& plan = scenario.plan;
  int setups = 1;
  for (const PlannedPass& pass : plan.passes) setups = std::max(setups, pass.setup);
  // As the part is clamped now.
  const int now = plan.passes.back().setup;
  Chucking as_it_is;
  for (const Chucking& s : plan.setups)
    if (s.number == now) as_it_is = s;
  PlannedPass again = in_setup(helical(2.837, slow_rpm, false), now);
  PlannedPass back = in_setup(helical(2.837, slow_rpm, true), now);
  const auto in_new_setup = [&](const Chucking& setup) {
    plan.setups.push_back(setup);
    plan.passes.push_back(in_setup(again, setup.number));
  };
  const int next = setups + 1;
  Chucking setup;
  setup.number = next;
  if (code == "RV") {
    again.speed_rpm = -slow_rpm;
    plan.passes.push_back(again);
  } else if (code == "RZ") {
    plan.passes.push_back(back);
  } else if (code == "2W") {
    back.speed_rpm = fast_rpm;
    plan.passes.push_back(back);
  } else if (code == "DW") {
    plan.passes.push_back(in_setup(dwell(), now));
  } else if (code == "ST") {
    PlannedPass quarter = dwell();
    quarter.revolutions = 0.25;
    for (const PlannedPass& pass : {stationary(), quarter, stationary()})
      plan.passes.push_back(in_setup(pass, now));
  } else if (code == "RC") {
    in_new_setup(rechucked(next, 1));
  } else if (code == "RE") {
    setup = as_it_is;
    setup.number = next, setup.rear = !as_it_is.rear;
    plan.passes.push_back(in_setup(back, next));
    in_new_setup(setup);
  } else if (code == "OZ") {
    setup = clamped_anew(next, 1);
    setup.z_shift_mm = 7.3;
    in_new_setup(setup);
  } else if (code == "RM") {
    setup = clamped_anew(next, 1);
    setup.clamp_force_ratio = 0.5;
    in_new_setup(setup);
  } else if (code == "XJ") {
    setup = as_it_is;
    setup.number = next, setup.x_jog_mm += 0.1;
    in_new_setup(setup);
  } else {
    return std::nullopt;
  }
  return scenario;
}

double duration_s(const virtual_lathe::Plan& plan) {
  double t = 0.0;
  for (std::size_t i = 0; i < plan.passes.size(); ++i) {
    const PlannedPass& pass = plan.passes[i];
    if (i > 0) t += pass.pause_s;
    const double turns = pass.start_mm == pass.end_mm
                             ? pass.revolutions
                             : std::abs(pass.end_mm - pass.start_mm) / pass.feed_mm_per_rev;
    t += pass.speed_rpm == 0.0 ? pass.duration_s : turns * 60.0 / std::abs(pass.speed_rpm);
  }
  return t;
}

}  // namespace trueaxis::blind

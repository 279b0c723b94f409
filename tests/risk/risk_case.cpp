// SPDX-License-Identifier: Apache-2.0
#include "risk/risk_case.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <utility>

#include "job/conclude.hpp"
#include "trueaxis/virtual_lathe.hpp"

namespace trueaxis::risk {
namespace {

using virtual_lathe::Scenario;

/// Numbers that are the same with every standard library.
class Draw {
 public:
  explicit Draw(std::uint64_t seed) : random_(seed) {}
  double unit() { return static_cast<double>(random_() >> 11U) * 0x1p-53; }
  double between(double low, double high) { return low + (high - low) * unit(); }
  double log_between(double low, double high) { return low * std::pow(high / low, unit()); }
  double whole(int low, int high) { return std::floor(between(low, high + 1.0)); }
  double phase() { return between(-std::numbers::pi, std::numbers::pi); }

 private:
  std::mt19937_64 random_;
};

constexpr double speed_rpm = 60.0;

/// A wave that keeps step with the eccentricity is the axis itself to one pass: no data show it,
/// and it is not drawn. It beats with it at least once over the stream.
double away_from_one(double order, double turns) {
  if (std::abs(order - 1.0) * turns >= 1.0) return order;
  return 1.0 + (order < 1.0 ? -1.0 : 1.0) / turns;
}

/// An effect at a size that the catalogue calls typical, along a length from 0.
virtual_lathe::Effect draw_effect(Draw& draw, double length_mm, double feed_mm_per_rev) {
  const double turns = length_mm / feed_mm_per_rev;
  const double um = 1e-3;
  switch (static_cast<int>(draw.whole(0, 9))) {
    case 0:
      return {"part.roundness",
              {{"order", draw.whole(2, 8)},
               {"amplitude_mm", draw.log_between(0.5, 10.0) * um},
               {"phase_rad", draw.phase()}}};
    case 1:
      return {"part.chuck_lobing",
              {{"jaws", draw.whole(2, 4)},
               {"amplitude_mm", draw.log_between(1.0, 10.0) * um},
               {"jaw_angle_rad", draw.phase()},
               {"decay_length_mm", draw.log_between(10.0, 60.0)},
               {"jaw_position_mm", -2.0}}};
    case 2:
      return {"part.barrel", {{"amplitude_mm", draw.log_between(1.0, 10.0) * um}}};
    case 3:
      return {"part.waviness",
              {{"wavelength_mm",
                feed_mm_per_rev / away_from_one(draw.between(3.0, 12.0) / turns, turns)},
               {"amplitude_mm", draw.log_between(0.5, 5.0) * um},
               {"phase_rad", draw.phase()}}};
    case 4:
      return {"spindle.radial_synchronous",
              {{"order", draw.whole(2, 6)},
               {"amplitude_mm", draw.log_between(0.3, 5.0) * um},
               {"phase_rad", draw.phase()}}};
    case 5:
      return {"spindle.tilt_synchronous",
              {{"order", draw.whole(2, 4)},
               {"amplitude_rad", draw.log_between(1e-6, 2e-5)},
               {"phase_rad", draw.phase()},
               {"bearing_mm", draw.between(-200.0, -50.0)}}};
    case 6:
      return {"spindle.asynchronous",
              {{"order", draw.between(0.4, 0.45)},
               {"amplitude_mm", draw.log_between(0.5, 10.0) * um},
               {"phase_rad", draw.phase()}}};
    case 7:
      return {"environment.vibration",
              {{"frequency_hz", away_from_one(draw.between(0.5, 8.0), turns)},
               {"amplitude_mm", draw.log_between(0.3, 5.0) * um},
               {"phase_rad", draw.phase()}}};
    case 8:
      return {"thermal.drift",
              {{"rate_mm_per_s", draw.log_between(0.02, 0.3) * um},
               {"amplitude_mm", 0.0},
               {"time_constant_s", 300.0}}};
    default:
      return {"part.bow",
              {{"sagitta_mm", draw.log_between(1.0, 10.0) * um},
               {"length_mm", length_mm},
               {"middle_mm", 0.5 * length_mm},
               {"direction_rad", draw.phase()}}};
  }
}

struct Drawn {
  std::vector<Scenario> scenarios;
  Job job;
  double slip_x_mm = 0.0, slip_y_mm = 0.0, turned_rad = 0.0;
};

/// A seat from Z `from` on; the second of a part is out of coaxial with the first.
Scenario draw_seat(Group group, Draw& draw, double from_mm, const Scenario* first) {
  Scenario s;
  const double length = draw.between(20.0, 60.0);
  s.part.radius_mm = draw.log_between(10.0, 80.0);
  if (draw.unit() < 0.4) {
    s.part.kind = virtual_lathe::PartKind::cone;
    s.part.half_angle_rad = draw.between(2.0, 20.0) * std::numbers::pi / 180.0;
    s.part.radius_at_mm = from_mm;
  }
  const double off = draw.log_between(0.005, 0.1), at = draw.phase();
  s.part.x0_mm = off * std::cos(at), s.part.y0_mm = off * std::sin(at);
  s.part.l = 5e-4 * draw.between(-1.0, 1.0), s.part.m = 5e-4 * draw.between(-1.0, 1.0);
  if (first) {
    s.part.x0_mm = first->part.x0_mm + draw.between(-0.01, 0.01);
    s.part.y0_mm = first->part.y0_mm + draw.between(-0.01, 0.01);
    s.part.l = first->part.l, s.part.m = first->part.m;
  }
  s.noise.sigma_mm = draw.between(0.5, 2.0) * 1e-3;
  if (group == Group::correlated) s.noise.rho = draw.between(0.2, 0.7);
  if (group == Group::slip_in_correlated_noise) s.noise.rho = 0.8;
  s.part.bore = group == Group::slip_in_a_bore;
  virtual_lathe::PlannedPass pass;
  pass.start_mm = from_mm, pass.end_mm = from_mm + length;
  pass.feed_mm_per_rev = draw.between(0.8, 2.0);
  pass.speed_rpm = speed_rpm;
  pass.readings_per_revolution = draw.between(18.0, 40.0);
  pass.jitter = 0.2;
  s.plan.setups.emplace_back().rear = group == Group::slip_probed_behind;
  s.plan.passes.push_back(pass);
  s.seed = static_cast<std::uint64_t>(draw.between(1.0, 1e15));
  const int effects = group == Group::form              ? 1
                      : group == Group::ambiguous_forms ? static_cast<int>(draw.whole(2, 4))
                      : group == Group::without_t       ? static_cast<int>(draw.whole(1, 2))
                                                        : 0;
  for (int e = 0; e < effects; ++e)
    s.effects.push_back(draw_effect(draw, length, pass.feed_mm_per_rev));
  return s;
}

/// Slips of the part at instants of the only stream, as its group has them.
void add_slips(Group group, Draw& draw, Drawn& out) {
  if (group < Group::slip) return;
  Scenario& s = out.scenarios.front();
  const virtual_lathe::PlannedPass& pass = s.plan.passes.front();
  const double lasted_s =
      (pass.end_mm - pass.start_mm) / pass.feed_mm_per_rev * 60.0 / pass.speed_rpm;
  const auto add = [&](double size_mm, double towards, double turn_rad, double share) {
    const double dx = size_mm * std::cos(towards), dy = size_mm * std::sin(towards);
    out.slip_x_mm += dx, out.slip_y_mm += dy, out.turned_rad += turn_rad;
    s.effects.push_back(
        {"part.slip",
         {{"dx_mm", dx}, {"dy_mm", dy}, {"turn_rad", turn_rad}, {"time_s", share * lasted_s}}});
  };
  if (group == Group::creeping_slip) {
    constexpr int steps = 40;
    const double size = draw.log_between(0.02, 0.1), at = draw.phase();
    const auto law = draw.whole(0, 4);
    const bool all_along = law == 4;  // from the first reading to the last, dying out
    const double from = all_along ? 0.0 : draw.between(0.05, 0.75), lasts = all_along ? 1.0 : 0.2;
    const double rate = all_along ? draw.between(2.0, 8.0) : 4.0;
    double before = 0.0;
    for (int i = 1; i <= steps; ++i) {
      const double u = static_cast<double>(i) / steps;
      const double done = law == 0   ? u
                          : law == 1 ? u * u * (3.0 - 2.0 * u)
                          : law == 3 ? std::floor(4.0 * u) / 4.0
                                     : std::expm1(-rate * u) / std::expm1(-rate);
      if (done > before) add(size * (done - before), at, 0.0, from + lasts * (u - 0.5 / steps));
      before = done;
    }
    return;
  }
  const double size = draw.between(0.01, 0.05), at = draw.phase();
  double share = draw.between(0.2, 0.8);
  if (group == Group::slip_at_an_end) {
    // A quarter of a turn at least is probed after it: what comes later nobody sees.
    share = draw.unit() < 0.5 ? draw.between(0.0, 0.03) : draw.between(0.97, 1.0 - 0.25 / lasted_s);
  }
  add(size, at, group == Group::slip_with_turn ? draw.between(-0.1, 0.1) : 0.0, share);
  if (group == Group::two_slips)
    add(draw.between(0.005, 0.05), draw.phase(), 0.0, draw.between(0.05, 0.95));
  if (group == Group::slip_beside_drift)
    s.effects.push_back({"thermal.drift",
                         {{"rate_mm_per_s", draw.log_between(0.02e-3, 0.3e-3)},
                          {"amplitude_mm", draw.between(0.0, 10.0e-3)},
                          {"time_constant_s", draw.log_between(10.0, 300.0)}}});
}

Drawn draw_job(Group group, std::uint64_t seed, bool slips) {
  Draw draw(seed * 1000003 + static_cast<std::uint64_t>(group));
  Drawn out;
  out.scenarios.push_back(draw_seat(group, draw, 0.0, nullptr));
  if (group == Group::two_references)
    out.scenarios.push_back(
        draw_seat(group, draw, out.scenarios[0].plan.passes[0].end_mm + 10.0, &out.scenarios[0]));
  const virtual_lathe::PlannedPass& last = out.scenarios.back().plan.passes[0];
  if (slips) add_slips(group, draw, out);
  for (const Scenario& s : out.scenarios) {
    JobReference reference;
    reference.name = "seat " + std::to_string(out.job.references.size() + 1);
    reference.fit.surface =
        s.part.kind == virtual_lathe::PartKind::cone ? SurfaceKind::cone : SurfaceKind::cylinder;
    reference.fit.bore = s.part.bore;
    out.job.references.push_back(reference);
  }
  TargetSurface target;  // next to the last seat
  target.radius_mm = 0.5 * out.scenarios[0].part.radius_mm;
  target.bore = out.scenarios[0].part.bore;
  target.z_end_mm = last.end_mm + draw.between(2.0, 10.0);
  target.z_start_mm = target.z_end_mm + draw.between(5.0, 15.0);
  out.job.target = target;
  out.job.tool.feed_mm_per_rev = 1.0;
  out.job.tool.interpolation = Interpolation::linear;
  return out;
}

/// Twice the largest distance of the cut axis from where a reference's axis is, over the cut.
double true_coaxiality(const Drawn& drawn, const Axis& cut) {
  double worst = 0.0;
  for (const Scenario& s : drawn.scenarios) {
    const double n = std::sqrt(1.0 - s.part.l * s.part.l - s.part.m * s.part.m);
    double x = s.part.x0_mm + drawn.slip_x_mm, y = s.part.y0_mm + drawn.slip_y_mm;
    for (const virtual_lathe::Effect& effect : s.effects) {
      if (effect.id != "part.bow") continue;  // its axis is the line nearest to the parabola
      const double away = effect.parameters.at("sagitta_mm") / 3.0;
      x += away * std::cos(effect.parameters.at("direction_rad"));
      y += away * std::sin(effect.parameters.at("direction_rad"));
    }
    for (const double z : {drawn.job.target->z_start_mm, drawn.job.target->z_end_mm}) {
      const auto [cut_x, cut_y] = cut.at(z);
      const double stood_x = x + s.part.l / n * z, stood_y = y + s.part.m / n * z;
      const double cosine = std::cos(drawn.turned_rad), sine = std::sin(drawn.turned_rad);
      worst = std::max(worst, std::hypot(stood_x * cosine - stood_y * sine - cut_x,
                                         stood_x * sine + stood_y * cosine - cut_y));
    }
  }
  return 2.0 * worst;
}

}  // namespace

std::string_view name_of(Group group) {
  constexpr std::string_view names[] = {"one reference",
                                        "two references",
                                        "correlated noise",
                                        "one form or motion",
                                        "two to four of them",
                                        "one or two without t",
                                        "slip",
                                        "slip without t",
                                        "two slips",
                                        "creeping slip",
                                        "slip with drift",
                                        "slip at an end",
                                        "slip with a turn",
                                        "slip in noise of 0.8",
                                        "slip in a bore",
                                        "slip probed from the rear"};
  return names[static_cast<std::size_t>(group)];
}

Outcome judge(Group group, std::uint64_t seed, bool slips) {
  Drawn drawn = draw_job(group, seed, slips);
  std::vector<ProbeStream> streams;
  for (const Scenario& s : drawn.scenarios) {
    streams.push_back(virtual_lathe::simulate(s));
    if (group != Group::without_t && group != Group::slip_without_t) continue;
    streams.back().time_s.clear();
    streams.back().spindle_rpm.reset();
  }
  drawn.job.values_of_form = false;
  const JobResult result = run_job(drawn.job, std::move(streams));
  Outcome out;
  const auto add = [](std::string& list, std::string_view id) {
    if (!list.empty()) list += '+';
    list += id;
  };
  for (const Scenario& s : drawn.scenarios)
    for (const virtual_lathe::Effect& effect : s.effects) add(out.hidden, effect.id);
  for (const auto& diagnosis : result.diagnoses) {
    if (!diagnosis) continue;
    for (const Finding& finding : diagnosis->findings) add(out.found, finding.effect());
    for (std::size_t i = 0; i < diagnosis->unexplained.size(); ++i) add(out.found, "unexplained");
  }
  out.decision = result.verdict.decision;
  if (out.decision == Decision::untoleranced) {  // what a tolerance at the edge adds
    JobResult at_edge = result;
    at_edge.job.coaxiality_tolerance_mm = result.verdict.upper_mm;
    if (decide(at_edge).decision == Decision::not_proven) out.decision = Decision::not_proven;
  }
  out.reserved = !result.verdict.reservations.empty();
  out.upper_mm = result.verdict.upper_mm;
  if (result.target_axis) out.coaxiality_mm = true_coaxiality(drawn, result.target_axis->axis.axis);
  return out;
}

}  // namespace trueaxis::risk

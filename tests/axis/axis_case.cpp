// SPDX-License-Identifier: Apache-2.0
#include "axis/axis_case.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>

#include "axis/draw.hpp"
#include "blind/families.hpp"
#include "blind/size.hpp"
#include "fit/place_set_ups.hpp"
#include "job/doubts.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis::axis {
namespace {

using virtual_lathe::Effect;
using virtual_lathe::Scenario;

constexpr double least_radius_mm = 3.0;
/// In σ², of the sum of squares: what half of all searches find, and what moves no axis.
constexpr double seen = 30.0, harmless = 4.0;

/// The part, and the plan stretched over its length to the wanted number of readings.
void draw_part(Draw& draw, Case& out) {
  out.plan = blind::all_plans()[static_cast<std::size_t>(draw.whole(0, 7))];
  const double kind = draw.unit();
  const bool cone = kind > 0.4;
  Scenario s = blind::plain_scenario(
      out.plan, cone ? blind::SurfaceId::cone : blind::SurfaceId::cylinder, draw.whole(0, 3));
  const double radius = draw.log_between(5.0, 200.0);
  const double length = std::min(draw.log_between(15.0, 120.0), 8.0 * radius);
  out.surface = !cone ? "cylinder" : kind > 0.8 ? "cone above 20 deg" : "cone to 20 deg";
  s.part.radius_mm = radius;
  if (cone) {
    const double angle = (kind > 0.8 ? draw.between(20.0, 60.0) : draw.log_between(0.5, 20.0)) *
                         std::numbers::pi / 180.0;
    const bool grows = draw.unit() < 0.5 ||
                       radius - length * std::tan(angle) < std::max(least_radius_mm, 0.3 * radius);
    s.part.half_angle_rad = grows ? angle : -angle;
  }
  const double e = std::min(draw.log_between(0.005, 0.3), 0.03 * radius),
               tilt = draw.log_between(5e-5, 2e-3);
  const auto place = [&](double& x, double& y, double& l, double& m) {
    x *= e / blind::eccentricity_mm, y *= e / blind::eccentricity_mm;
    l *= tilt / blind::tilt_rad, m *= tilt / blind::tilt_rad;
  };
  place(s.part.x0_mm, s.part.y0_mm, s.part.l, s.part.m);
  for (virtual_lathe::Chucking& setup : s.plan.setups)
    if (setup.x0_mm) place(*setup.x0_mm, *setup.y0_mm, *setup.l, *setup.m);
  out.side = "shaft";
  if (draw.unit() < 0.25)
    s.part.bore = true, out.side = "bore";
  else if (draw.unit() < 0.15 && s.plan.setups.empty()) {
    virtual_lathe::Chucking behind;
    behind.rear = true;
    s.plan.setups.push_back(behind);
    out.side = "rear";
  }
  const double wanted = draw.log_between(96.0, 12000.0), per_turn = draw.between(9.3, 36.7);
  double now = 0.0;
  for (virtual_lathe::PlannedPass& pass : s.plan.passes) {
    const bool runs = pass.start_mm != pass.end_mm;
    const double turns =
        runs ? std::abs(pass.end_mm - pass.start_mm) / pass.feed_mm_per_rev : pass.revolutions;
    now += pass.speed_rpm == 0.0 ? pass.duration_s * pass.rate_hz : turns * per_turn;
  }
  const double more = wanted / now;
  for (virtual_lathe::PlannedPass& pass : s.plan.passes) {
    pass.start_mm *= length / blind::end_mm, pass.end_mm *= length / blind::end_mm;
    pass.feed_mm_per_rev *= length / blind::end_mm / more;
    pass.revolutions *= more, pass.rate_hz *= more;
    pass.readings_per_revolution = per_turn;
    pass.jitter = 0.2;
  }
  s.u_start_mm = 0.0, s.u_end_mm = length;
  out.low_mm = 0.0, out.high_mm = length;
  out.scenario = std::move(s);
}

void draw_noise(Draw& draw, Case& out) {
  virtual_lathe::Noise noise;
  noise.sigma_mm = draw.between(0.5, 2.0) * 1e-3;
  const double kind = draw.unit();
  out.noise = kind < 0.55 ? "white" : kind < 0.75 ? "AR(1)" : kind < 0.9 ? "outliers" : "rounded";
  if (out.noise == "AR(1)") noise.rho = draw.between(0.2, 0.8);
  if (out.noise == "outliers") {
    noise.outlier_fraction = draw.between(0.003, 0.02);
    noise.outlier_size_mm = noise.sigma_mm * draw.log_between(10.0, 100.0);
    noise.outliers_one_sided = draw.unit() < 0.5;
  }
  if (out.noise == "rounded") noise.quantisation_mm = draw.log_between(1e-4, 2e-3);
  out.scenario.noise = noise;
  out.scenario.probe.states_noise = false;
  out.scenario.seed = draw.random();
}

void fit_to(const Case& of, Effect& effect) {
  auto& p = effect.parameters;
  if (effect.id == "part.bow") {
    p["length_mm"] = of.high_mm - of.low_mm;
    p["middle_mm"] = 0.5 * (of.low_mm + of.high_mm);
  }
  if (effect.id == "extra.dent") {
    const double scale = (of.high_mm - of.low_mm) / blind::end_mm;
    p["position_mm"] *= scale, p["length_mm"] *= scale;
  }
}

/// A ball that nobody compensated moves all readings: the sensor is set anew to where they are, for
/// beyond its range its cubic error is not that of a sensor.
void set_sensor(const blind::Bench& bench, std::vector<Effect>& list) {
  const auto ball = std::ranges::find(list, "probe.ball_radius", &Effect::id);
  if (ball == list.end()) return;
  const double before = bench.plain().cwiseAbs().mean();
  const double after = (bench.plain() + bench.change({*ball})).cwiseAbs().mean();
  for (Effect& effect : list)
    if (effect.id == "probe.nonlinearity" || effect.id == "probe.gain")
      effect.parameters["reference_mm"] += after - before;
}

/// Whether the plan would show the effect at the largest size that is typical of it, or the effect
/// does nothing at its own.
bool shows(const blind::Bench& bench, const Effect& effect, const Effect& largest,
           double sigma_mm) {
  const double variance = sigma_mm * sigma_mm;
  return bench.change({effect}).squaredNorm() < harmless * variance ||
         bench.surface().residual(bench.change({largest})).squaredNorm() > seen * variance;
}

Effect draw_outside(Draw& draw, const Case& of, const blind::Bench& bench) {
  const double length = of.high_mm - of.low_mm, a = draw.log_between(1e-3, 0.02);
  switch (draw.whole(0, 4)) {
    case 0:  // lobes that twist along the axis
      return {"extra.spiral",
              {{"order", draw.whole(2, 6)},
               {"amplitude_mm", a},
               {"lead_mm", draw.between(0.4, 1.5) * length},
               {"phase_rad", draw.phase()}}};
    case 1: {
      Effect dent = blind::draw_effect("extra.dent", bench, draw.random);
      dent.parameters["depth_mm"] = 3.0 * a;
      fit_to(of, dent);
      return dent;
    }
    case 2:
      return {"extra.beat",
              {{"order", draw.whole(2, 6)},
               {"amplitude_mm", a},
               {"beat_hz", draw.between(0.03, 0.4)},
               {"phase_rad", draw.phase()}}};
    case 3:  // a step of the diameter
      return {"extra.ledge",
              {{"amplitude_mm", a}, {"position_mm", of.low_mm + draw.between(0.2, 0.8) * length}}};
    default:  // marks of a tool with two edges
      return {"extra.form_line",
              {{"order", 2.0},
               {"amplitude_mm", a},
               {"phase_rad", draw.phase()},
               {"period_mm", draw.log_between(0.1, 0.5)}}};
  }
}

void draw_effects(Draw& draw, Case& out) {
  const blind::Bench bench(out.scenario);
  const double sigma = out.scenario.noise.sigma_mm;
  std::vector<Effect>& list = out.scenario.effects;
  const int count = out.group == Group::slip      ? draw.whole(1, 3)
                    : out.group == Group::outside ? draw.whole(0, 2)
                    : out.group >= Group::noise   ? 0
                                                  : draw.whole(2, 6);
  for (int tries = 0; static_cast<int>(list.size()) < count && tries < 300; ++tries) {
    const auto& family =
        blind::families()[static_cast<std::size_t>(draw.whole(0, 28)) % blind::families().size()];
    if (family.id == "part.slip" || std::ranges::find(list, family.id, &Effect::id) != list.end())
      continue;
    Effect largest = blind::draw_effect(family.id, bench, draw.random);
    fit_to(out, largest);
    Effect effect = blind::of_typical_size(largest, [&] { return draw.unit(); });
    if (out.group == Group::absorbed || shows(bench, effect, largest, sigma))
      list.push_back(std::move(effect));
  }
  set_sensor(bench, list);
  if (out.group == Group::outside) list.push_back(draw_outside(draw, out, bench));
  if (out.group == Group::slip) {
    const double size = draw.log_between(0.01, 0.2), at = draw.phase();
    const bool turns = draw.unit() < 0.15;
    list.push_back({"part.slip",
                    {{"time_s", draw.between(0.1, 0.9) * bench.time_s().maxCoeff()},
                     {"dx_mm", turns ? 0.0 : size * std::cos(at)},
                     {"dy_mm", turns ? 0.0 : size * std::sin(at)},
                     {"turn_rad", turns ? draw.log_between(0.01, 0.1) : 0.0}}});
  }
}

}  // namespace

std::string_view name_of(Group group) {
  constexpr std::string_view names[] = {"mixture", "slip", "outside", "absorbed", "noise", "known"};
  return names[static_cast<std::size_t>(group)];
}

Case draw_case(Group group, std::uint64_t seed) {
  constexpr std::uint64_t most_draws = 20;
  for (std::uint64_t again = 0;; ++again) {
    Draw draw(seed * 16 + static_cast<std::uint64_t>(group) + (again << 40U));
    Case out;
    out.group = group, out.seed = seed;
    try {
      draw_part(draw, out);
      draw_noise(draw, out);
      draw_effects(draw, out);
      place_set_ups(virtual_lathe::simulate(out.scenario));
      return out;
    } catch (const InputError&) {  // the probe would miss, or the axis is outside: another
      if (again == most_draws) throw;
    }
  }
}

std::array<double, 4> true_ends(const Case& of) {
  const Scenario& s = of.scenario;
  double x = s.part.x0_mm, y = s.part.y0_mm, l = s.part.l, m = s.part.m, reindex = 0.0;
  const int last = s.plan.passes.back().setup;
  for (const virtual_lathe::Chucking& setup : s.plan.setups) {
    if (setup.x0_mm) x = *setup.x0_mm, y = *setup.y0_mm, l = *setup.l, m = *setup.m;
    reindex = setup.reindex_rad;
    if (setup.number == last) break;
  }
  const double n = std::sqrt(1.0 - l * l - m * m);
  double slope_x = l / n, slope_y = m / n, turn = 0.0;
  for (const Effect& effect : s.effects) {
    const auto& p = effect.parameters;
    if (effect.id == "part.bow") {
      // κ(s − middle)² is κ L²/12 at the nearest straight line, all over the length.
      const double away = p.at("sagitta_mm") / 3.0, at = p.at("direction_rad") - reindex;
      x += away * std::cos(at), y += away * std::sin(at);
    }
    if (effect.id == "encoder.offset") turn -= p.at("angle_rad");
    if (effect.id == "part.slip") x += p.at("dx_mm"), y += p.at("dy_mm"), turn += p.at("turn_rad");
  }
  std::array<double, 4> out{};
  for (const int end : {0, 1}) {
    const double z = end == 0 ? of.low_mm : of.high_mm;
    const double at_x = x + slope_x * z, at_y = y + slope_y * z;
    out[static_cast<std::size_t>(2 * end)] = at_x * std::cos(turn) - at_y * std::sin(turn);
    out[static_cast<std::size_t>(2 * end + 1)] = at_x * std::sin(turn) + at_y * std::cos(turn);
  }
  return out;
}

double Judged::rms_mm() const {
  double sum = 0.0;
  for (const double e : error_mm) sum += e * e;
  return std::sqrt(0.5 * sum);
}

double Judged::u_rms_mm() const {
  double sum = 0.0;
  for (const double u : u_mm) sum += u * u;
  return std::sqrt(0.5 * sum);
}

int Judged::covered() const {
  int count = 0;
  for (std::size_t i = 0; i < 4; ++i) count += std::abs(error_mm[i]) <= 2.0 * u_mm[i];
  return count;
}

double Judged::interval_score_mm() const {
  constexpr double alpha = 0.05;
  double sum = 0.0;
  for (std::size_t i = 0; i < 4; ++i) {
    const double half = 2.0 * u_mm[i], outside = std::abs(error_mm[i]) - half;
    sum += 2.0 * half + 2.0 / alpha * std::max(0.0, outside);
  }
  return 0.25 * sum;
}

Judged judge(const Case& of, const AxisEstimate& axis) {
  const std::array<double, 4> truth = true_ends(of);
  Judged out;
  for (const int end : {0, 1}) {
    const double z = end == 0 ? of.low_mm : of.high_mm, lever = z - axis.axis.z_ref_mm;
    const std::array<double, 2> at = axis.axis.at(z);
    for (const int c : {0, 1}) {
      const auto i = static_cast<std::size_t>(2 * end + c), k = static_cast<std::size_t>(c);
      const auto cov = [&](std::size_t a, std::size_t b) {
        return axis.covariance.by_rows[a * 4 + b];
      };
      out.error_mm[i] = at[k] - truth[i];
      out.u_mm[i] = std::sqrt(std::max(
          0.0, cov(k, k) + 2.0 * lever * cov(k, k + 2) + lever * lever * cov(k + 2, k + 2)));
    }
  }
  return out;
}

Diagnosis diagnosed(const Case& of, const ProbeStream& stream) {
  DiagnoseOptions options;
  options.threads = 1;
  options.fit.surface = of.surface == "cylinder" ? SurfaceKind::cylinder : SurfaceKind::cone;
  options.fit.bore = of.scenario.part.bore;
  if (of.group == Group::known)
    for (const InfluenceInfo& info : influence_catalogue())
      if (info.has_value) options.fit.influences.push_back({info.kind, 0.0});
  return diagnose(stream, options);
}

Outcome run_case(Group group, std::uint64_t seed) {
  Outcome out;
  out.made = draw_case(group, seed);
  const ProbeStream stream = virtual_lathe::simulate(out.made.scenario);
  out.readings = stream.size();
  const auto start = std::chrono::steady_clock::now();
  const Diagnosis diagnosis = diagnosed(out.made, stream);
  out.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  out.ideal = judge(out.made, diagnosis.baseline.axis);
  out.extended = judge(out.made, diagnosis.extended.axis);
  out.stated = diagnosis.extended.axis_known() && !why_axis_unknown(stream, diagnosis);
  const auto add = [](std::string& list, const std::string& id) {
    list += list.empty() ? id : '+' + id;
  };
  for (const Effect& effect : out.made.scenario.effects) add(out.hidden, effect.id);
  for (const Finding& finding : diagnosis.findings) add(out.found, finding.effect());
  for (std::size_t k = 0; k < diagnosis.unexplained.size(); ++k) add(out.found, "unexplained");
  return out;
}

}  // namespace trueaxis::axis

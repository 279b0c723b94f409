// SPDX-License-Identifier: Apache-2.0
#include "studies/axis_bias/axis_bias_cases.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "simulate/clean_stream.hpp"
#include "study/bound/bound.hpp"
#include "study/bound/quantities.hpp"
#include "trueaxis/effect.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis::study {
namespace {

// Small against what bends the readings' dependence on them: R/n² for lengths, 1 for angles; those
// of a length are AxisBiasCase's.
constexpr double small_rad = 1e-4, small_s = 1e-4, small_share = 1e-3;
constexpr double small_slope_rad = 1e-5;

/// What the plan gives the shapes.
struct Where {
  double low_mm, high_mm;      ///< of the contacts, along the part's axis
  double z_low_mm, z_high_mm;  ///< probed
  double x_mm, range_mm, duration_s;
  double middle_radius_mm, tangent;
  bool cone;
  double length_mm() const { return high_mm - low_mm; }
  double middle_mm() const { return 0.5 * (low_mm + high_mm); }
};

Where where_of(const virtual_lathe::Scenario& scenario) {
  const ProbeStream stream = virtual_lathe::simulate_clean(scenario).stream;
  refuse_moving_axis(scenario, stream, "axis-bias");
  FitOptions options;
  options.surface = surface_of(scenario.part.kind);
  options.bore = scenario.part.bore;
  const EffectOnAxis about = effect_on_axis(stream, options, {"probe.ball_radius", {}, {}});
  const Revolved& shape = about.alone.shape;
  const auto [least, most] = std::ranges::minmax(stream.reading_mm);
  return {about.z_mid_mm - about.z_half_mm,
          about.z_mid_mm + about.z_half_mm,
          about.alone.position_min_mm,
          about.alone.position_max_mm,
          about.sensed_mid_mm,
          std::max(0.5, 0.5 * (most - least)),
          stream.time_s.back() - stream.time_s.front(),
          shape.radius_mm + shape.tan_half_angle * (about.z_mid_mm - shape.axis.z_ref_mm),
          shape.tan_half_angle,
          scenario.part.kind == virtual_lathe::PartKind::cone};
}

/// @param free which linear parameters are fitted, and of size 1 in turn; empty: all
AxisBiasCase mm(const char* effect, const char* form, const TermShape& shape = {},
                const std::vector<std::size_t>& free = {}) {
  AxisBiasCase out{effect, form, {effect, shape, free}, {}};
  const std::size_t columns =
      free.empty() ? linear_parameters(find_effect(effect)->term, shape).size() : free.size();
  for (std::size_t j = 0; j < columns; ++j) {
    out.directions.push_back({std::vector<double>(columns)});
    const bool sine = find_effect(effect)->line && j == 1;  // of the phase +90°: −1
    out.directions.back().linear[j] = sine ? -1.0 : 1.0;
  }
  return out;
}

AxisBiasCase unit(AxisBiasCase of, double size, const char* name, double edge = 1.0) {
  of.size = size, of.unit = std::string(name), of.edge = edge;
  return of;
}

AxisBiasCase angle(AxisBiasCase of, double size = small_rad) {
  return unit(std::move(of), size, "deg", 1.0 / rad_per_deg);
}

/// A bend that starts at the lower end: (1 + u)²/4 = 1/4 + u/2 + u²/4, of which the first two are
/// another place of the part. Sections that are displaced by a + b s and not turned are those of a
/// cone turned by θ = b/(1 + tan²α) and displaced by a − R θ tanα.
AxisBiasCase bow_from_the_end(const Where& at) {
  const double turned = 1.0 / at.length_mm() / (1.0 + at.tangent * at.tangent);
  const double displaced = 1.0 / 3.0 - at.middle_radius_mm * turned * at.tangent;
  const auto moved = [&](double z) { return displaced + turned * (z - at.middle_mm()); };
  const double low = moved(at.z_low_mm), high = moved(at.z_high_mm);
  const auto bow = [&](double direction_rad) {
    return [=](double sagitta_mm) {
      return virtual_lathe::Effect{"part.bow",
                                   {{"sagitta_mm", sagitta_mm},
                                    {"length_mm", 2.0 * at.length_mm()},
                                    {"middle_mm", at.low_mm},
                                    {"direction_rad", direction_rad}}};
    };
  };
  AxisBiasCase out = mm("part.bow", "from the lower end");
  out.directions = {{{0.25, 0.0}, {low, 0.0, high, 0.0}, bow(0.0)},
                    {{0.0, 0.25}, {0.0, low, 0.0, high}, bow(0.25 * two_pi)}};
  return out;
}

AxisBiasCase chuck_lobing(const Where& at) {
  const double ring = std::pow((9.0 - 1.0) / (36.0 - 1.0), 2);  // second harmonic of three jaws
  AxisBiasCase out = mm("part.chuck_lobing", "three jaws",
                        {.order = 3, .lever_from_mm = at.low_mm - 5.0, .decay_length_mm = 40});
  out.directions = {{{1.0, 0.0, ring, 0.0}}, {{0.0, 1.0, -ring, 0.0}}};  // twice the phase: cos π
  return out;
}

std::vector<AxisBiasCase> part_cases(const Where& at) {
  const double length = at.length_mm(), half_way = 0.5 * at.duration_s;
  std::vector<AxisBiasCase> out{
      chuck_lobing(at),
      mm("part.roundness", "ovality", {.order = 2}, {0, 1}),
      mm("part.roundness", "three lobes", {.order = 3}, {0, 1}),
      mm("part.roundness", "ovality growing with u", {.order = 2}, {2, 3}),
      mm("part.barrel", "P2", {}, {0}),
      mm("part.barrel", "P3", {}, {1}),
      mm("part.end_form", "at the lower end, a tenth of the length",
         {.decay_length_mm = length / 10}, {0}),
      mm("part.waviness", "7.3 waves", {.period_mm = length / 7.3}),
      mm("part.feed_marks", "0.173 mm/rev", {.period_mm = 0.173}),
      mm("part.bow", "over the probed length"),
      bow_from_the_end(at),
      mm("part.slip", "radial, half-way", {.onset_s = half_way}, {0, 1}),
      mm("part.slip", "radial, at two thirds", {.onset_s = 2.0 / 3.0 * at.duration_s}, {0, 1}),
      angle(mm("part.slip", "rotational, half-way", {.onset_s = half_way}, {2})),
      mm("part.creep", "radial, tau a third of the pass",
         {.duration_s = at.duration_s, .settling_s = at.duration_s / 3.0}, {0, 1})};
  if (!at.cone) out.push_back(mm("part.taper", ""));
  return out;
}

std::vector<AxisBiasCase> face_cases(const Where& at) {
  const double half_way = 0.5 * at.duration_s;
  return {
      mm("part.face_saddle", ""),
      mm("part.face_lobes", "three lobes", {.order = 3}, {0, 1}),
      mm("part.face_lobes", "ovality growing with u", {.order = 2}, {2, 3}),
      mm("part.face_cone", ""),
      mm("part.face_crown", "dish", {}, {0}),
      mm("part.face_crown", "P2", {}, {1}),
      mm("part.face_crown", "P3", {}, {2}),
      mm("part.waviness", "7.3 waves", {.period_mm = at.length_mm() / 7.3}),
      mm("part.feed_marks", "0.173 mm/rev", {.period_mm = 0.173}),
      mm("part.face_spiral", "0.173 mm/rev", {.period_mm = 0.173}),
      mm("part.seat_slip", "along Z, half-way", {.onset_s = half_way}, {0}),
      angle(mm("part.seat_slip", "tilt, half-way", {.onset_s = half_way}, {1, 2}), small_slope_rad),
      mm("spindle.axial_fundamental", ""),
      mm("spindle.axial_asynchronous", "0.43 per revolution", {.order = 0.43}),
      angle(mm("spindle.face_tilt", "2 UPR", {.order = 2}, {0, 1}), small_slope_rad),
      angle(mm("slide.xz_squareness", ""), small_slope_rad),
      mm("slide.x_straightness", "P2", {.degree = 2}, {1})};
}

std::vector<AxisBiasCase> machine_cases(const Where& at) {
  constexpr double bearing_mm = -250.0;
  AxisBiasCase rate =
      mm("thermal.drift", "linear, over the measurement", {.time_constant_s = 600}, {0});
  rate.directions = {{{1.0 / at.duration_s}}};
  return {mm("spindle.radial_synchronous", "2 UPR", {.order = 2}),
          angle(mm("spindle.tilt_synchronous", "2 UPR, bearing at Z = -250",
                   {.order = 2, .lever_from_mm = bearing_mm}, {0, 1}),
                small_slope_rad),
          mm("spindle.axial_synchronous", "2 UPR", {.order = 2}),
          mm("spindle.asynchronous", "0.43 per revolution", {.order = 0.43}),
          mm("slide.z_straightness", "P2", {.degree = 2}),
          angle(mm("slide.xz_parallelism", ""), small_slope_rad),
          mm("slide.leadscrew_periodic", "7.3 periods", {.period_mm = at.length_mm() / 7.3}),
          mm("slide.backlash", "along", {}, {0}),
          mm("slide.backlash", "across", {}, {1}),
          angle(mm("encoder.offset", "")),
          angle(mm("encoder.eccentricity", "")),
          rate,
          mm("thermal.drift", "exponential, a third of the time",
             {.time_constant_s = at.duration_s / 3}, {1}),
          mm("environment.vibration", "7.3 Hz", {.frequency_hz = 7.3})};
}

std::vector<AxisBiasCase> probe_cases(const Where& at) {
  const TermShape sensed{.reference_x_mm = at.x_mm, .range_mm = at.range_mm};
  // The column is that of a lag of 0.
  AxisBiasCase lag = unit(mm("probe.lag", "", {.time_constant_s = 0.0}), small_s, "s");
  lag.directions.front().lathe = [](double time_constant_s) {
    return virtual_lathe::Effect{"probe.lag", {{"time_constant_s", time_constant_s}}};
  };
  return {mm("probe.height", ""),
          angle(mm("probe.tilt", ""), small_slope_rad),
          mm("probe.ball_radius", ""),
          mm("probe.pretravel", "constant", {}, {0}),
          mm("probe.pretravel", "three lobes", {.order = 3}, {1, 2}),
          mm("probe.x_zero", ""),
          unit(mm("probe.gain", "", sensed), small_share, "1"),
          mm("probe.nonlinearity", "quadratic", sensed, {0}),
          mm("probe.nonlinearity", "cubic", sensed, {1}),
          mm("probe.cyclic", "0.137 mm", {.period_mm = 0.137}),
          unit(mm("probe.latency", ""), small_s, "s"),
          lag};
}

/// The catalogue's figure goes to the form that it is of.
void add_stated(std::vector<AxisBiasCase>& cases) {
  constexpr double three_lobes = 0.008;  // in words next to the figure of ovality
  const std::map<std::string_view, std::string_view> form_of{
      {"part.roundness", "ovality"},
      {"part.bow", "from the lower end"},
      {"part.slip", "radial, at two thirds"}};
  std::string before;
  for (AxisBiasCase& one : cases) {
    const trueaxis::Effect* effect = find_effect(one.effect);
    const auto named = form_of.find(one.effect);
    const bool figure = named != form_of.end() ? one.form == named->second : one.effect != before;
    if (effect->axis_bias && figure) one.stated = effect->axis_bias->value;
    if (one.effect == "part.roundness" && one.form == "three lobes") one.stated = three_lobes;
    before = one.effect;
  }
}

}  // namespace

std::vector<AxisBiasCase> axis_bias_cases(const virtual_lathe::Scenario& scenario) {
  virtual_lathe::Scenario ideal = scenario;
  ideal.effects.clear();
  ideal.noise = {};
  const Where at = where_of(ideal);
  const bool face = scenario.part.kind == virtual_lathe::PartKind::face;
  std::vector<AxisBiasCase> all = face ? face_cases(at) : part_cases(at);
  for (const auto& more : {machine_cases(at), probe_cases(at)})
    all.insert(all.end(), more.begin(), more.end());
  const StreamKind kind = face ? StreamKind::face : StreamKind::lateral;
  std::erase_if(all, [&](const AxisBiasCase& one) {
    return find_effect(one.effect)->needs.stream.value_or(kind) != kind;
  });
  if (!face) add_stated(all);
  return all;
}

virtual_lathe::Scenario axis_bias_reference() {
  // The figures leave the direction of the tilt open; with this angle to the eccentricity the axis
  // is 0.2244 mm off the spindle's at Z = 60 mm, which 1.41 µm per ms at 60 rpm asks for.
  constexpr double tilt_rad = 1e-3, away_rad = 1.285;
  virtual_lathe::Scenario scenario;
  scenario.name = "axis_bias";
  scenario.part.kind = virtual_lathe::PartKind::cone;
  scenario.part.half_angle_rad = std::atan(0.1);
  scenario.part.radius_mm = 40.0;
  scenario.part.x0_mm = 0.2;
  scenario.part.l = tilt_rad * std::cos(away_rad);
  scenario.part.m = tilt_rad * std::sin(away_rad);
  virtual_lathe::PlannedPass pass;
  pass.end_mm = 60.0;
  pass.feed_mm_per_rev = 0.77;
  pass.readings_per_revolution = 40.3;
  scenario.plan.passes = {pass};
  return scenario;
}

}  // namespace trueaxis::study

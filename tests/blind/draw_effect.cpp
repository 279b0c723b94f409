// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <numbers>

#include "blind/by_entry.hpp"
#include "blind/families.hpp"
#include "trueaxis/virtual_lathe.hpp"

namespace trueaxis::blind {
namespace {

/// Numbers that are the same with every standard library.
class Draw {
 public:
  explicit Draw(std::mt19937_64& random) : random_(random) {}
  double unit() { return static_cast<double>(random_() >> 11U) * 0x1p-53; }
  double between(double low, double high) { return low + (high - low) * unit(); }
  double log_between(double low, double high) { return low * std::pow(high / low, unit()); }
  double whole(int low, int high) { return std::floor(between(low, high + 1.0)); }
  double sign() { return unit() < 0.5 ? -1.0 : 1.0; }
  double phase() { return between(-std::numbers::pi, std::numbers::pi); }

 private:
  std::mt19937_64& random_;
};

constexpr double highest_order = 11.0;  // below half of 23.7 readings per revolution

// A cage below one half, or anything that is clearly no whole number.
double fractional_order(Draw& draw) {
  if (draw.unit() < 0.5) return draw.between(0.40, 0.45);
  return draw.whole(1, 10) + draw.between(0.12, 0.88);
}

double largest_lead(const Bench& bench) {
  double lead = 0.0;
  for (const auto& pass : bench.scenario().plan.passes) {
    if (pass.start_mm != pass.end_mm) lead = std::max(lead, pass.feed_mm_per_rev);
  }
  return lead;
}

Effect draw_part(std::string_view id, const Bench& bench, Draw& draw) {
  if (id == "part.chuck_lobing") {
    return {"part.chuck_lobing",
            {{"jaws", draw.whole(2, 4)},
             {"jaw_angle_rad", draw.phase()},
             {"decay_length_mm", draw.log_between(10.0, 60.0)},
             {"jaw_position_mm", draw.between(-5.0, 0.0)}}};
  }
  if (id == "part.roundness") {
    const bool grows = draw.unit() < 0.5;
    return {"part.roundness",
            {{"order", draw.whole(2, 11)},
             {"growth_mm", grows ? 0.02 * draw.between(-1.0, 1.0) : 0.0},
             {"phase_rad", draw.phase()}}};
  }
  if (id == "part.barrel") {
    return {"part.barrel", {{"cubic_mm", draw.unit() < 0.5 ? 0.0 : draw.between(-0.01, 0.01)}}};
  }
  if (id == "part.waviness") {
    return {"part.waviness",
            {{"wavelength_mm", draw.log_between(3.0, 20.0)}, {"phase_rad", draw.phase()}}};
  }
  if (id == "part.feed_marks") {  // order lead/feed − 1 or + 1 below half the sampling
    const double least = std::max(0.05, largest_lead(bench) / (highest_order - 1.0));
    return {"part.feed_marks",
            {{"feed_mm_per_rev", draw.log_between(least, std::max(0.5, 1.5 * least))},
             {"phase_rad", draw.phase()}}};
  }
  if (id == "part.bow") {
    return {"part.bow",
            {{"length_mm", end_mm - start_mm},
             {"middle_mm", 0.5 * (start_mm + end_mm)},
             {"direction_rad", draw.phase()}}};
  }
  if (id == "part.slip") {
    const double last = duration_s(bench.scenario().plan), when = draw.between(0.15, 0.85) * last;
    if (draw.unit() < 0.3) {
      return {"part.slip",
              {{"time_s", when}, {"dx_mm", 0.0}, {"dy_mm", 0.0}, {"turn_rad", 0.1 * draw.sign()}}};
    }
    const double at = draw.phase();
    return {"part.slip",
            {{"time_s", when},
             {"dx_mm", 0.2 * std::cos(at)},
             {"dy_mm", 0.2 * std::sin(at)},
             {"turn_rad", 0.0}}};
  }
  if (id == "part.creep") {
    const double at = draw.phase();
    return {"part.creep",
            {{"settling_s", draw.log_between(0.1, 0.6) * duration_s(bench.scenario().plan)},
             {"dx_mm", 0.02 * std::cos(at)},
             {"dy_mm", 0.02 * std::sin(at)}}};
  }
  return {std::string(id), {}};
}

Effect draw_machine(std::string_view id, Draw& draw) {
  Effect effect{std::string(id), {}};
  auto& p = effect.parameters;
  if (id == "spindle.radial_synchronous" || id == "spindle.axial_synchronous" ||
      id == "spindle.tilt_synchronous") {
    p["order"] = draw.whole(2, 11);
  }
  if (id == "spindle.tilt_synchronous") p["bearing_mm"] = draw.between(-300.0, -30.0);
  if (id == "spindle.asynchronous") p["order"] = fractional_order(draw);
  if (id == "slide.z_straightness") p["degree"] = draw.whole(2, 4);
  if (id == "slide.leadscrew_periodic") p["pitch_mm"] = draw.log_between(3.0, 20.0);
  if (id == "slide.backlash") {
    const double kind = draw.unit();
    p["along_mm"] = kind < 0.33 ? 0.0 : 0.02 * draw.sign();
    p["across_mm"] = kind > 0.67 ? 0.0 : 0.02 * draw.sign();
  }
  if (id == "thermal.drift") {
    const bool linear = draw.unit() < 0.5;
    p["rate_mm_per_s"] = linear ? 0.01 / 600.0 * draw.sign() : 0.0;
    p["amplitude_mm"] = linear ? 0.0 : 0.01 * draw.sign();
    p["time_constant_s"] = draw.log_between(60.0, 600.0);
  }
  if (id == "environment.vibration") p["frequency_hz"] = draw.between(1.0, highest_order);
  return effect;
}

Effect draw_probe(std::string_view id, const Bench& bench, Draw& draw) {
  Effect effect{std::string(id), {}};
  auto& p = effect.parameters;
  const double nearest = bench.plain().cwiseAbs().minCoeff();
  const double farthest = bench.plain().cwiseAbs().maxCoeff(), half = 0.5 * (farthest - nearest);
  if (id == "probe.gain" || id == "probe.nonlinearity") {
    p["reference_mm"] = 0.5 * (nearest + farthest) + 0.2 * half * draw.between(-1.0, 1.0);
  }
  if (id == "probe.nonlinearity") {
    const double kind = draw.unit();
    p["range_mm"] = std::max(0.5, 1.2 * half);
    p["quadratic_mm"] = kind < 0.33 ? 0.0 : 0.01 * draw.sign();
    p["cubic_mm"] = kind > 0.67 ? 0.0 : 0.01 * draw.sign();
  }
  if (id == "probe.cyclic") p["period_mm"] = draw.log_between(0.1, 1.0);
  if (id == "probe.pretravel") {
    p["lobing_mm"] = 0.01 * draw.unit();
    p["order"] = 3.0;
  }
  return effect;
}

Effect draw_extra(std::string_view id, Draw& draw) {
  Effect effect{std::string(id), {}};
  auto& p = effect.parameters;
  if (id == "extra.spiral") {
    p["order"] = draw.whole(2, 6);
    p["lead_mm"] = draw.between(25.0, 90.0) * draw.sign();
  } else if (id == "extra.dent") {
    p["angle_rad"] = draw.phase();
    p["position_mm"] = draw.between(12.0, 48.0);
    p["width_rad"] = draw.between(0.25, 0.5);
    p["length_mm"] = draw.between(4.0, 9.0);
  } else {
    p["order"] = draw.whole(2, 6);
    p["beat_hz"] = draw.between(0.03, 0.4);
  }
  return effect;
}

bool has(const Effect& effect, std::string_view name) {
  for (const auto& parameter : virtual_lathe::find_effect_kind(effect.id).parameters) {
    if (parameter.name == name) return true;
  }
  return false;
}

}  // namespace

Effect draw_effect(std::string_view id, const Bench& bench, std::mt19937_64& random) {
  Draw draw(random);
  Effect effect = id.starts_with("extra.")   ? draw_extra(id, draw)
                  : id.starts_with("part.")  ? draw_part(id, bench, draw)
                  : id.starts_with("probe.") ? draw_probe(id, bench, draw)
                                             : draw_machine(id, draw);
  if (const ByEntry* known = known_by_entry(id); known && !known->shape.empty())
    effect.parameters[std::string(known->shape)] = known->value(draw.unit());
  for (const Size& size : family(id).sizes) {
    effect.parameters.try_emplace(std::string(size.name), size.typical_most);
  }
  if (has(effect, "phase_rad")) effect.parameters.try_emplace("phase_rad", draw.phase());
  return effect;
}

}  // namespace trueaxis::blind

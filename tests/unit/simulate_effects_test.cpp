// SPDX-License-Identifier: Apache-2.0
// Each effect against its signature in docs/reference/effects.md, written down independently.
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>
#include <string>

#include "trueaxis/error.hpp"
#include "trueaxis/units.hpp"
#include "trueaxis/virtual_lathe.hpp"

namespace trueaxis::virtual_lathe {
namespace {

constexpr double radius_mm = 40.0, tangent = 0.1;

// Out over Z −20 … 20 at 60 rpm: centred cylinder or cone, 24 readings per revolution.
Scenario helix(PartKind kind) {
  Scenario scenario;
  scenario.part.kind = kind;
  scenario.part.radius_mm = radius_mm;
  if (kind == PartKind::cone) scenario.part.half_angle_rad = std::atan(tangent);
  PlannedPass pass;
  pass.start_mm = -20.0;
  pass.end_mm = 20.0;
  pass.feed_mm_per_rev = 1.0;
  pass.readings_per_revolution = 24.0;
  scenario.plan.passes = {pass};
  return scenario;
}

struct At {
  double c, z, t, u;
};

// Largest |change by the effect − expected(C, Z, t, u)| over the stream.
template <class Expected>
double worst(Scenario scenario, const Effect& effect, const Expected& expected) {
  const ProbeStream before = simulate(scenario);
  scenario.effects.push_back(effect);
  const ProbeStream after = simulate(scenario);
  double worst_mm = 0.0;
  for (std::size_t i = 0; i < after.size(); ++i) {
    const At at{after.c_rad[i], after.position_mm[i], after.time_s[i], after.position_mm[i] / 20.0};
    const double change = after.reading_mm[i] - before.reading_mm[i];
    worst_mm = std::max(worst_mm, std::abs(change - expected(at)));
  }
  return worst_mm;
}

constexpr double a = 0.01;          // amplitude of the effects below, mm
constexpr double exact_mm = 1e-12;  // centred parts: no second order

TEST(SimulateEffects, FormsOfACentredCylinderAreReadAsTheyAre) {
  const Scenario cylinder = helix(PartKind::cylinder);
  EXPECT_LT(worst(cylinder,
                  {"part.roundness",
                   {{"order", 3}, {"amplitude_mm", a}, {"growth_mm", 0.5 * a}, {"phase_rad", 0.4}}},
                  [](const At& at) { return (a + 0.5 * a * at.u) * std::cos(3 * at.c - 0.4); }),
            exact_mm);
  EXPECT_LT(worst(cylinder, {"part.barrel", {{"amplitude_mm", a}, {"cubic_mm", a}}},
                  [](const At& at) {
                    return a * (3 * at.u * at.u - 1) / 2 +
                           a * (5 * at.u * at.u * at.u - 3 * at.u) / 2;
                  }),
            exact_mm);
  EXPECT_LT(
      worst(cylinder, {"part.taper", {{"amplitude_mm", a}}}, [](const At& at) { return a * at.u; }),
      exact_mm);
  EXPECT_LT(worst(cylinder, {"part.waviness", {{"amplitude_mm", a}, {"wavelength_mm", 3.0}}},
                  [](const At& at) { return a * std::cos(two_pi * at.z / 3.0); }),
            exact_mm);
  EXPECT_LT(worst(cylinder, {"part.feed_marks", {{"amplitude_mm", a}, {"feed_mm_per_rev", 0.3}}},
                  [](const At& at) { return a * std::cos(two_pi * at.z / 0.3 - at.c); }),
            1e-11);
  // Ring theory: second harmonic (8/35)² of the first for three jaws.
  EXPECT_LT(worst(cylinder,
                  {"part.chuck_lobing",
                   {{"amplitude_mm", a}, {"decay_length_mm", 15.0}, {"jaw_position_mm", -20.0}}},
                  [](const At& at) {
                    return a * std::exp(-(at.z + 20.0) / 15.0) *
                           (std::cos(3 * at.c) + 64.0 / 1225.0 * std::cos(6 * at.c));
                  }),
            exact_mm);
}

TEST(SimulateEffects, FormIsMeasuredAlongTheNormal) {
  EXPECT_LT(
      worst(helix(PartKind::cone), {"part.roundness", {{"order", 4}, {"amplitude_mm", a}}},
            [](const At& at) { return a * std::sqrt(1 + tangent * tangent) * std::cos(4 * at.c); }),
      exact_mm);
}

TEST(SimulateEffects, MachineErrorsAddInTheirFrame) {
  const Scenario cylinder = helix(PartKind::cylinder);
  EXPECT_LT(
      worst(cylinder,
            {"spindle.radial_synchronous", {{"order", 2}, {"amplitude_mm", a}, {"phase_rad", 1.0}}},
            [](const At& at) { return a * std::cos(2 * at.c - 1.0); }),
      exact_mm);
  EXPECT_LT(worst(cylinder,
                  {"spindle.tilt_synchronous",
                   {{"order", 2}, {"amplitude_rad", 1e-5}, {"bearing_mm", -300.0}}},
                  [](const At& at) { return 1e-5 * std::cos(2 * at.c) * (at.z + 300.0); }),
            exact_mm);
  EXPECT_LT(worst(cylinder, {"spindle.asynchronous", {{"order", 0.41}, {"amplitude_mm", a}}},
                  [](const At& at) { return a * std::cos(0.41 * at.c); }),
            exact_mm);
  EXPECT_LT(worst(cylinder, {"slide.z_straightness", {{"amplitude_mm", a}}},
                  [](const At& at) { return a * (3 * at.u * at.u - 1) / 2; }),
            exact_mm);
  EXPECT_LT(worst(cylinder, {"slide.xz_parallelism", {{"slope_rad", 5e-5}}},
                  [](const At& at) { return 5e-5 * at.z; }),
            exact_mm);
  EXPECT_LT(worst(cylinder, {"environment.vibration", {{"amplitude_mm", a}, {"frequency_hz", 7.3}}},
                  [](const At& at) { return a * std::cos(two_pi * 7.3 * at.t); }),
            exact_mm);
  EXPECT_LT(worst(cylinder,
                  {"thermal.drift",
                   {{"rate_mm_per_s", 1e-4}, {"amplitude_mm", a}, {"time_constant_s", 9.0}}},
                  [](const At& at) { return 1e-4 * at.t + a * (1 - std::exp(-at.t / 9.0)); }),
            exact_mm);
}

TEST(SimulateEffects, AxialErrorsShowThroughTheTaperOnly) {
  const Effect axial{"spindle.axial_synchronous", {{"order", 2}, {"amplitude_mm", a}}};
  const Effect screw{"slide.leadscrew_periodic", {{"amplitude_mm", a}, {"pitch_mm", 5.0}}};
  const Effect backlash{"slide.backlash", {{"along_mm", a}, {"across_mm", 3 * a}}};
  const auto nothing = [](const At&) { return 0.0; };
  EXPECT_LT(worst(helix(PartKind::cylinder), axial, nothing), exact_mm);
  EXPECT_LT(worst(helix(PartKind::cylinder), screw, nothing), exact_mm);
  const Scenario cone = helix(PartKind::cone);
  EXPECT_LT(worst(cone, axial, [](const At& at) { return tangent * a * std::cos(2 * at.c); }),
            exact_mm);
  EXPECT_LT(
      worst(cone, screw, [](const At& at) { return tangent * a * std::cos(two_pi * at.z / 5.0); }),
      exact_mm);
  EXPECT_LT(worst(cone, backlash, [](const At&) { return -tangent * a / 2 + 3 * a / 2; }),
            exact_mm);
}

// C' = C + δC on an eccentric circle, X(C) = e cos C + √(R² − e² sin² C).
TEST(SimulateEffects, AngleErrorsTurnAnEccentricPart) {
  Scenario scenario = helix(PartKind::cylinder);
  scenario.part.x0_mm = 0.2;
  const auto circle = [](double c) {
    return 0.2 * std::cos(c) + std::sqrt(1600.0 - std::pow(0.2 * std::sin(c), 2));
  };
  EXPECT_LT(worst(scenario, {"encoder.offset", {{"angle_rad", 0.1}}},
                  [&](const At& at) { return circle(at.c + 0.1) - circle(at.c); }),
            exact_mm);
  EXPECT_LT(worst(scenario, {"encoder.eccentricity", {{"amplitude_rad", 1e-4}, {"phase_rad", 0.3}}},
                  [&](const At& at) {
                    return circle(at.c + 1e-4 * std::cos(at.c - 0.3)) - circle(at.c);
                  }),
            exact_mm);
  EXPECT_LT(worst(scenario, {"probe.latency", {{"delay_s", 0.01}}},
                  [&](const At& at) { return circle(at.c - two_pi * 0.01) - circle(at.c); }),
            exact_mm);
  // First order low pass, harmonic by harmonic: H = 1/(1 + jkωT); e²/4R = 0.25 µm at 2 UPR, the
  // fourth order e⁴/64R³ is 4e-10.
  const double t = 0.02;
  const std::complex<double> j(0.0, 1.0);
  EXPECT_LT(worst(scenario, {"probe.lag", {{"time_constant_s", t}}},
                  [&](const At& at) {
                    const auto lagged = [&](int k, double amplitude) {
                      const std::complex<double> h = 1.0 / (1.0 + j * (k * two_pi * t));
                      return amplitude * ((h - 1.0) * std::polar(1.0, k * at.c)).real();
                    };
                    return lagged(1, 0.2) + lagged(2, 0.04 / 160.0);
                  }),
            1e-9);
}

TEST(SimulateEffects, SlipsAndBowsMoveTheAxis) {
  const Scenario cylinder = helix(PartKind::cylinder);
  const auto moved = [](double dx, double c) {
    return dx * std::cos(c) + std::sqrt(1600.0 - std::pow(dx * std::sin(c), 2)) - 40.0;
  };
  EXPECT_LT(worst(cylinder, {"part.slip", {{"time_s", 15.3}, {"dx_mm", 0.1}}},
                  [&](const At& at) { return at.t < 15.3 ? 0.0 : moved(0.1, at.c); }),
            exact_mm);
  EXPECT_LT(worst(cylinder, {"part.bow", {{"sagitta_mm", 0.05}, {"length_mm", 40.0}}},
                  [&](const At& at) { return moved(0.05 * at.u * at.u, at.c); }),
            exact_mm);
}

TEST(SimulateEffects, TheSensorRespondsAboutItsReference) {
  Scenario scenario = helix(PartKind::cone);
  const double x0 = radius_mm;
  const auto v = [](const At& at) { return tangent * at.z; };
  EXPECT_LT(worst(scenario, {"probe.gain", {{"gain", 0.01}, {"reference_mm", x0}}},
                  [&](const At& at) { return 0.01 * v(at); }),
            exact_mm);
  EXPECT_LT(worst(scenario,
                  {"probe.nonlinearity",
                   {{"quadratic_mm", a}, {"cubic_mm", a}, {"reference_mm", x0}, {"range_mm", 2.0}}},
                  [&](const At& at) {
                    const double w = v(at) / 2.0;
                    return a * w * w + a * w * w * w;
                  }),
            exact_mm);
  EXPECT_LT(worst(scenario, {"probe.cyclic", {{"amplitude_mm", a}, {"period_mm", 0.02}}},
                  [&](const At& at) { return a * std::cos(two_pi * (x0 + v(at)) / 0.02); }),
            1e-10);  // 40 mm are 2000 periods: the phase has 12 digits
  // A jog of the slide moves the reference.
  scenario.plan.setups.resize(1);
  scenario.plan.setups[0].x_jog_mm = 0.1;
  EXPECT_LT(worst(scenario, {"probe.gain", {{"gain", 0.01}, {"reference_mm", x0}}},
                  [&](const At& at) { return 0.01 * (v(at) - 0.1); }),
            exact_mm);
}

TEST(SimulateEffects, TiltedProbeAndBallAreLinesAndSpheres) {
  // On a centred cylinder the line's length is R/cos γ; on a cone it also runs up the slope.
  EXPECT_LT(worst(helix(PartKind::cylinder), {"probe.tilt", {{"angle_rad", 0.01}}},
                  [](const At&) { return 40.0 / std::cos(0.01) - 40.0; }),
            exact_mm);
  EXPECT_LT(worst(helix(PartKind::cone), {"probe.tilt", {{"angle_rad", 0.01}}},
                  [](const At& at) {
                    const double r = radius_mm + tangent * at.z;
                    return r / (std::cos(0.01) - tangent * std::sin(0.01)) - r;
                  }),
            exact_mm);
  EXPECT_LT(worst(helix(PartKind::cone), {"probe.ball_radius", {{"radius_mm", 0.3}}},
                  [](const At&) { return 0.3 * std::sqrt(1 + tangent * tangent); }),
            1e-11);
}

// On a centred cone the normal across the stylus points to −Z with sin α: ψ = 180°, cos 3ψ = −1,
// and the probe triggers early.
TEST(SimulateEffects, PretravelOfSomeDirectionsIsNegative) {
  EXPECT_LT(
      worst(helix(PartKind::cone), {"probe.pretravel", {{"amplitude_mm", 0.0}, {"lobing_mm", a}}},
            [](const At&) { return a * tangent / std::sqrt(1 + tangent * tangent); }),
      1e-9);  // the normal is a central difference
}

TEST(SimulateEffects, LimitsClipRoundAndCount) {
  Scenario scenario = helix(PartKind::cylinder);
  scenario.part.x0_mm = 0.2;
  scenario.effects = {{"probe.saturation", {{"high_mm", 40.1}}},
                      {"probe.quantisation", {{"step_mm", 0.001}}}};
  const Simulation out = simulate_with_truth(scenario);
  std::size_t clipped = 0;
  for (std::size_t i = 0; i < out.stream.size(); ++i) {
    const double steps = out.stream.reading_mm[i] / 0.001;
    EXPECT_NEAR(steps, std::round(steps), 1e-9);
    clipped += out.truth.clean_mm[i] > 40.1 ? 1 : 0;
    EXPECT_NEAR(out.stream.reading_mm[i], std::min(40.1, out.truth.clean_mm[i]), 0.000501);
  }
  EXPECT_EQ(out.truth.clipped_rows.size(), clipped);
  EXPECT_GT(clipped, 0u);
}

TEST(SimulateEffects, AKeywayIsFoundFromOutsideEvenOffCentre) {
  for (const double e : {0.0, 30.0}) {
    Scenario scenario = helix(PartKind::cylinder);
    scenario.part.x0_mm = e;
    scenario.effects = {
        {"part.interruption", {{"angle_rad", 1.0}, {"width_rad", 0.4}, {"depth_mm", 3.0}}}};
    const ProbeStream stream = simulate(scenario);
    int deep = 0, edge = 0;
    for (std::size_t i = 0; i < stream.size(); ++i) {
      const double x = stream.reading_mm[i] * std::cos(stream.c_rad[i]) - e;
      const double y = stream.reading_mm[i] * std::sin(stream.c_rad[i]);
      const double r = std::hypot(x, y), off = std::abs(std::atan2(y, x) - 1.0);
      const bool floor = std::abs(r - 37.0) < 1e-9 && off < 0.2 + 1e-9;
      const bool outside = std::abs(r - 40.0) < 1e-9 && off > 0.2 - 1e-9;
      const bool wall = r < 40.0 && r > 37.0 && std::abs(off - 0.2) < 1e-9;
      EXPECT_TRUE(floor || outside || wall) << "e = " << e << ", i = " << i << ", r = " << r;
      deep += floor ? 1 : 0;
      edge += wall ? 1 : 0;
    }
    EXPECT_GT(deep, 0);
    EXPECT_TRUE(e != 0.0 || edge == 0);
  }
}

TEST(SimulateEffects, ReindexTurnsThePartAndNotTheChuck) {
  Scenario scenario = helix(PartKind::cylinder);
  scenario.plan.setups.resize(1);
  scenario.plan.setups[0].reindex_rad = 0.5;
  EXPECT_LT(worst(scenario, {"part.roundness", {{"order", 2}, {"amplitude_mm", a}}},
                  [](const At& at) { return a * std::cos(2 * (at.c + 0.5)); }),
            exact_mm);
  EXPECT_LT(worst(scenario, {"spindle.radial_synchronous", {{"order", 2}, {"amplitude_mm", a}}},
                  [](const At& at) { return a * std::cos(2 * at.c); }),
            exact_mm);
  EXPECT_LT(worst(scenario, {"part.bow", {{"sagitta_mm", 0.05}, {"length_mm", 40.0}}},
                  [&](const At& at) {
                    const double e = 0.05 * at.u * at.u, angle = at.c + 0.5;
                    return e * std::cos(angle) +
                           std::sqrt(1600.0 - std::pow(e * std::sin(angle), 2)) - 40.0;
                  }),
            exact_mm);
  scenario.plan.setups[0].z_shift_mm = 1.5;
  EXPECT_LT(worst(scenario, {"part.waviness", {{"amplitude_mm", a}, {"wavelength_mm", 3.0}}},
                  [](const At& at) { return a * std::cos(two_pi * (at.z - 1.5) / 3.0); }),
            exact_mm);
}

TEST(SimulateEffects, ZeroEffectsChangeNothingAndOthersSomething) {
  for (const EffectKind& kind : effect_kinds()) {
    Scenario scenario = helix(PartKind::cone);
    scenario.part.x0_mm = 0.2;
    Effect effect{std::string(kind.id), {}};
    const auto is_size = [&](std::string_view name) {
      if (name == "radius_mm") return kind.id == "probe.ball_radius";  // else where a size holds
      return name == "gain" || name == "dish_mm" || name == "dz_mm" || name.starts_with("tilt") ||
             name.starts_with("amplitude") || name.starts_with("growth") ||
             name.starts_with("dx") || name.starts_with("slope") || name.starts_with("along") ||
             name.starts_with("depth") || name.starts_with("offset") ||
             name.starts_with("height") || name.starts_with("rate") ||
             name.starts_with("quadratic") || name.starts_with("sagitta") || name == "angle_rad" ||
             name == "delay_s" || name == "time_constant_s" || name == "step_mm" ||
             name == "play_mm" || name == "low_mm" || name == "high_mm";
    };
    const bool limits = kind.id == "probe.saturation";
    for (const LatheParameter& parameter : kind.parameters) {
      if (!parameter.fallback) effect.parameters[std::string(parameter.name)] = 1.0;
    }
    if (kind.id == "part.creep") {  // evenly over no time would be nothing
      scenario.effects = {effect};
      EXPECT_THROW(simulate(scenario), InputError);
      effect.parameters["settling_s"] = 1.0;
    }
    for (const double size : {0.0, 0.01}) {
      for (const LatheParameter& parameter : kind.parameters) {
        const bool sized = is_size(parameter.name) && !limits;
        if (sized && !(parameter.name == "time_constant_s" && kind.id != "probe.lag")) {
          effect.parameters[std::string(parameter.name)] = size;
        }
      }
      if (limits && size > 0.0) effect.parameters["high_mm"] = 40.0;
      scenario.effects.clear();
      const ProbeStream before = simulate(scenario);
      scenario.effects = {effect};
      const ProbeStream after = simulate(scenario);
      double change = 0.0;
      for (std::size_t i = 0; i < after.size(); ++i) {
        change = std::max(change, std::abs(after.reading_mm[i] - before.reading_mm[i]));
      }
      EXPECT_TRUE(size > 0.0 ? change > 1e-7 : change < exact_mm) << kind.id << ": " << change;
    }
  }
}

}  // namespace
}  // namespace trueaxis::virtual_lathe

// SPDX-License-Identifier: Apache-2.0
// Slots B and E: the probe's line and the sensor's response.
#include <algorithm>
#include <cmath>

#include "simulate/chain.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis::virtual_lathe {
namespace {

constexpr EffectParameter height_parameters[] = {{"height_mm", {}}};

void enter_height(const Values& of, Chain& chain) { chain.line.height_mm += of("height_mm"); }

constexpr EffectParameter tilt_parameters[] = {{"angle_rad", {}}};

void enter_tilt(const Values& of, Chain& chain) { chain.line.tilt_rad += of("angle_rad"); }

constexpr EffectParameter ball_parameters[] = {{"radius_mm", {}}};

void enter_ball(const Values& of, Chain& chain) { chain.line.extra_ball_mm += of("radius_mm"); }

constexpr EffectParameter gain_parameters[] = {{"gain", {}}, {"reference_mm", {}}};

void enter_gain(const Values& of, Chain& chain) {
  const double g = of("gain"), reference = of("reference_mm");
  chain.response.push_back([=](double x, const ResponseState& sensor) {
    const double outward = sensor.facing * x;
    return sensor.facing * (reference + (1.0 + g) * (outward - reference));
  });
}

constexpr EffectParameter nonlinearity_parameters[] = {
    {"quadratic_mm", 0.0}, {"cubic_mm", 0.0}, {"reference_mm", {}}, {"range_mm", 1.0}};

void enter_nonlinearity(const Values& of, Chain& chain) {
  const double c2 = of("quadratic_mm"), c3 = of("cubic_mm");
  const double reference = of("reference_mm"), range = of("range_mm");
  chain.response.push_back([=](double x, const ResponseState& sensor) {
    const double v = (sensor.facing * x - reference) / range;
    return x + sensor.facing * (c2 * v * v + c3 * v * v * v);
  });
}

constexpr EffectParameter cyclic_parameters[] = {
    {"amplitude_mm", {}}, {"period_mm", {}}, {"phase_rad", 0.0}};

void enter_cyclic(const Values& of, Chain& chain) {
  const double a = of("amplitude_mm"), k = two_pi / of("period_mm"), phase = of("phase_rad");
  chain.response.push_back(
      [=](double x, const ResponseState&) { return x + a * std::cos(k * x + phase); });
}

constexpr EffectParameter pretravel_parameters[] = {
    {"amplitude_mm", {}}, {"lobing_mm", 0.0}, {"order", 3.0}, {"phase_rad", 0.0}};

// A switching probe goes on into the material until it triggers, further in some directions of the
// normal across the stylus than in others.
void enter_pretravel(const Values& of, Chain& chain) {
  const double a = of("amplitude_mm"), b = of("lobing_mm"), n = of("order"),
               phase = of("phase_rad");
  chain.needs_normal = true;
  chain.response.push_back([=](double x, const ResponseState& sensor) {
    const Vec3& normal = sensor.normal;
    const double along = sensor.state.face ? normal.z : normal.x;
    const double side = sensor.state.face ? normal.x : normal.z;
    const double across = std::hypot(side, normal.y);
    const double lobes = across > 0.0 ? std::cos(n * std::atan2(normal.y, side) - phase) : 0.0;
    return x - std::copysign(1.0, along) * (a + b * across * lobes);
  });
}

constexpr EffectParameter lag_parameters[] = {{"time_constant_s", {}}};

void enter_lag(const Values& of, Chain& chain) { chain.lag_s += of("time_constant_s"); }

constexpr EffectParameter saturation_parameters[] = {{"low_mm", -1e9}, {"high_mm", 1e9}};

void enter_saturation(const Values& of, Chain& chain) {
  chain.low_mm = std::max(chain.low_mm, of("low_mm"));
  chain.high_mm = std::min(chain.high_mm, of("high_mm"));
}

constexpr EffectParameter quantisation_parameters[] = {{"step_mm", {}}};

void enter_quantisation(const Values& of, Chain& chain) { chain.quantisation_mm = of("step_mm"); }

constexpr EffectEntry table[] = {
    {{"probe.height", "probe line at Y = height", height_parameters}, enter_height},
    {{"probe.tilt", "probe line tilted in X-Z", tilt_parameters}, enter_tilt},
    {{"probe.ball_radius", "ball radius that nobody compensated", ball_parameters}, enter_ball},
    {{"probe.pretravel", "trigger path, by direction of the normal", pretravel_parameters},
     enter_pretravel},
    {{"probe.gain", "reference + (1 + gain) (X - reference)", gain_parameters}, enter_gain},
    {{"probe.nonlinearity", "X + c2 v^2 + c3 v^3, v = (X - reference) / range",
      nonlinearity_parameters},
     enter_nonlinearity},
    {{"probe.cyclic", "X + a cos(2 pi X / period + phase)", cyclic_parameters}, enter_cyclic},
    {{"probe.lag", "first order low pass", lag_parameters}, enter_lag},
    {{"probe.saturation", "clipped at limits", saturation_parameters}, enter_saturation},
    {{"probe.quantisation", "rounded to a step", quantisation_parameters}, enter_quantisation},
};

}  // namespace

std::span<const EffectEntry> probe_effects() { return table; }

}  // namespace trueaxis::virtual_lathe

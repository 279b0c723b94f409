// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "simulate/effects.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis::virtual_lathe {
namespace {

constexpr EffectEntry probe_table[] = {
    {"probe.height",
     "probe line at Y = height",
     {{"height_mm", {}}},
     [](const Values& of, Chain& chain) { chain.line.height_mm += of("height_mm"); }},
    {"probe.x_zero",
     "X + offset",
     {{"offset_mm", {}}},
     in<machine>([](TrueState& state, double offset) { state.across_mm += offset; })},
    {"probe.tilt",
     "probe line tilted in X-Z",
     {{"angle_rad", {}}},
     [](const Values& of, Chain& chain) { chain.line.tilt_rad += of("angle_rad"); }},
    {"probe.ball_radius",
     "ball radius that nobody compensated",
     {{"radius_mm", {}}},
     [](const Values& of, Chain& chain) { chain.line.extra_ball_mm += of("radius_mm"); }},
    // A switching probe goes on into the material until it triggers, further in some directions of
    // the normal across the stylus than in others.
    {"probe.pretravel",
     "trigger path, by direction of the normal",
     {{"amplitude_mm", {}}, {"lobing_mm", 0.0}, {"order", 3.0}, {"phase_rad", 0.0}},
     [](const Values& of, Chain& chain) {
       chain.needs_normal = true;
       in<response>([](const Sensed& sensor, double a, double b, double n, double phase) {
         const Vec3& normal = sensor.normal;
         const double along = sensor.state.face ? normal.z : normal.x;
         const double side = sensor.state.face ? normal.x : normal.z;
         const double across = std::hypot(side, normal.y);
         const double lobes = across > 0.0 ? std::cos(n * std::atan2(normal.y, side) - phase) : 0.0;
         return sensor.x_mm - std::copysign(1.0, along) * (a + b * across * lobes);
       })(of, chain);
     }},
    {"probe.gain",
     "reference + (1 + gain) (X - reference)",
     {{"gain", {}}, {"reference_mm", {}}},
     in<response>([](const Sensed& sensor, double g, double reference) {
       const double outward = sensor.facing * sensor.x_mm;
       return sensor.facing * (reference + (1.0 + g) * (outward - reference));
     })},
    {"probe.nonlinearity",
     "X + c2 v^2 + c3 v^3, v = (X - reference) / range",
     {{"quadratic_mm", 0.0}, {"cubic_mm", 0.0}, {"reference_mm", {}}, {"range_mm", 1.0}},
     in<response>([](const Sensed& sensor, double c2, double c3, double reference, double range) {
       const double v = (sensor.facing * sensor.x_mm - reference) / range;
       return sensor.x_mm + sensor.facing * (c2 * v * v + c3 * v * v * v);
     })},
    {"probe.cyclic",
     "X + a cos(2 pi X / period + phase)",
     {{"amplitude_mm", {}}, {"period_mm", {}}, {"phase_rad", 0.0}},
     in<response>([](const Sensed& sensor, double a, double period, double phase) {
       return sensor.x_mm + a * std::cos(two_pi / period * sensor.x_mm + phase);
     })},
    {"probe.lag",
     "first order low pass",
     {{"time_constant_s", {}}},
     [](const Values& of, Chain& chain) { chain.lag_s += of("time_constant_s"); }},
    {"probe.hysteresis",
     "the pointer stays until X has moved by the play",
     {{"play_mm", {}}},
     [](const Values& of, Chain& chain) { chain.play_mm += of("play_mm"); }},
    {"probe.saturation",
     "clipped at limits",
     {{"low_mm", -1e9}, {"high_mm", 1e9}},
     [](const Values& of, Chain& chain) {
       chain.low_mm = std::max(chain.low_mm, of("low_mm"));
       chain.high_mm = std::min(chain.high_mm, of("high_mm"));
     }},
    {"probe.quantisation",
     "rounded to a step",
     {{"step_mm", {}}},
     [](const Values& of, Chain& chain) { chain.quantisation_mm = of("step_mm"); }},
};

}  // namespace

std::span<const EffectEntry> probe_effects() { return probe_table; }

}  // namespace trueaxis::virtual_lathe

// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "simulate/effects.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis::virtual_lathe {
namespace {

double sign(double v) { return v > 0.0 ? 1.0 : v < 0.0 ? -1.0 : 0.0; }

constexpr EffectEntry machine_table[] = {
    // The reading was made that long before C and Z were.
    {"probe.latency",
     "C' = C - omega delay, Z' = Z - v delay",
     {{"delay_s", {}}},
     in<machine>([](TrueState& state, double delay) {
       state.c_rad -= state.at.omega_rad_per_s * delay;
       state.position_mm -= state.at.velocity_mm_per_s * delay;
     })},
    {"encoder.offset",
     "C' = C + angle",
     {{"angle_rad", {}}},
     in<machine>([](TrueState& state, double angle) { state.c_rad += angle; })},
    {"encoder.eccentricity",
     "C' = C + a cos(C - phase)",
     {{"amplitude_rad", {}}, {"phase_rad", 0.0}},
     in<machine>([](TrueState& state, double a, double phase) {
       state.c_rad += a * std::cos(state.at.c_rad - phase);
     })},
    {"slide.leadscrew_periodic",
     "Z' = Z + a cos(2 pi Z / pitch + phase)",
     {{"amplitude_mm", {}}, {"pitch_mm", {}}, {"phase_rad", 0.0}},
     in<machine>([](TrueState& state, double a, double pitch, double phase) {
       state.position_mm += a * std::cos(two_pi / pitch * state.at.position_mm + phase);
     })},
    {"slide.backlash",
     "Z' = Z - sign(feed) along / 2, X + sign(feed) across / 2",
     {{"along_mm", {}}, {"across_mm", 0.0}},
     in<machine>([](TrueState& state, double along, double across) {
       state.position_mm -= sign(state.at.velocity_mm_per_s) * 0.5 * along;
       state.across_mm += sign(state.at.velocity_mm_per_s) * 0.5 * across;
     })},
    {"spindle.radial_synchronous",
     "X + a cos(n C - phase)",
     {{"order", {}}, {"amplitude_mm", {}}, {"phase_rad", 0.0}},
     in<machine>([](TrueState& state, double n, double a, double phase) {
       state.part_x_mm += a * std::cos(n * state.c_rad - phase);
     })},
    // The spindle nods about the machine's Y: x moves with the distance from the bearing, z with
    // −x.
    {"spindle.tilt_synchronous",
     "X + a cos(n C - phase) (Z - bearing)",
     {{"order", {}}, {"amplitude_rad", {}}, {"phase_rad", 0.0}, {"bearing_mm", {}}},
     in<machine>([](TrueState& state, double n, double a, double phase, double bearing) {
       const double nod = a * std::cos(n * state.c_rad - phase);
       if (state.face) {
         state.part_z_mm -= nod * state.at.position_mm;
       } else {
         state.part_x_mm += nod * (state.at.position_mm - bearing);
       }
     })},
    // Z' = Z + a cos(nC − φ): the part comes towards −Z by that much.
    {"spindle.axial_synchronous",
     "Z' = Z + a cos(n C - phase)",
     {{"order", {}}, {"amplitude_mm", {}}, {"phase_rad", 0.0}},
     in<machine>([](TrueState& state, double n, double a, double phase) {
       state.part_z_mm -= a * std::cos(n * state.c_rad - phase);
     })},
    {"spindle.asynchronous",
     "X + a cos(order C + phase), a fractional order",
     {{"order", {}}, {"amplitude_mm", {}}, {"phase_rad", 0.0}},
     in<machine>([](TrueState& state, double kappa, double a, double phase) {
       state.part_x_mm += a * std::cos(kappa * state.c_rad + phase);
     })},
    {"slide.z_straightness",
     "X + a P_degree(u)",
     {{"degree", 2.0}, {"amplitude_mm", {}}},
     in<machine>([](TrueState& state, double degree, double a) {
       state.across_mm += a * legendre(degree, state.u);
     })},
    {"slide.xz_parallelism",
     "X + slope Z",
     {{"slope_rad", {}}},
     in<machine>(
         [](TrueState& state, double slope) { state.across_mm += slope * state.at.position_mm; })},
    {"thermal.drift",
     "X + rate t + a (1 - exp(-t / time_constant))",
     {{"rate_mm_per_s", 0.0}, {"amplitude_mm", 0.0}, {"time_constant_s", 600.0}},
     in<machine>([](TrueState& state, double rate, double a, double tau) {
       state.across_mm += rate * state.at.t_s - a * std::expm1(-state.at.t_s / tau);
     })},
    {"environment.vibration",
     "X + a cos(2 pi f t + phase)",
     {{"amplitude_mm", {}}, {"frequency_hz", {}}, {"phase_rad", 0.0}},
     in<machine>([](TrueState& state, double a, double f, double phase) {
       state.across_mm += a * std::cos(two_pi * f * state.at.t_s + phase);
     })},
};

}  // namespace

std::span<const EffectEntry> machine_effects() { return machine_table; }

}  // namespace trueaxis::virtual_lathe

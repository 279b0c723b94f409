// SPDX-License-Identifier: Apache-2.0
#include "simulate/effects_machine.hpp"

#include <cmath>

#include "simulate/polynomials.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis::virtual_lathe {
namespace {

double sign(double v) { return v > 0.0 ? 1.0 : v < 0.0 ? -1.0 : 0.0; }

constexpr EffectEntry machine_table[] = {
    // The reading was taken that long before C and Z were.
    {"probe.latency",
     "C' = C - omega delay, Z' = Z - v delay",
     {{"delay_s", {}}},
     [](const Values& of, Chain& chain) {
       const double delay = of("delay_s");
       chain.machine.push_back([=](TrueState& state) {
         state.c_rad -= state.at.omega_rad_per_s * delay;
         state.position_mm -= state.at.velocity_mm_per_s * delay;
       });
     }},
    {"encoder.offset",
     "C' = C + angle",
     {{"angle_rad", {}}},
     [](const Values& of, Chain& chain) {
       const double angle = of("angle_rad");
       chain.machine.push_back([=](TrueState& state) { state.c_rad += angle; });
     }},
    {"encoder.eccentricity",
     "C' = C + a cos(C - phase)",
     {{"amplitude_rad", {}}, {"phase_rad", 0.0}},
     [](const Values& of, Chain& chain) {
       const double a = of("amplitude_rad"), phase = of("phase_rad");
       chain.machine.push_back(
           [=](TrueState& state) { state.c_rad += a * std::cos(state.at.c_rad - phase); });
     }},
    {"slide.leadscrew_periodic",
     "Z' = Z + a cos(2 pi Z / pitch + phase)",
     {{"amplitude_mm", {}}, {"pitch_mm", {}}, {"phase_rad", 0.0}},
     [](const Values& of, Chain& chain) {
       const double a = of("amplitude_mm"), k = two_pi / of("pitch_mm"), phase = of("phase_rad");
       chain.machine.push_back([=](TrueState& state) {
         state.position_mm += a * std::cos(k * state.at.position_mm + phase);
       });
     }},
    {"slide.backlash",
     "Z' = Z - sign(feed) along / 2, X + sign(feed) across / 2",
     {{"along_mm", {}}, {"across_mm", 0.0}},
     [](const Values& of, Chain& chain) {
       const double b = of("along_mm"), c = of("across_mm");
       chain.machine.push_back([=](TrueState& state) {
         state.position_mm -= sign(state.at.velocity_mm_per_s) * 0.5 * b;
         state.across_mm += sign(state.at.velocity_mm_per_s) * 0.5 * c;
       });
     }},
    {"spindle.radial_synchronous",
     "X + a cos(n C - phase)",
     {{"order", {}}, {"amplitude_mm", {}}, {"phase_rad", 0.0}},
     [](const Values& of, Chain& chain) {
       const double n = of("order"), a = of("amplitude_mm"), phase = of("phase_rad");
       chain.machine.push_back(
           [=](TrueState& state) { state.part_x_mm += a * std::cos(n * state.c_rad - phase); });
     }},
    // The spindle nods about the machine's Y: x moves with the distance from the bearing, z with
    // −x.
    {"spindle.tilt_synchronous",
     "X + a cos(n C - phase) (Z - bearing)",
     {{"order", {}}, {"amplitude_rad", {}}, {"phase_rad", 0.0}, {"bearing_mm", {}}},
     [](const Values& of, Chain& chain) {
       const double n = of("order"), a = of("amplitude_rad"), phase = of("phase_rad");
       const double bearing = of("bearing_mm");
       chain.machine.push_back([=](TrueState& state) {
         const double nod = a * std::cos(n * state.c_rad - phase);
         if (state.face) {
           state.part_z_mm -= nod * state.at.position_mm;
         } else {
           state.part_x_mm += nod * (state.at.position_mm - bearing);
         }
       });
     }},
    // Z' = Z + a cos(nC − φ): the part comes towards −Z by that much.
    {"spindle.axial_synchronous",
     "Z' = Z + a cos(n C - phase)",
     {{"order", {}}, {"amplitude_mm", {}}, {"phase_rad", 0.0}},
     [](const Values& of, Chain& chain) {
       const double n = of("order"), a = of("amplitude_mm"), phase = of("phase_rad");
       chain.machine.push_back(
           [=](TrueState& state) { state.part_z_mm -= a * std::cos(n * state.c_rad - phase); });
     }},
    {"spindle.asynchronous",
     "X + a cos(order C + phase), a fractional order",
     {{"order", {}}, {"amplitude_mm", {}}, {"phase_rad", 0.0}},
     [](const Values& of, Chain& chain) {
       const double kappa = of("order"), a = of("amplitude_mm"), phase = of("phase_rad");
       chain.machine.push_back(
           [=](TrueState& state) { state.part_x_mm += a * std::cos(kappa * state.c_rad + phase); });
     }},
    {"slide.z_straightness",
     "X + a P_degree(u)",
     {{"degree", 2.0}, {"amplitude_mm", {}}},
     [](const Values& of, Chain& chain) {
       const int degree = static_cast<int>(of("degree"));
       const double a = of("amplitude_mm");
       chain.machine.push_back(
           [=](TrueState& state) { state.across_mm += a * legendre(degree, state.u); });
     }},
    {"slide.xz_parallelism",
     "X + slope Z",
     {{"slope_rad", {}}},
     [](const Values& of, Chain& chain) {
       const double slope = of("slope_rad");
       chain.machine.push_back(
           [=](TrueState& state) { state.across_mm += slope * state.at.position_mm; });
     }},
    {"thermal.drift",
     "X + rate t + a (1 - exp(-t / time_constant))",
     {{"rate_mm_per_s", 0.0}, {"amplitude_mm", 0.0}, {"time_constant_s", 600.0}},
     [](const Values& of, Chain& chain) {
       const double rate = of("rate_mm_per_s"), a = of("amplitude_mm"), tau = of("time_constant_s");
       chain.machine.push_back([=](TrueState& state) {
         state.across_mm += rate * state.at.t_s - a * std::expm1(-state.at.t_s / tau);
       });
     }},
    {"environment.vibration",
     "X + a cos(2 pi f t + phase)",
     {{"amplitude_mm", {}}, {"frequency_hz", {}}, {"phase_rad", 0.0}},
     [](const Values& of, Chain& chain) {
       const double a = of("amplitude_mm"), w = two_pi * of("frequency_hz"),
                    phase = of("phase_rad");
       chain.machine.push_back(
           [=](TrueState& state) { state.across_mm += a * std::cos(w * state.at.t_s + phase); });
     }},
};

}  // namespace

std::span<const EffectEntry> machine_effects() { return machine_table; }

}  // namespace trueaxis::virtual_lathe

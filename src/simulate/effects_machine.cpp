// SPDX-License-Identifier: Apache-2.0
// Slots A and D: where spindle and slides really are against what is recorded, and when.
#include <cmath>

#include "simulate/chain.hpp"
#include "simulate/polynomials.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis::virtual_lathe {
namespace {

double sign(double v) { return v > 0.0 ? 1.0 : v < 0.0 ? -1.0 : 0.0; }

constexpr EffectParameter synchronous_parameters[] = {
    {"order", {}}, {"amplitude_mm", {}}, {"phase_rad", 0.0}};

void enter_radial(const Values& of, Chain& chain) {
  const double n = of("order"), a = of("amplitude_mm"), phase = of("phase_rad");
  chain.machine.push_back(
      [=](TrueState& state) { state.part_x_mm += a * std::cos(n * state.c_rad - phase); });
}

constexpr EffectParameter tilt_parameters[] = {
    {"order", {}}, {"amplitude_rad", {}}, {"phase_rad", 0.0}, {"bearing_mm", {}}};

// The spindle nods about the machine's Y: x moves with the distance from the bearing, z with −x.
void enter_tilt(const Values& of, Chain& chain) {
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
}

// Z' = Z + a cos(nC − φ): the part comes towards −Z by that much.
void enter_axial(const Values& of, Chain& chain) {
  const double n = of("order"), a = of("amplitude_mm"), phase = of("phase_rad");
  chain.machine.push_back(
      [=](TrueState& state) { state.part_z_mm -= a * std::cos(n * state.c_rad - phase); });
}

constexpr EffectParameter asynchronous_parameters[] = {
    {"order", {}}, {"amplitude_mm", {}}, {"phase_rad", 0.0}};

void enter_asynchronous(const Values& of, Chain& chain) {
  const double kappa = of("order"), a = of("amplitude_mm"), phase = of("phase_rad");
  chain.machine.push_back(
      [=](TrueState& state) { state.part_x_mm += a * std::cos(kappa * state.c_rad + phase); });
}

constexpr EffectParameter straightness_parameters[] = {{"degree", 2.0}, {"amplitude_mm", {}}};

void enter_straightness(const Values& of, Chain& chain) {
  const int degree = static_cast<int>(of("degree"));
  const double a = of("amplitude_mm");
  chain.machine.push_back(
      [=](TrueState& state) { state.across_mm += a * legendre(degree, state.u); });
}

constexpr EffectParameter parallelism_parameters[] = {{"slope_rad", {}}};

void enter_parallelism(const Values& of, Chain& chain) {
  const double slope = of("slope_rad");
  chain.machine.push_back(
      [=](TrueState& state) { state.across_mm += slope * state.at.position_mm; });
}

constexpr EffectParameter screw_parameters[] = {
    {"amplitude_mm", {}}, {"pitch_mm", {}}, {"phase_rad", 0.0}};

void enter_screw(const Values& of, Chain& chain) {
  const double a = of("amplitude_mm"), k = two_pi / of("pitch_mm"), phase = of("phase_rad");
  chain.machine.push_back([=](TrueState& state) {
    state.position_mm += a * std::cos(k * state.at.position_mm + phase);
  });
}

constexpr EffectParameter backlash_parameters[] = {{"along_mm", {}}, {"across_mm", 0.0}};

void enter_backlash(const Values& of, Chain& chain) {
  const double b = of("along_mm"), c = of("across_mm");
  chain.machine.push_back([=](TrueState& state) {
    state.position_mm -= sign(state.at.velocity_mm_per_s) * 0.5 * b;
    state.across_mm += sign(state.at.velocity_mm_per_s) * 0.5 * c;
  });
}

constexpr EffectParameter latency_parameters[] = {{"delay_s", {}}};

// The reading was taken that long before C and Z were.
void enter_latency(const Values& of, Chain& chain) {
  const double delay = of("delay_s");
  chain.machine.push_back([=](TrueState& state) {
    state.c_rad -= state.at.omega_rad_per_s * delay;
    state.position_mm -= state.at.velocity_mm_per_s * delay;
  });
}

constexpr EffectParameter offset_parameters[] = {{"angle_rad", {}}};

void enter_offset(const Values& of, Chain& chain) {
  const double angle = of("angle_rad");
  chain.machine.push_back([=](TrueState& state) { state.c_rad += angle; });
}

constexpr EffectParameter encoder_parameters[] = {{"amplitude_rad", {}}, {"phase_rad", 0.0}};

void enter_encoder(const Values& of, Chain& chain) {
  const double a = of("amplitude_rad"), phase = of("phase_rad");
  chain.machine.push_back(
      [=](TrueState& state) { state.c_rad += a * std::cos(state.at.c_rad - phase); });
}

constexpr EffectParameter drift_parameters[] = {
    {"rate_mm_per_s", 0.0}, {"amplitude_mm", 0.0}, {"time_constant_s", 600.0}};

void enter_drift(const Values& of, Chain& chain) {
  const double rate = of("rate_mm_per_s"), a = of("amplitude_mm"), tau = of("time_constant_s");
  chain.machine.push_back([=](TrueState& state) {
    state.across_mm += rate * state.at.t_s - a * std::expm1(-state.at.t_s / tau);
  });
}

constexpr EffectParameter vibration_parameters[] = {
    {"amplitude_mm", {}}, {"frequency_hz", {}}, {"phase_rad", 0.0}};

void enter_vibration(const Values& of, Chain& chain) {
  const double a = of("amplitude_mm"), w = two_pi * of("frequency_hz"), phase = of("phase_rad");
  chain.machine.push_back(
      [=](TrueState& state) { state.across_mm += a * std::cos(w * state.at.t_s + phase); });
}

// What the encoder says first: the errors of the spindle follow its true angle.
constexpr EffectEntry table[] = {
    {{"probe.latency", "C' = C - omega delay, Z' = Z - v delay", latency_parameters},
     enter_latency},
    {{"encoder.offset", "C' = C + angle", offset_parameters}, enter_offset},
    {{"encoder.eccentricity", "C' = C + a cos(C - phase)", encoder_parameters}, enter_encoder},
    {{"slide.leadscrew_periodic", "Z' = Z + a cos(2 pi Z / pitch + phase)", screw_parameters},
     enter_screw},
    {{"slide.backlash", "Z' = Z - sign(feed) along / 2, X + sign(feed) across / 2",
      backlash_parameters},
     enter_backlash},
    {{"spindle.radial_synchronous", "X + a cos(n C - phase)", synchronous_parameters},
     enter_radial},
    {{"spindle.tilt_synchronous", "X + a cos(n C - phase) (Z - bearing)", tilt_parameters},
     enter_tilt},
    {{"spindle.axial_synchronous", "Z' = Z + a cos(n C - phase)", synchronous_parameters},
     enter_axial},
    {{"spindle.asynchronous", "X + a cos(order C + phase), a fractional order",
      asynchronous_parameters},
     enter_asynchronous},
    {{"slide.z_straightness", "X + a P_degree(u)", straightness_parameters}, enter_straightness},
    {{"slide.xz_parallelism", "X + slope Z", parallelism_parameters}, enter_parallelism},
    {{"thermal.drift", "X + rate t + a (1 - exp(-t / time_constant))", drift_parameters},
     enter_drift},
    {{"environment.vibration", "X + a cos(2 pi f t + phase)", vibration_parameters},
     enter_vibration},
};

}  // namespace

std::span<const EffectEntry> machine_effects() { return table; }

}  // namespace trueaxis::virtual_lathe

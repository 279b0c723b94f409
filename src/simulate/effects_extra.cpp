// SPDX-License-Identifier: Apache-2.0
// What no catalogue has: for tests that must end with "unknown".
#include <cmath>

#include "simulate/chain.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis::virtual_lathe {
namespace {

constexpr EffectParameter spiral_parameters[] = {
    {"order", {}}, {"amplitude_mm", {}}, {"lead_mm", {}}, {"phase_rad", 0.0}};

// Lobes that turn about the axis on their way along it.
void enter_spiral(const Values& of, Chain& chain) {
  const double n = of("order"), a = of("amplitude_mm"), phase = of("phase_rad");
  const double k = two_pi / of("lead_mm");
  chain.form.push_back(
      [=](const SurfacePoint& p) { return a * std::cos(n * (p.theta_rad - k * p.s_mm) - phase); });
}

constexpr EffectParameter dent_parameters[] = {
    {"angle_rad", {}}, {"position_mm", {}}, {"depth_mm", {}}, {"width_rad", {}}, {"length_mm", {}}};

// A local dent with a Gaussian section; width and length are its standard deviations.
void enter_dent(const Values& of, Chain& chain) {
  chain.local_form = true;
  const double angle = of("angle_rad"), position = of("position_mm"), depth = of("depth_mm");
  const double width = of("width_rad"), length = of("length_mm");
  chain.form.push_back([=](const SurfacePoint& p) {
    const double v = std::remainder(p.theta_rad - angle, two_pi) / width;
    const double w = (p.s_mm - position) / length;
    return -p.outward * depth * std::exp(-0.5 * (v * v + w * w));
  });
}

constexpr EffectParameter beat_parameters[] = {
    {"order", {}}, {"amplitude_mm", {}}, {"beat_hz", {}}, {"phase_rad", 0.0}};

// An error motion of the spindle whose amplitude swings with time.
void enter_beat(const Values& of, Chain& chain) {
  const double n = of("order"), a = of("amplitude_mm"), phase = of("phase_rad");
  const double w = two_pi * of("beat_hz");
  chain.machine.push_back([=](TrueState& state) {
    state.part_x_mm += a * std::cos(w * state.at.t_s) * std::cos(n * state.c_rad - phase);
  });
}

constexpr EffectEntry table[] = {
    {{"extra.spiral", "lobes that turn along the axis", spiral_parameters}, enter_spiral},
    {{"extra.dent", "a local dent", dent_parameters}, enter_dent},
    {{"extra.beat", "error motion that swings with time", beat_parameters}, enter_beat},
};

}  // namespace

std::span<const EffectEntry> extra_effects() { return table; }

}  // namespace trueaxis::virtual_lathe

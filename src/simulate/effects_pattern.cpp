// SPDX-License-Identifier: Apache-2.0
// Patterns without a cause, and forms more general than the catalogue's: what a diagnosis may leave
// unexplained, played back.
#include <cmath>

#include "simulate/chain.hpp"
#include "simulate/polynomials.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis::virtual_lathe {
namespace {

constexpr EffectParameter cell_parameters[] = {
    {"order", 0.0}, {"amplitude_mm", {}}, {"phase_rad", 0.0}, {"degree", 0.0}};

void enter_form_cell(const Values& of, Chain& chain) {
  const double n = of("order"), a = of("amplitude_mm"), phase = of("phase_rad");
  const int degree = static_cast<int>(of("degree"));
  chain.form.push_back([=](const SurfacePoint& p) {
    return a * legendre(degree, p.u) * std::cos(n * p.theta_rad - phase);
  });
}

void enter_motion_cell(const Values& of, Chain& chain) {
  const double n = of("order"), a = of("amplitude_mm"), phase = of("phase_rad");
  const int degree = static_cast<int>(of("degree"));
  chain.machine.push_back([=](TrueState& state) {
    state.across_mm += a * legendre(degree, state.u_part) * std::cos(n * state.at.c_rad - phase);
  });
}

constexpr EffectParameter time_cell_parameters[] = {{"order", 0.0},     {"amplitude_mm", {}},
                                                    {"phase_rad", 0.0}, {"degree", 1.0},
                                                    {"start_s", 0.0},   {"end_s", {}}};

void enter_time_cell(const Values& of, Chain& chain) {
  const double n = of("order"), a = of("amplitude_mm"), phase = of("phase_rad");
  const int degree = static_cast<int>(of("degree"));
  const double start = of("start_s"), lasted = of("end_s") - start;
  chain.machine.push_back([=](TrueState& state) {
    const double u = lasted > 0.0 ? 2.0 * (state.at.t_s - start) / lasted - 1.0 : 0.0;
    state.across_mm += a * legendre(degree, u) * std::cos(n * state.at.c_rad - phase);
  });
}

constexpr EffectParameter form_line_parameters[] = {
    {"order", 0.0}, {"amplitude_mm", {}}, {"phase_rad", 0.0}, {"period_mm", {}}};

void enter_form_line(const Values& of, Chain& chain) {
  const double n = of("order"), a = of("amplitude_mm"), phase = of("phase_rad");
  const double k = two_pi / of("period_mm");
  chain.form.push_back(
      [=](const SurfacePoint& p) { return a * std::cos(n * p.theta_rad - k * p.s_mm - phase); });
}

constexpr EffectParameter motion_line_parameters[] = {
    {"order", 0.0}, {"amplitude_mm", {}}, {"phase_rad", 0.0}, {"frequency_hz", {}}};

void enter_motion_line(const Values& of, Chain& chain) {
  const double n = of("order"), a = of("amplitude_mm"), phase = of("phase_rad");
  const double w = two_pi * of("frequency_hz");
  chain.machine.push_back([=](TrueState& state) {
    state.across_mm += a * std::cos(n * state.at.c_rad - w * state.at.t_s - phase);
  });
}

constexpr EffectParameter bump_parameters[] = {{"amplitude_mm", {}},
                                               {"angle_rad", {}},
                                               {"width_rad", {}},
                                               {"position_mm", 0.0},
                                               {"length_mm", 0.0}};

// Gaussian, width and length its standard deviations; without a length it is a ridge.
void enter_bump(const Values& of, Chain& chain) {
  const double a = of("amplitude_mm"), angle = of("angle_rad"), width = of("width_rad");
  const double position = of("position_mm"), length = of("length_mm");
  chain.form.push_back([=](const SurfacePoint& p) {
    const double v = std::remainder(p.theta_rad - angle, two_pi) / width;
    const double w = length > 0.0 ? (p.s_mm - position) / length : 0.0;
    return a * std::exp(-0.5 * (v * v + w * w));
  });
}

constexpr EffectParameter jaw_parameters[] = {{"order", {}},
                                              {"amplitude_mm", {}},
                                              {"phase_rad", 0.0},
                                              {"decay_length_mm", {}},
                                              {"jaw_position_mm", 0.0}};

// One harmonic of what the jaws do: the ring's ratio between them need not hold.
void enter_jaw(const Values& of, Chain& chain) {
  const double n = of("order"), a = of("amplitude_mm"), phase = of("phase_rad");
  const double length = of("decay_length_mm"), from = of("jaw_position_mm");
  chain.form.push_back([=](const SurfacePoint& p) {
    return p.clamp * a * std::cos(n * p.chuck_theta_rad - phase) *
           std::exp(-std::abs(p.s_mm - from) / length);
  });
}

constexpr EffectEntry table[] = {
    {{"extra.form_cell", "a P_degree(u) cos(n theta - phase)", cell_parameters}, enter_form_cell},
    {{"extra.form_line", "a cos(n theta - 2 pi s / period - phase)", form_line_parameters},
     enter_form_line},
    {{"extra.bump", "a local bump with a Gaussian section", bump_parameters}, enter_bump},
    {{"extra.jaw_harmonic", "a cos(n theta_chuck - phase) exp(-|s - jaw| / decay)", jaw_parameters},
     enter_jaw},
    {{"extra.motion_cell", "X + a P_degree(u) cos(n C - phase)", cell_parameters},
     enter_motion_cell},
    {{"extra.motion_time_cell", "X + a P_degree(time) cos(n C - phase)", time_cell_parameters},
     enter_time_cell},
    {{"extra.motion_line", "X + a cos(n C - 2 pi frequency t - phase)", motion_line_parameters},
     enter_motion_line},
};

}  // namespace

std::span<const EffectEntry> pattern_effects() { return table; }

}  // namespace trueaxis::virtual_lathe

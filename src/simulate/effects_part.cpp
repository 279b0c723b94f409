// SPDX-License-Identifier: Apache-2.0
// Slot C: what the part's surface is, in the part's own frame.
#include <cmath>
#include <numbers>

#include "simulate/chain.hpp"
#include "simulate/polynomials.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis::virtual_lathe {
namespace {

constexpr EffectParameter lobing_parameters[] = {{"amplitude_mm", {}},
                                                 {"jaws", 3.0},
                                                 {"jaw_angle_rad", 0.0},
                                                 {"decay_length_mm", {}},
                                                 {"jaw_position_mm", 0.0}};

// A ring pressed at j points bends as 1/(n² − 1)² at n = j, 2j, …
void enter_lobing(const Values& of, Chain& chain) {
  const double a = of("amplitude_mm"), j = of("jaws"), jaw = of("jaw_angle_rad");
  const double length = of("decay_length_mm"), from = of("jaw_position_mm");
  const double ratio = std::pow((j * j - 1.0) / (4.0 * j * j - 1.0), 2);
  chain.form.push_back([=](const SurfacePoint& p) {
    const double angle = j * (p.chuck_theta_rad - jaw);
    const double lobes = std::cos(angle) + ratio * std::cos(2.0 * angle);
    return p.clamp * a * lobes * std::exp(-std::abs(p.s_mm - from) / length);
  });
}

constexpr EffectParameter roundness_parameters[] = {
    {"order", {}}, {"amplitude_mm", {}}, {"growth_mm", 0.0}, {"phase_rad", 0.0}};

void enter_roundness(const Values& of, Chain& chain) {
  const double n = of("order"), a = of("amplitude_mm"), b = of("growth_mm"),
               phase = of("phase_rad");
  chain.form.push_back(
      [=](const SurfacePoint& p) { return (a + b * p.u) * std::cos(n * p.theta_rad - phase); });
}

constexpr EffectParameter barrel_parameters[] = {{"amplitude_mm", {}}, {"cubic_mm", 0.0}};

void enter_barrel(const Values& of, Chain& chain) {
  const double a = of("amplitude_mm"), b = of("cubic_mm");
  chain.form.push_back(
      [=](const SurfacePoint& p) { return a * legendre(2, p.u) + b * legendre(3, p.u); });
}

constexpr EffectParameter taper_parameters[] = {{"amplitude_mm", {}}};

void enter_taper(const Values& of, Chain& chain) {
  const double a = of("amplitude_mm");
  chain.form.push_back([=](const SurfacePoint& p) { return a * p.u; });
}

constexpr EffectParameter waviness_parameters[] = {
    {"amplitude_mm", {}}, {"wavelength_mm", {}}, {"phase_rad", 0.0}};

void enter_waviness(const Values& of, Chain& chain) {
  const double a = of("amplitude_mm"), k = two_pi / of("wavelength_mm"), phase = of("phase_rad");
  chain.form.push_back([=](const SurfacePoint& p) { return a * std::cos(k * p.s_mm + phase); });
}

constexpr EffectParameter marks_parameters[] = {
    {"amplitude_mm", {}}, {"feed_mm_per_rev", {}}, {"phase_rad", 0.0}};

void enter_marks(const Values& of, Chain& chain) {
  const double a = of("amplitude_mm"), k = two_pi / of("feed_mm_per_rev"), phase = of("phase_rad");
  chain.form.push_back(
      [=](const SurfacePoint& p) { return a * std::cos(k * p.s_mm - p.theta_rad + phase); });
}

constexpr EffectParameter bow_parameters[] = {
    {"sagitta_mm", {}}, {"length_mm", {}}, {"middle_mm", 0.0}, {"direction_rad", 0.0}};

// The axis is a parabola: sagitta at half the length from its middle, towards `direction`.
void enter_bow(const Values& of, Chain& chain) {
  const double kappa = of("sagitta_mm") / std::pow(0.5 * of("length_mm"), 2);
  const double middle = of("middle_mm"), direction = of("direction_rad");
  chain.bend.push_back([=](double s) {
    const double away = kappa * (s - middle) * (s - middle);
    return Vec3{away * std::cos(direction), away * std::sin(direction), 0.0};
  });
}

constexpr EffectParameter slip_parameters[] = {
    {"time_s", {}}, {"dx_mm", 0.0}, {"dy_mm", 0.0}, {"turn_rad", 0.0}};

void enter_slip(const Values& of, Chain& chain) {
  const double when = of("time_s");
  const PartStep step{of("dx_mm"), of("dy_mm"), of("turn_rad")};
  chain.step.push_back([=](double t) { return t < when ? PartStep{} : step; });
}

constexpr EffectParameter interruption_parameters[] = {
    {"angle_rad", {}}, {"width_rad", {}}, {"depth_mm", {}}, {"start_mm", -1e9}, {"end_mm", 1e9}};

// Material is missing over a sector: a keyway, a hole, a groove.
void enter_interruption(const Values& of, Chain& chain) {
  chain.local_form = true;
  const double angle = of("angle_rad"), half = 0.5 * of("width_rad"), depth = of("depth_mm");
  const double start = of("start_mm"), end = of("end_mm");
  chain.form.push_back([=](const SurfacePoint& p) {
    const bool inside = std::abs(std::remainder(p.theta_rad - angle, two_pi)) < half &&
                        p.s_mm >= start && p.s_mm <= end;
    return inside ? -p.outward * depth : 0.0;
  });
}

constexpr EffectEntry table[] = {
    {{"part.chuck_lobing", "jaws and twice jaws UPR, decaying from the jaws", lobing_parameters},
     enter_lobing},
    {{"part.roundness", "(a + b u) cos(n theta - phase)", roundness_parameters}, enter_roundness},
    {{"part.barrel", "a P2(u) + b P3(u)", barrel_parameters}, enter_barrel},
    {{"part.taper", "a u", taper_parameters}, enter_taper},
    {{"part.waviness", "a cos(2 pi s / wavelength + phase)", waviness_parameters}, enter_waviness},
    {{"part.feed_marks", "a cos(2 pi s / feed - theta + phase)", marks_parameters}, enter_marks},
    {{"part.bow", "axis bent to a parabola", bow_parameters}, enter_bow},
    {{"part.slip", "step of the part in the chuck at a time", slip_parameters}, enter_slip},
    {{"part.interruption", "material missing over a sector", interruption_parameters},
     enter_interruption},
};

}  // namespace

std::span<const EffectEntry> part_effects() { return table; }

}  // namespace trueaxis::virtual_lathe

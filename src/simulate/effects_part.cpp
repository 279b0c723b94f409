// SPDX-License-Identifier: Apache-2.0
#include "simulate/effects_part.hpp"

#include <cmath>

#include "simulate/polynomials.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis::virtual_lathe {
namespace {

constexpr EffectEntry part_table[] = {
    // A ring pressed at j points bends as 1/(n² − 1)² at n = j, 2j, …
    {"part.chuck_lobing",
     "jaws and twice jaws UPR, decaying from the jaws",
     {{"amplitude_mm", {}},
      {"jaws", 3.0},
      {"jaw_angle_rad", 0.0},
      {"decay_length_mm", {}},
      {"jaw_position_mm", 0.0}},
     [](const Values& of, Chain& chain) {
       const double a = of("amplitude_mm"), j = of("jaws"), jaw = of("jaw_angle_rad");
       const double length = of("decay_length_mm"), from = of("jaw_position_mm");
       const double ratio = std::pow((j * j - 1.0) / (4.0 * j * j - 1.0), 2);
       chain.form.push_back([=](const SurfacePoint& p) {
         const double angle = j * (p.chuck_theta_rad - jaw);
         const double lobes = std::cos(angle) + ratio * std::cos(2.0 * angle);
         return p.clamp * a * lobes * std::exp(-std::abs(p.s_mm - from) / length);
       });
     }},
    {"part.roundness",
     "(a + b u) cos(n theta - phase)",
     {{"order", {}}, {"amplitude_mm", {}}, {"growth_mm", 0.0}, {"phase_rad", 0.0}},
     [](const Values& of, Chain& chain) {
       const double n = of("order"), a = of("amplitude_mm"), b = of("growth_mm"),
                    phase = of("phase_rad");
       chain.form.push_back([=](const SurfacePoint& p) {
         return (a + b * p.u) * std::cos(n * p.theta_rad - phase);
       });
     }},
    {"part.barrel",
     "a P2(u) + b P3(u)",
     {{"amplitude_mm", {}}, {"cubic_mm", 0.0}},
     [](const Values& of, Chain& chain) {
       const double a = of("amplitude_mm"), b = of("cubic_mm");
       chain.form.push_back(
           [=](const SurfacePoint& p) { return a * legendre(2, p.u) + b * legendre(3, p.u); });
     }},
    {"part.taper",
     "a u",
     {{"amplitude_mm", {}}},
     [](const Values& of, Chain& chain) {
       const double a = of("amplitude_mm");
       chain.form.push_back([=](const SurfacePoint& p) { return a * p.u; });
     }},
    {"part.waviness",
     "a cos(2 pi s / wavelength + phase)",
     {{"amplitude_mm", {}}, {"wavelength_mm", {}}, {"phase_rad", 0.0}},
     [](const Values& of, Chain& chain) {
       const double a = of("amplitude_mm"), k = two_pi / of("wavelength_mm"),
                    phase = of("phase_rad");
       chain.form.push_back(
           [=](const SurfacePoint& p) { return a * std::cos(k * p.s_mm + phase); });
     }},
    {"part.feed_marks",
     "a cos(2 pi s / feed - theta + phase)",
     {{"amplitude_mm", {}}, {"feed_mm_per_rev", {}}, {"phase_rad", 0.0}},
     [](const Values& of, Chain& chain) {
       const double a = of("amplitude_mm"), k = two_pi / of("feed_mm_per_rev"),
                    phase = of("phase_rad");
       chain.form.push_back(
           [=](const SurfacePoint& p) { return a * std::cos(k * p.s_mm - p.theta_rad + phase); });
     }},
    // The axis is a parabola: sagitta at half the length from its middle, towards `direction`.
    {"part.bow",
     "axis bent to a parabola",
     {{"sagitta_mm", {}}, {"length_mm", {}}, {"middle_mm", 0.0}, {"direction_rad", 0.0}},
     [](const Values& of, Chain& chain) {
       const double kappa = of("sagitta_mm") / std::pow(0.5 * of("length_mm"), 2);
       const double middle = of("middle_mm"), direction = of("direction_rad");
       chain.bend.push_back([=](double s) {
         const double away = kappa * (s - middle) * (s - middle);
         return Vec3{away * std::cos(direction), away * std::sin(direction), 0.0};
       });
     }},
    {"part.slip",
     "step of the part in the chuck at a time",
     {{"time_s", {}}, {"dx_mm", 0.0}, {"dy_mm", 0.0}, {"turn_rad", 0.0}},
     [](const Values& of, Chain& chain) {
       const double when = of("time_s");
       const PartStep step{of("dx_mm"), of("dy_mm"), of("turn_rad")};
       chain.step.push_back([=](double t) { return t < when ? PartStep{} : step; });
     }},
    // Material is missing over a sector: a keyway, a hole, a groove.
    {"part.interruption",
     "material missing over a sector",
     {{"angle_rad", {}}, {"width_rad", {}}, {"depth_mm", {}}, {"start_mm", -1e9}, {"end_mm", 1e9}},
     [](const Values& of, Chain& chain) {
       chain.local_form = true;
       const double angle = of("angle_rad"), half = 0.5 * of("width_rad"), depth = of("depth_mm");
       const double start = of("start_mm"), end = of("end_mm");
       chain.form.push_back([=](const SurfacePoint& p) {
         const bool inside = std::abs(std::remainder(p.theta_rad - angle, two_pi)) < half &&
                             p.s_mm >= start && p.s_mm <= end;
         return inside ? -p.outward * depth : 0.0;
       });
     }},
};

}  // namespace

std::span<const EffectEntry> part_effects() { return part_table; }

}  // namespace trueaxis::virtual_lathe

// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "simulate/effects.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis::virtual_lathe {
namespace {

constexpr EffectEntry face_table[] = {
    // Of a face s is the distance from its axis.
    {"part.face_saddle",
     "a (r / radius)^2 cos(2 theta - phase)",
     {{"amplitude_mm", {}}, {"radius_mm", {}}, {"phase_rad", 0.0}},
     in<form>([](const SurfacePoint& p, double a, double radius, double phase) {
       const double x = p.s_mm * std::cos(p.theta_rad), y = p.s_mm * std::sin(p.theta_rad);
       const double along = x * x - y * y, across = 2.0 * x * y;
       return a * (along * std::cos(phase) + across * std::sin(phase)) / (radius * radius);
     })},
    {"part.face_lobes",
     "(a + b u) cos(n theta - phase)",
     {{"order", {}}, {"amplitude_mm", {}}, {"growth_mm", 0.0}, {"phase_rad", 0.0}},
     in<form>([](const SurfacePoint& p, double n, double a, double b, double phase) {
       return (a + b * p.u) * std::cos(n * p.theta_rad - phase);
     })},
    {"part.face_cone", "a u", {{"amplitude_mm", {}}}, in<form>([](const SurfacePoint& p, double a) {
       return a * p.u;
     })},
    {"part.face_crown",
     "dish ((r / radius)^2 - mean) + a P2(u) + b P3(u)",
     {{"dish_mm", 0.0},
      {"amplitude_mm", 0.0},
      {"cubic_mm", 0.0},
      {"radius_mm", {}},
      {"dish_mean", 0.0}},
     in<form>(
         [](const SurfacePoint& p, double dish, double a, double b, double radius, double mean) {
           const double share = p.s_mm / radius;
           return dish * (share * share - mean) + a * legendre(2, p.u) + b * legendre(3, p.u);
         })},
    {"part.face_spiral",
     "a cos(2 pi r / feed + theta + phase)",
     {{"amplitude_mm", {}}, {"feed_mm_per_rev", {}}, {"phase_rad", 0.0}},
     enter_wave<1>},
    {"part.seat_slip",
     "step of the part along Z and of its tilt at a time, or evenly over a duration from then",
     {{"time_s", {}},
      {"dz_mm", 0.0},
      {"tilt_x_rad", 0.0},
      {"tilt_y_rad", 0.0},
      {"ends", 0.0},
      {"duration_s", 0.0}},
     in<&Chain::step>([](double t, double when, double dz, double tilt_x, double tilt_y,
                         double ends, double duration) {
       PartStep step;
       const double share = slipped(t, when, duration, ends);
       step.dz_mm = share * dz;
       step.tilt_x_rad = share * tilt_x, step.tilt_y_rad = share * tilt_y;
       return step;
     })},
    // Z' = Z + …: the part comes towards −Z by that much.
    {"spindle.axial_fundamental",
     "Z' = Z + a cos(C - phase)",
     {{"amplitude_mm", {}}, {"phase_rad", 0.0}},
     in<machine>([](TrueState& state, double a, double phase) {
       state.part_z_mm -= a * std::cos(state.c_rad - phase);
     })},
    {"spindle.axial_asynchronous",
     "Z' = Z + a cos(order C + phase), a fractional order",
     {{"order", {}}, {"amplitude_mm", {}}, {"phase_rad", 0.0}},
     in<machine>([](TrueState& state, double kappa, double a, double phase) {
       state.part_z_mm -= a * std::cos(kappa * state.c_rad + phase);
     })},
    // The spindle nods about the machine's Y: z moves with −x.
    {"spindle.face_tilt",
     "Z' = Z + a cos(n C - phase) X",
     {{"order", {}}, {"amplitude_rad", {}}, {"phase_rad", 0.0}},
     in<machine>([](TrueState& state, double n, double a, double phase) {
       state.part_z_mm -= a * std::cos(n * state.c_rad - phase) * state.at.position_mm;
     })},
    {"slide.xz_squareness",
     "Z + slope (X - middle)",
     {{"slope_rad", {}}, {"middle_mm", 0.0}},
     in<machine>([](TrueState& state, double slope, double middle) {
       state.across_mm += slope * (state.at.position_mm - middle);
     })},
    {"slide.x_straightness",
     "Z + a P_degree(u)",
     {{"degree", 2.0}, {"amplitude_mm", {}}},
     in<machine>([](TrueState& state, double degree, double a) {
       state.across_mm += a * legendre(degree, state.u);
     })},
};

}  // namespace

std::span<const EffectEntry> face_effects() { return face_table; }

}  // namespace trueaxis::virtual_lathe

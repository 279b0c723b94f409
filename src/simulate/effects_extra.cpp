// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "simulate/effects.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis::virtual_lathe {
namespace {

constexpr EffectEntry extra_table[] = {
    // Lobes that turn about the axis on their way along it.
    {"extra.spiral",
     "lobes that turn along the axis",
     {{"order", {}}, {"amplitude_mm", {}}, {"lead_mm", {}}, {"phase_rad", 0.0}},
     in<form>([](const SurfacePoint& p, double n, double a, double lead, double phase) {
       return a * std::cos(n * (p.theta_rad - two_pi / lead * p.s_mm) - phase);
     })},
    // A local dent with a Gaussian section; width and length are its standard deviations.
    {"extra.dent",
     "a local dent",
     {{"angle_rad", {}},
      {"position_mm", {}},
      {"depth_mm", {}},
      {"width_rad", {}},
      {"length_mm", {}}},
     [](const Values& of, Chain& chain) {
       chain.local_form = true;
       in<form>([](const SurfacePoint& p, double angle, double position, double depth, double width,
                   double length) {
         const double v = std::remainder(p.theta_rad - angle, two_pi) / width;
         const double w = (p.s_mm - position) / length;
         return -p.outward * depth * std::exp(-0.5 * (v * v + w * w));
       })(of, chain);
     }},
    // A step of the diameter.
    {"extra.ledge",
     "the radius larger from a place on",
     {{"amplitude_mm", {}}, {"position_mm", {}}},
     in<form>([](const SurfacePoint& p, double a, double position) {
       return p.s_mm < position ? 0.0 : a;
     })},
    // An error motion of the spindle whose amplitude swings with time.
    {"extra.beat",
     "error motion that swings with time",
     {{"order", {}}, {"amplitude_mm", {}}, {"beat_hz", {}}, {"phase_rad", 0.0}},
     in<machine>([](TrueState& state, double n, double a, double beat, double phase) {
       state.part_x_mm +=
           a * std::cos(two_pi * beat * state.at.t_s) * std::cos(n * state.c_rad - phase);
     })},
    // What one probe at +X cannot see: the spindle moves across it. The order may be fractional.
    {"extra.radial_motion_y",
     "the part moves along Y by a cos(n C - phase)",
     {{"order", {}}, {"amplitude_mm", {}}, {"phase_rad", 0.0}},
     in<machine>([](TrueState& state, double n, double a, double phase) {
       state.part_y_mm += a * std::cos(n * state.c_rad - phase);
     })},
    {"extra.form_cell",
     "a P_degree(u) cos(n theta - phase)",
     {{"order", 0.0}, {"amplitude_mm", {}}, {"phase_rad", 0.0}, {"degree", 0.0}},
     in<form>([](const SurfacePoint& p, double n, double a, double phase, double degree) {
       return a * legendre(degree, p.u) * std::cos(n * p.theta_rad - phase);
     })},
    {"extra.form_line",
     "a cos(n theta - 2 pi s / period - phase)",
     {{"order", 0.0}, {"amplitude_mm", {}}, {"phase_rad", 0.0}, {"period_mm", {}}},
     in<form>([](const SurfacePoint& p, double n, double a, double phase, double period) {
       return a * std::cos(n * p.theta_rad - two_pi / period * p.s_mm - phase);
     })},
    // Gaussian, width and length its standard deviations; without a length it is a ridge.
    {"extra.bump",
     "a local bump with a Gaussian section",
     {{"amplitude_mm", {}},
      {"angle_rad", {}},
      {"width_rad", {}},
      {"position_mm", 0.0},
      {"length_mm", 0.0}},
     in<form>([](const SurfacePoint& p, double a, double angle, double width, double position,
                 double length) {
       const double v = std::remainder(p.theta_rad - angle, two_pi) / width;
       const double w = length > 0.0 ? (p.s_mm - position) / length : 0.0;
       return a * std::exp(-0.5 * (v * v + w * w));
     })},
    // One harmonic of what the jaws do: the ring's ratio between them need not hold.
    {"extra.jaw_harmonic",
     "a cos(n theta_chuck - phase) exp(-|s - jaw| / decay)",
     {{"order", {}},
      {"amplitude_mm", {}},
      {"phase_rad", 0.0},
      {"decay_length_mm", {}},
      {"jaw_position_mm", 0.0}},
     in<form>(
         [](const SurfacePoint& p, double n, double a, double phase, double length, double from) {
           return p.clamp * a * std::cos(n * p.chuck_theta_rad - phase) *
                  std::exp(-std::abs(p.s_mm - from) / length);
         })},
    {"extra.motion_cell",
     "X + a P_degree(u) cos(n C - phase)",
     {{"order", 0.0}, {"amplitude_mm", {}}, {"phase_rad", 0.0}, {"degree", 0.0}},
     in<machine>([](TrueState& state, double n, double a, double phase, double degree) {
       state.across_mm += a * legendre(degree, state.u_part) * std::cos(n * state.at.c_rad - phase);
     })},
    {"extra.motion_time_cell",
     "X + a P_degree(time) cos(n C - phase)",
     {{"order", 0.0},
      {"amplitude_mm", {}},
      {"phase_rad", 0.0},
      {"degree", 1.0},
      {"start_s", 0.0},
      {"end_s", {}}},
     in<machine>([](TrueState& state, double n, double a, double phase, double degree, double start,
                    double end) {
       const double u = end > start ? 2.0 * (state.at.t_s - start) / (end - start) - 1.0 : 0.0;
       state.across_mm += a * legendre(degree, u) * std::cos(n * state.at.c_rad - phase);
     })},
    {"extra.motion_line",
     "X + a cos(n C - 2 pi frequency t - phase)",
     {{"order", 0.0}, {"amplitude_mm", {}}, {"phase_rad", 0.0}, {"frequency_hz", {}}},
     in<machine>([](TrueState& state, double n, double a, double phase, double frequency) {
       state.across_mm +=
           a * std::cos(n * state.at.c_rad - two_pi * frequency * state.at.t_s - phase);
     })},
};

}  // namespace

std::span<const EffectEntry> extra_effects() { return extra_table; }

}  // namespace trueaxis::virtual_lathe

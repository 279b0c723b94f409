// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "base/angle.hpp"
#include "simulate/effects.hpp"
#include "trueaxis/error.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis::virtual_lathe {
namespace {

constexpr double without_end_s = 1e9;

constexpr EffectEntry part_table[] = {
    // A ring pressed at j points bends as 1/(n² − 1)² at n = j, 2j, …
    {"part.chuck_lobing",
     "jaws and twice jaws UPR, decaying from the jaws",
     {{"amplitude_mm", {}},
      {"jaws", 3.0},
      {"jaw_angle_rad", 0.0},
      {"decay_length_mm", {}},
      {"jaw_position_mm", 0.0}},
     in<form>(
         [](const SurfacePoint& p, double a, double j, double jaw, double length, double from) {
           const double ratio = std::pow((j * j - 1.0) / (4.0 * j * j - 1.0), 2);
           const double angle = j * (p.chuck_theta_rad - jaw);
           const double lobes = std::cos(angle) + ratio * std::cos(2.0 * angle);
           return p.clamp * a * lobes * std::exp(-std::abs(p.s_mm - from) / length);
         })},
    {"part.roundness",
     "(a + b u) cos(n theta - phase)",
     {{"order", {}}, {"amplitude_mm", {}}, {"growth_mm", 0.0}, {"phase_rad", 0.0}},
     in<form>([](const SurfacePoint& p, double n, double a, double b, double phase) {
       return (a + b * p.u) * std::cos(n * p.theta_rad - phase);
     })},
    {"part.barrel",
     "a P2(u) + b P3(u)",
     {{"amplitude_mm", {}}, {"cubic_mm", 0.0}},
     in<form>([](const SurfacePoint& p, double a, double b) {
       return a * legendre(2, p.u) + b * legendre(3, p.u);
     })},
    {"part.end_form",
     "low exp(-(d/reach)^2/2) of the distance d from where u is -1, and high of that from where it "
     "is 1",
     {{"low_mm", 0.0}, {"high_mm", 0.0}, {"reach_mm", {}}},
     in<form>([](const SurfacePoint& p, double low, double high, double reach) {
       const double from_low = (1.0 + p.u) * p.u_half_mm, from_high = (1.0 - p.u) * p.u_half_mm;
       return low * std::exp(-0.5 * std::pow(from_low / reach, 2)) +
              high * std::exp(-0.5 * std::pow(from_high / reach, 2));
     })},
    {"part.taper", "a u", {{"amplitude_mm", {}}}, in<form>([](const SurfacePoint& p, double a) {
       return a * p.u;
     })},
    {"part.waviness",
     "a cos(2 pi s / wavelength + phase)",
     {{"amplitude_mm", {}}, {"wavelength_mm", {}}, {"phase_rad", 0.0}},
     enter_wave<0>},
    {"part.feed_marks",
     "a cos(2 pi s / feed - theta + phase)",
     {{"amplitude_mm", {}}, {"feed_mm_per_rev", {}}, {"phase_rad", 0.0}},
     enter_wave<-1>},
    // The axis is a parabola: sagitta at half the length from its middle, towards `direction`,
    // which
    // the part's axis touches in the middle, or is `share` of the sagitta away from.
    {"part.bow",
     "axis bent to a parabola",
     {{"sagitta_mm", {}},
      {"length_mm", {}},
      {"middle_mm", 0.0},
      {"direction_rad", 0.0},
      {"share", 0.0}},
     in<&Chain::bend>([](double s, double sagitta, double length, double middle, double direction,
                         double share) {
       const double kappa = sagitta / std::pow(0.5 * length, 2);
       const double away = kappa * (s - middle) * (s - middle) - share * sagitta;
       return Vec3{away * std::cos(direction), away * std::sin(direction), 0.0};
     })},
    {"part.slip",
     "step of the part in the chuck at a time, or evenly over a duration from then, tilt about Z = "
     "middle; 'ends' 1: the part is described as it is afterwards",
     {{"time_s", {}},
      {"dx_mm", 0.0},
      {"dy_mm", 0.0},
      {"turn_rad", 0.0},
      {"tilt_x_rad", 0.0},
      {"tilt_y_rad", 0.0},
      {"dr_mm", 0.0},
      {"taper_rad", 0.0},
      {"middle_mm", 0.0},
      {"ends", 0.0},
      {"duration_s", 0.0}},
     [](const Values& of, Chain& chain) {
       in<&Chain::step>([](double t, double when, double dx, double dy, double turn, double tilt_x,
                           double tilt_y, double, double, double middle, double ends,
                           double duration) {
         const double share = slipped(t, when, duration, ends);
         return PartStep{share * (dx - middle * tilt_x),
                         share * (dy - middle * tilt_y),
                         share * turn,
                         0.0,
                         share * tilt_x,
                         share * tilt_y};
       })(of, chain);
       in<&Chain::machine>([](TrueState& state, double when, double, double, double, double, double,
                              double dr, double taper, double middle, double ends,
                              double duration) {
         const double share = slipped(state.at.t_s, when, duration, ends);
         state.part_x_mm += share * (dr + taper * (state.at.position_mm - middle));
       })(of, chain);
     }},
    {"part.creep",
     "the part moves in the chuck as 1 - exp(-t/settling) from a time on, without 'settling' "
     "evenly over 'duration'; 'ends' 1: the part is described as it is after 'duration'",
     {{"settling_s", 0.0},
      {"time_s", 0.0},
      {"dx_mm", 0.0},
      {"dy_mm", 0.0},
      {"tilt_x_rad", 0.0},
      {"tilt_y_rad", 0.0},
      {"middle_mm", 0.0},
      {"ends", 0.0},
      {"duration_s", without_end_s}},
     in<&Chain::step>([](double t, double settling, double from, double dx, double dy,
                         double tilt_x, double tilt_y, double middle, double ends,
                         double duration) {
       if (settling == 0.0 && duration == without_end_s)
         throw InputError("scenario", "part.creep: give `settling`, or `duration` if it is even");
       const auto relaxed = [&](double since) {
         return settling > 0.0 ? 1.0 - std::exp(-since / settling) : since;
       };
       const double whole = relaxed(duration);
       const double share = relaxed(std::max(0.0, t - from)) / whole - (ends > 0.5 ? 1.0 : 0.0);
       return PartStep{share * (dx - middle * tilt_x),
                       share * (dy - middle * tilt_y),
                       0.0,
                       0.0,
                       share * tilt_x,
                       share * tilt_y};
     })},
    // Material is missing over a sector: a keyway, a hole, a groove.
    {"part.interruption",
     "material missing over a sector",
     {{"angle_rad", {}}, {"width_rad", {}}, {"depth_mm", {}}, {"start_mm", -1e9}, {"end_mm", 1e9}},
     [](const Values& of, Chain& chain) {
       chain.local_form = true;
       in<form>([](const SurfacePoint& p, double angle, double width, double depth, double start,
                   double end) {
         const bool inside =
             apart_rad(p.theta_rad, angle) < 0.5 * width && p.s_mm >= start && p.s_mm <= end;
         return inside ? -p.outward * depth : 0.0;
       })(of, chain);
     }},
};

}  // namespace

std::span<const EffectEntry> part_effects() { return part_table; }

}  // namespace trueaxis::virtual_lathe

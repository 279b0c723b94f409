// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <ostream>
#include <string>
#include <vector>

#include "trueaxis/effect.hpp"

namespace trueaxis::testing {

inline constexpr double phi = 0.7;           ///< phase of all that have one
inline constexpr double face_end_mm = 40.0;  ///< X where the probing of a face ends

/// An effect of the virtual lathe at a size, and the linear parameters that docs/theory.md gives it
/// per unit of the size.
struct LatheCase {
  std::string id;
  double size;  ///< small enough for the second order to be below a twentieth of the first
  std::function<std::map<std::string, double>(double size)> lathe;
  TermShape shape;
  std::vector<double> linear;
  bool has_limit = true;  ///< flat tops have none: they last by the root of the play
};

inline void PrintTo(const LatheCase& c, std::ostream* out) { *out << c.id; }

/// @param middle_mm, half_mm of the X that a face is probed at
inline std::vector<LatheCase> all_lathe_cases(double middle_mm = 24.0, double half_mm = 16.0) {
  const double co = std::cos(phi), si = std::sin(phi);
  const double ring = std::pow((9.0 - 1.0) / (36.0 - 1.0), 2);  // three jaws
  const double mean =
      (middle_mm * middle_mm + half_mm * half_mm / 3.0) / (face_end_mm * face_end_mm);
  using Parameters = std::map<std::string, double>;
  return {
      {"part.chuck_lobing",
       1e-3,
       [](double a) {
         return Parameters{{"amplitude_mm", a},
                           {"jaws", 3},
                           {"jaw_angle_rad", phi / 3},
                           {"decay_length_mm", 30},
                           {"jaw_position_mm", -25}};
       },
       {.order = 3, .lever_from_mm = -25, .decay_length_mm = 30},
       {co, si, ring * std::cos(2 * phi), ring * std::sin(2 * phi)}},
      {"part.roundness",
       1e-3,
       [](double a) {
         return Parameters{
             {"order", 3}, {"amplitude_mm", a}, {"growth_mm", 0.5 * a}, {"phase_rad", phi}};
       },
       {.order = 3},
       {co, si, 0.5 * co, 0.5 * si}},
      {"part.barrel",
       1e-3,
       [](double a) {
         return Parameters{{"amplitude_mm", a}, {"cubic_mm", 0.4 * a}};
       },
       {},
       {1.0, 0.4}},
      {"part.taper",
       1e-3,
       [](double a) {
         return Parameters{{"amplitude_mm", a}};
       },
       {},
       {1.0}},
      {"part.waviness",
       1e-3,
       [](double a) {
         return Parameters{{"amplitude_mm", a}, {"wavelength_mm", 7}, {"phase_rad", phi}};
       },
       {.period_mm = 7},
       {co, -si}},
      {"part.feed_marks",
       1e-3,
       [](double a) {
         return Parameters{{"amplitude_mm", a}, {"feed_mm_per_rev", 3}, {"phase_rad", phi}};
       },
       {.period_mm = 3},
       {co, -si}},
      {"part.bow",
       1e-3,
       [](double a) {
         return Parameters{{"sagitta_mm", a},
                           {"length_mm", 50},
                           {"middle_mm", 5},
                           {"direction_rad", phi},
                           {"share", 1.0 / 3.0}};
       },
       {},
       {co, si}},
      {"part.slip",
       1e-3,
       [](double a) {
         return Parameters{{"time_s", 12.345}, {"dx_mm", a}, {"dy_mm", -0.5 * a}, {"ends", 1}};
       },
       {.onset_s = 12.345},
       {1.0, -0.5, 0.0, 0.0, 0.0, 0.0, 0.0}},
      {"part.slip",
       1e-3,
       [](double a) {
         return Parameters{{"time_s", 12.345}, {"turn_rad", a}, {"ends", 1}};
       },
       {.onset_s = 12.345},
       {0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0}},
      {"part.slip",
       1e-3,
       [](double a) {
         return Parameters{{"time_s", 12.345},
                           {"tilt_x_rad", 0.02 * a},
                           {"tilt_y_rad", -0.01 * a},
                           {"middle_mm", 5},
                           {"ends", 1}};
       },
       {.onset_s = 12.345},
       {0.0, 0.0, 0.0, 0.02, -0.01, 0.0, 0.0}},
      {"part.slip",
       1e-3,
       [](double a) {
         return Parameters{{"time_s", 12.345},
                           {"dr_mm", 0.5 * a},
                           {"taper_rad", 0.01 * a},
                           {"middle_mm", 5},
                           {"ends", 1}};
       },
       {.onset_s = 12.345},
       {0.0, 0.0, 0.0, 0.0, 0.0, 0.5, 0.01}},
      {"spindle.radial_synchronous",
       1e-3,
       [](double a) {
         return Parameters{{"order", 4}, {"amplitude_mm", a}, {"phase_rad", phi}};
       },
       {.order = 4},
       {co, si}},
      {"spindle.tilt_synchronous",
       1e-5,
       [](double a) {
         return Parameters{
             {"order", 2}, {"amplitude_rad", a}, {"phase_rad", phi}, {"bearing_mm", -150}};
       },
       {.order = 2, .lever_from_mm = -150},
       {co, si, 0.0, 0.0}},
      {"spindle.axial_synchronous",
       1e-3,
       [](double a) {
         return Parameters{{"order", 2}, {"amplitude_mm", a}, {"phase_rad", phi}};
       },
       {.order = 2},
       {co, si}},
      {"spindle.asynchronous",
       1e-3,
       [](double a) {
         return Parameters{{"order", 0.42}, {"amplitude_mm", a}, {"phase_rad", phi}};
       },
       {.order = 0.42},
       {co, -si}},
      {"slide.z_straightness",
       1e-3,
       [](double a) {
         return Parameters{{"degree", 4}, {"amplitude_mm", a}};
       },
       {.degree = 4},
       {0.0, 0.0, 1.0}},
      {"slide.xz_parallelism",
       1e-5,
       [](double a) {
         return Parameters{{"slope_rad", a}};
       },
       {},
       {1.0}},
      {"slide.leadscrew_periodic",
       1e-3,
       [](double a) {
         return Parameters{{"amplitude_mm", a}, {"pitch_mm", 8}, {"phase_rad", phi}};
       },
       {.period_mm = 8},
       {co, -si}},
      {"slide.backlash",
       1e-3,
       [](double a) {
         return Parameters{{"along_mm", a}, {"across_mm", -0.3 * a}};
       },
       {},
       {1.0, -0.3}},
      {"slide.backlash",
       1e-3,
       [](double a) {
         return Parameters{{"along_mm", a}};
       },
       {},
       {1.0, 0.0}},
      {"probe.height",
       1e-3,
       [](double a) {
         return Parameters{{"height_mm", a}};
       },
       {},
       {1.0}},
      {"probe.tilt",
       1e-5,
       [](double a) {
         return Parameters{{"angle_rad", a}};
       },
       {},
       {1.0}},
      {"probe.ball_radius",
       0.1,
       [](double a) {
         return Parameters{{"radius_mm", a}};
       },
       {},
       {1.0}},
      {"probe.pretravel",
       1e-3,
       [](double a) {
         return Parameters{
             {"amplitude_mm", a}, {"lobing_mm", 0.8 * a}, {"order", 3}, {"phase_rad", phi}};
       },
       {.order = 3},
       {1.0, 0.8 * co, 0.8 * si}},
      {"probe.pretravel",
       1e-3,  // the lobes alone: they are small beside the constant
       [](double a) {
         return Parameters{{"amplitude_mm", 0}, {"lobing_mm", a}, {"order", 3}, {"phase_rad", phi}};
       },
       {.order = 3},
       {0.0, co, si}},
      {"probe.gain",
       1e-3,
       [](double a) {
         return Parameters{{"gain", a}, {"reference_mm", 39.8}};
       },
       {.reference_x_mm = 39.8},
       {1.0}},
      {"probe.nonlinearity",
       1e-3,
       [](double a) {
         return Parameters{
             {"quadratic_mm", a}, {"cubic_mm", 0.6 * a}, {"reference_mm", 39.8}, {"range_mm", 2}};
       },
       {.reference_x_mm = 39.8, .range_mm = 2},
       {1.0, 0.6}},
      {"probe.cyclic",
       1e-3,
       [](double a) {
         return Parameters{{"amplitude_mm", a}, {"period_mm", 0.5}, {"phase_rad", phi}};
       },
       {.period_mm = 0.5},
       {co, -si}},
      {"probe.latency",
       1e-4,
       [](double a) {
         return Parameters{{"delay_s", a}};
       },
       {},
       {1.0}},
      {"probe.lag",
       1e-4,
       [](double a) {
         return Parameters{{"time_constant_s", a}};
       },
       {.time_constant_s = 0.0},
       {1.0}},
      {"probe.hysteresis",
       2e-3,
       [](double b) {
         return Parameters{{"play_mm", b}};
       },
       {.play_mm = 2e-3},
       {1.0},
       false},
      {"encoder.offset",
       1e-4,
       [](double a) {
         return Parameters{{"angle_rad", a}};
       },
       {},
       {1.0}},
      {"encoder.eccentricity",
       1e-4,
       [](double a) {
         return Parameters{{"amplitude_rad", a}, {"phase_rad", phi}};
       },
       {},
       {co, si}},
      {"thermal.drift",
       1e-3,
       [](double a) {
         return Parameters{{"rate_mm_per_s", 0.1 * a}, {"amplitude_mm", a}, {"time_constant_s", 9}};
       },
       {.time_constant_s = 9},
       {0.1, 1.0}},
      {"environment.vibration",
       1e-3,
       [](double a) {
         return Parameters{{"amplitude_mm", a}, {"frequency_hz", 3.3}, {"phase_rad", phi}};
       },
       {.frequency_hz = 3.3},
       {co, -si}},
      {"part.face_saddle",
       1e-3,
       [](double a) {
         return Parameters{{"amplitude_mm", a}, {"radius_mm", face_end_mm}, {"phase_rad", phi}};
       },
       {},
       {co, si}},
      {"part.face_lobes",
       1e-3,
       [](double a) {
         return Parameters{
             {"order", 3}, {"amplitude_mm", a}, {"growth_mm", 0.5 * a}, {"phase_rad", phi}};
       },
       {.order = 3},
       {co, si, 0.5 * co, 0.5 * si}},
      {"part.face_cone",
       1e-3,
       [](double a) {
         return Parameters{{"amplitude_mm", a}};
       },
       {},
       {1.0}},
      {"part.face_crown",
       1e-3,
       [mean](double a) {
         return Parameters{{"dish_mm", a},
                           {"amplitude_mm", 0.5 * a},
                           {"cubic_mm", -0.4 * a},
                           {"radius_mm", face_end_mm},
                           {"dish_mean", mean}};
       },
       {},
       {1.0, 0.5, -0.4}},
      {"part.face_spiral",
       1e-3,
       [](double a) {
         return Parameters{{"amplitude_mm", a}, {"feed_mm_per_rev", 3}, {"phase_rad", phi}};
       },
       {.period_mm = 3},
       {co, -si}},
      {"part.seat_slip",
       1e-3,
       [](double a) {
         return Parameters{{"time_s", 12.345},
                           {"dz_mm", a},
                           {"tilt_x_rad", 0.02 * a},
                           {"tilt_y_rad", -0.01 * a},
                           {"ends", 1}};
       },
       {.onset_s = 12.345},
       {1.0, 0.02, -0.01}},
      {"spindle.axial_fundamental",
       1e-3,
       [](double a) {
         return Parameters{{"amplitude_mm", a}, {"phase_rad", phi}};
       },
       {},
       {co, si}},
      {"spindle.axial_asynchronous",
       1e-3,
       [](double a) {
         return Parameters{{"order", 0.42}, {"amplitude_mm", a}, {"phase_rad", phi}};
       },
       {.order = 0.42},
       {co, -si}},
      {"spindle.face_tilt",
       1e-5,
       [](double a) {
         return Parameters{{"order", 2}, {"amplitude_rad", a}, {"phase_rad", phi}};
       },
       {.order = 2},
       {co, si, 0.0, 0.0}},
      {"slide.xz_squareness",
       1e-5,
       [middle_mm](double a) {
         return Parameters{{"slope_rad", a}, {"middle_mm", middle_mm}};
       },
       {},
       {1.0}},
      {"slide.x_straightness",
       1e-3,
       [](double a) {
         return Parameters{{"degree", 3}, {"amplitude_mm", a}};
       },
       {.degree = 3},
       {0.0, 0.0, 1.0}},
  };
}

/// Those of the effects that streams of a kind have.
inline std::vector<LatheCase> lathe_cases(StreamKind kind = StreamKind::lateral,
                                          double middle_mm = 24.0, double half_mm = 16.0) {
  std::vector<LatheCase> list = all_lathe_cases(middle_mm, half_mm);
  std::erase_if(list, [&](const LatheCase& one) {
    return find_effect(one.id)->needs.stream.value_or(kind) != kind;
  });
  return list;
}

}  // namespace trueaxis::testing

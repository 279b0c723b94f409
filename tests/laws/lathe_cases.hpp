// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <string>
#include <vector>

#include "laws/face_lathe_cases.hpp"
#include "laws/lathe_case.hpp"

namespace trueaxis::testing {

/// What a shaft or a bore shows, and of these what a face shows too.
inline std::vector<LatheCase> lateral_lathe_cases() {
  const double co = std::cos(phi), si = std::sin(phi);
  const double ring = std::pow((9.0 - 1.0) / (36.0 - 1.0), 2);  // three jaws
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
      {"part.end_form",
       1e-3,
       [](double a) {
         return Parameters{{"low_mm", a}, {"reach_mm", 6}};
       },
       {.decay_length_mm = 6},
       {1.0, 0.0}},
      {"part.end_form",
       1e-3,
       [](double a) {
         return Parameters{{"high_mm", a}, {"reach_mm", 6}};
       },
       {.decay_length_mm = 6},
       {0.0, 1.0}},
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
         return Parameters{{"time_s", 8.5},     {"duration_s", 6.25}, {"dx_mm", a},
                           {"dy_mm", -0.5 * a}, {"dr_mm", 0.25 * a},  {"ends", 1}};
       },
       {.onset_s = 8.5, .duration_s = 6.25},
       {1.0, -0.5, 0.0, 0.0, 0.0, 0.25, 0.0}},
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
      {"part.creep",
       1e-3,
       [](double a) {
         return Parameters{{"duration_s", 60.0},
                           {"settling_s", 14.0},
                           {"dx_mm", a},
                           {"dy_mm", -0.5 * a},
                           {"ends", 1}};
       },
       {.onset_s = 0.0, .duration_s = 60.0, .settling_s = 14.0},
       {1.0, -0.5, 0.0, 0.0, 0.0, 0.0, 0.0}},
      {"part.creep",
       1e-3,
       [](double a) {
         return Parameters{{"duration_s", 60.0},     {"settling_s", 14.0},
                           {"tilt_x_rad", 0.02 * a}, {"tilt_y_rad", -0.01 * a},
                           {"middle_mm", 5},         {"ends", 1}};
       },
       {.onset_s = 0.0, .duration_s = 60.0, .settling_s = 14.0},
       {0.0, 0.0, 0.0, 0.02, -0.01, 0.0, 0.0}},
      {"part.creep",  // evenly
       1e-3,
       [](double a) {
         return Parameters{{"duration_s", 60.0}, {"dx_mm", a}, {"dy_mm", -0.5 * a}, {"ends", 1}};
       },
       {.onset_s = 0.0, .duration_s = 60.0},
       {1.0, -0.5, 0.0, 0.0, 0.0, 0.0, 0.0}},
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
       1e-3,  // the lobes alone: they are small compared with the constant
       [](double a) {
         return Parameters{{"amplitude_mm", 0}, {"lobing_mm", a}, {"order", 3}, {"phase_rad", phi}};
       },
       {.order = 3},
       {0.0, co, si}},
      {"probe.x_zero",
       1e-3,
       [](double a) {
         return Parameters{{"offset_mm", a}};
       },
       {},
       {1.0}},
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
  };
}

/// @param middle_mm, half_mm of the X that a face is probed at
inline std::vector<LatheCase> all_lathe_cases(double middle_mm = 24.0, double half_mm = 16.0) {
  std::vector<LatheCase> list = lateral_lathe_cases();
  std::ranges::move(face_lathe_cases(middle_mm, half_mm), std::back_inserter(list));
  return list;
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

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "laws/lathe_case.hpp"

namespace trueaxis::testing {

/// What a face shows. @param middle_mm, half_mm of the X that it is probed at
inline std::vector<LatheCase> face_lathe_cases(double middle_mm, double half_mm) {
  const double co = std::cos(phi), si = std::sin(phi);
  const double mean =
      (middle_mm * middle_mm + half_mm * half_mm / 3.0) / (face_end_mm * face_end_mm);
  using Parameters = std::map<std::string, double>;
  return {
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
      {"part.seat_slip",
       1e-3,
       [](double a) {
         return Parameters{{"time_s", 8.5},          {"duration_s", 6.25},      {"dz_mm", a},
                           {"tilt_x_rad", 0.02 * a}, {"tilt_y_rad", -0.01 * a}, {"ends", 1}};
       },
       {.onset_s = 8.5, .duration_s = 6.25},
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

}  // namespace trueaxis::testing

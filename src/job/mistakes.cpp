// SPDX-License-Identifier: Apache-2.0
#include "job/mistakes.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

constexpr double inch = mm_per_inch;

void multiply(std::vector<double>& column, double factor) {
  for (double& value : column) value *= factor;
}

void add(std::vector<double>& column, double number) {
  for (double& value : column) value += number;
}

struct Turned {
  double x, y;
};
Turned turned(double x, double y, double angle_rad) {
  const double c = std::cos(angle_rad), s = std::sin(angle_rad);
  return {c * x - s * y, s * x + c * y};
}

}  // namespace

std::span<const Mistake> mistakes() {
  using enum ReasonCode;
  static const std::vector<ReasonName> c{{"column", "C"}}, z{{"column", "Z"}},
      inches{{"unit", "inch"}}, mm{{"unit", "mm"}};
  const auto unit_of = [](const char* unit, const char* column) {
    return std::vector<ReasonName>{{"unit", unit}, {"column", column}};
  };
  static const Mistake list[] = {
      {.what = column_reversed, .mend = turn_sign, .of = c, .c = -1.0},
      {.what = x_convention_wrong,
       .mend = set_x_convention,
       .of = {{"convention", "diameter"}},
       .x = 0.5},
      {.what = x_convention_wrong,
       .mend = set_x_convention,
       .of = {{"convention", "radius"}},
       .x = 2.0},
      {.what = probed_from_behind, .mend = turn_sign_behind, .turn_rad = 0.5 * two_pi},
      {.what = column_reversed, .mend = turn_sign, .of = z, .z = -1.0},
      {.what = stream_in_unit, .mend = name_units, .of = inches, .x = inch, .z = inch},
      {.what = column_in_unit, .mend = name_unit, .of = unit_of("inch", "X"), .x = inch},
      {.what = column_in_unit, .mend = name_unit, .of = unit_of("inch", "Z"), .z = inch},
      {.what = stream_in_unit, .mend = name_units, .of = mm, .x = 1.0 / inch, .z = 1.0 / inch},
      {.what = column_in_unit, .mend = name_unit, .of = unit_of("mm", "X"), .x = 1.0 / inch},
      {.what = column_in_unit, .mend = name_unit, .of = unit_of("mm", "Z"), .z = 1.0 / inch},
      {.what = c_zero_differs, .mend = clamp_all_once_c, .open = OpenNumber::c_zero},
      {.what = z_zero_differs, .mend = clamp_all_once_z, .open = OpenNumber::z_zero}};
  return list;
}

ProbeStream mended(ProbeStream stream, const Mistake& mistake, double number) {
  const bool face = stream.kind == StreamKind::face;
  multiply(stream.reading_mm, face ? mistake.z : mistake.x);
  multiply(stream.position_mm, face ? mistake.x : mistake.z);
  multiply(stream.c_rad, mistake.c);
  add(stream.c_rad, mistake.turn_rad);
  if (mistake.open == OpenNumber::c_zero) add(stream.c_rad, number);
  if (mistake.open == OpenNumber::z_zero)
    add(face ? stream.reading_mm : stream.position_mm, number);
  return stream;
}

// A point of the part frame turns with C; x = X cos C, y = X sin C on the probe's line.
HeldAxis mended(HeldAxis held, const Mistake& mistake, double number) {
  const double angle = mistake.turn_rad + (mistake.open == OpenNumber::c_zero ? number : 0.0);
  const double slope = held.plane ? mistake.z / mistake.x : mistake.x / mistake.z;
  const double mirror = mistake.c < 0.0 ? -1.0 : 1.0;
  Axis& axis = held.estimate.axis;
  const Turned at = turned(mistake.x * axis.x_mm, mirror * mistake.x * axis.y_mm, angle);
  const Turned tilt = turned(slope * axis.slope_x, mirror * slope * axis.slope_y, angle);
  const double shift_mm = mistake.open == OpenNumber::z_zero ? number : 0.0;
  axis = {at.x, at.y, tilt.x, tilt.y, mistake.z * axis.z_ref_mm + shift_mm};
  held.z_mid_mm = mistake.z * held.z_mid_mm + shift_mm;
  Eigen::Matrix2d turn;
  turn << std::cos(angle), -std::sin(angle) * mirror, std::sin(angle), std::cos(angle) * mirror;
  Eigen::Matrix4d map = Eigen::Matrix4d::Zero();
  map.topLeftCorner<2, 2>() = mistake.x * turn;
  map.bottomRightCorner<2, 2>() = slope * turn;
  Eigen::Map<Eigen::Matrix<double, 4, 4, Eigen::RowMajor>> covariance(
      held.estimate.covariance.data());
  covariance = (map * covariance * map.transpose()).eval();
  return held;
}

double log_shrinkage(const Mistake& mistake, bool plane) {
  const double slope = std::abs(plane ? mistake.z / mistake.x : mistake.x / mistake.z);
  const double of_slopes = 2.0 * std::log(std::min(slope, 1.0));
  return plane ? of_slopes : of_slopes + 2.0 * std::log(std::min(std::abs(mistake.x), 1.0));
}

}  // namespace trueaxis

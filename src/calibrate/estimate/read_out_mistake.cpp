// SPDX-License-Identifier: Apache-2.0
#include "calibrate/estimate/read_out_mistake.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace trueaxis::calibrate_detail {
namespace {

constexpr double far_too_small = 30.0;  // times the noise that is stated
constexpr double same_factor = 0.02;    // of a factor between two units

struct Limits {
  double largest, left;  ///< mm or rad
};
Limits limits_of(AxisName axis) {
  return is_rotary(axis) ? Limits{20.0 * rad_per_deg, 0.5 * rad_per_deg} : Limits{5.0, 0.05};
}

struct Factor {
  double of;
  const char* words;
};

/// By what `actual` grows with `command`.
double slope_of(const MachineMeasurement& file) {
  const std::size_t axis = index_of(*file.axis);
  const auto n = static_cast<double>(file.rows());
  double x = 0.0, y = 0.0, xx = 0.0, xy = 0.0;
  for (std::size_t i = 0; i < file.rows(); ++i)
    x += file.axes[i][axis] / n, y += file.actual[i] / n;
  for (std::size_t i = 0; i < file.rows(); ++i) {
    const double dx = file.axes[i][axis] - x;
    xx += dx * dx;
    xy += dx * (file.actual[i] - y);
  }
  return xx > 0.0 ? xy / xx : 1.0;
}

std::string unit_mistake(const MachineMeasurement& file) {
  static constexpr Factor lengths[] = {{1e3, "actual is in um, or command in m"},
                                       {1e-3, "actual is in m, or command in um"},
                                       {25.4, "command is in inch"},
                                       {1.0 / 25.4, "actual is in inch"}};
  static constexpr Factor angles[] = {{rad_per_deg, "actual is in radians"},
                                      {1.0 / rad_per_deg, "command is in radians"}};
  const std::span<const Factor> factors =
      is_rotary(*file.axis) ? std::span<const Factor>(angles) : std::span<const Factor>(lengths);
  const double slope = slope_of(file);
  if (std::abs(slope + 1.0) < same_factor) return "one of the two columns runs the other way";
  for (const Factor& factor : factors)
    if (std::abs(slope / factor.of - 1.0) < same_factor)
      return std::string(factor.words) + ": write the unit that the numbers have";
  return "check that both columns belong to this axis and have the units of the header";
}

}  // namespace

std::string read_out_mistake(std::span<const MachineMeasurement> data, const Calibration& found) {
  auto read_out = found.read_outs.begin();
  for (const MachineMeasurement& file : data) {
    if (file.kind != MeasurementKind::axis || read_out == found.read_outs.end()) continue;
    const AxisReadOut& one = *read_out++;
    const bool rotary = is_rotary(one.axis);
    const double unit = rotary ? rad_per_deg : mm_per_um;
    const char* const name = rotary ? "deg" : "µm";
    const Limits limits = limits_of(one.axis);
    double largest = one.rms_before;
    if (one.polynomial.size() > 1) largest = std::max(largest, std::abs(one.polynomial[1].value));
    if (largest > limits.largest)
      return fmt::format("{}: actual and command of {} differ by {:.3g} {}: {}", file.source,
                         letter_of(one.axis), largest / unit, name, unit_mistake(file));
    const double noise = file.noise_mm.value_or(0.0);
    if (one.rms_after <= std::max(far_too_small * noise, limits.left)) continue;
    const std::string said =
        noise > 0.0 ? fmt::format(", and their stated noise is {:.2g} {}", noise / unit, name)
                    : std::string();
    return fmt::format("{}: the fit leaves residuals of {:.3g} {} in the read-out of {}{}: {}",
                       file.source, one.rms_after / unit, name, letter_of(one.axis), said,
                       unit_mistake(file));
  }
  return "";
}

}  // namespace trueaxis::calibrate_detail

// SPDX-License-Identifier: Apache-2.0
#include "form/section_trace.hpp"

#include <algorithm>
#include <cmath>

#include "form/circle.hpp"
#include "trueaxis/error.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis::form {
namespace {

/// A section of more readings than this many a wave at the cut-off (and than 8192) is averaged to
/// it: an average over one of 200 places lets 0.99996 of the wave through.
constexpr double places_a_wave = 200.0;

}  // namespace

SectionTrace::SectionTrace(const SectionReadings& readings, bool radius_known, double high_upr)
    : turns_(std::max(1.0, readings.turns)), radius_known_(radius_known) {
  if (readings.size() < 4) {
    trouble_ = "fewer than 4 readings";
    return;
  }
  double plane_mm = 0.0;
  if (radius_known)
    for (const double one : readings.distance_mm)
      plane_mm += one / static_cast<double>(readings.size());
  std::vector<double> off = readings.distance_mm;
  for (double& one : off) one -= plane_mm;
  const AssociatedCircle circle =
      associate_circle(readings.angle_rad, off, plane_mm, Criterion::gaussian);
  x_mm_ = circle.x_mm;
  y_mm_ = circle.y_mm;
  mean_mm_ = circle.radius_mm;
  const auto most = static_cast<std::size_t>(std::max(8192.0, places_a_wave * high_upr));
  most_ = readings.size() > most ? most : 0;
  for (std::size_t i = 0; i < readings.size(); ++i) {
    const double angle = readings.angle_rad[i], r = readings.distance_mm[i];
    angle_rad_.push_back(radius_known
                             ? std::atan2(r * std::sin(angle) - y_mm_, r * std::cos(angle) - x_mm_)
                             : angle);
  }
  trace_ = at_places(off_mean(readings));
  if (trace_.size() < 4) trouble_ = "fewer than 4 readings at different angles";
}

std::vector<double> SectionTrace::off_mean(const SectionReadings& readings) const {
  std::vector<double> off = readings.distance_mm;
  for (std::size_t i = 0; i < off.size(); ++i) {
    const double c = std::cos(readings.angle_rad[i]), s = std::sin(readings.angle_rad[i]);
    off[i] = radius_known_ ? std::hypot(off[i] * c - x_mm_, off[i] * s - y_mm_) - mean_mm_
                           : off[i] - mean_mm_ - x_mm_ * c - y_mm_ * s;
  }
  return off;
}

Trace SectionTrace::at_places(const std::vector<double>& off_mm) const {
  return sorted_trace(angle_rad_, off_mm, two_pi, turns_, most_);
}

std::vector<double> SectionTrace::changed(const SectionReadings& readings) const {
  expects(readings.size() == angle_rad_.size(), "the readings of the section");
  return at_places(off_mean(readings)).value_mm;
}

}  // namespace trueaxis::form

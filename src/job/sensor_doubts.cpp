// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <variant>

#include "job/checks.hpp"

namespace trueaxis {
namespace {

bool is_function_of_reading(const Effect& effect) {
  const auto* response = std::get_if<Response>(&effect.term);
  return response &&
         (response->of == Response::Of::nonlinearity || response->of == Response::Of::cyclic);
}

/// Whether the readings of a reference change by its eccentricity more than by anything else.
bool turns_off_centre(const IdentifiedJob& job, std::size_t i) {
  const FitResult& fit = job.fits[i];
  if (fit.surface == SurfaceKind::plane || list_set_ups(job.streams[i]).size() > 1) return false;
  double off_mm = 0.0;
  for (const double z : {fit.position_min_mm, fit.position_max_mm}) {
    const auto [x, y] = fit.axis.axis.at(z);
    off_mm = std::max(off_mm, std::hypot(x, y));
  }
  const double length_mm = fit.position_max_mm - fit.position_min_mm;
  return std::abs(fit.shape.tan_half_angle) * length_mm < 2.0 * off_mm;
}

Reasons find_sensor(const CheckInput& in) {
  const double room_mm = *in.job.job.coaxiality_tolerance_mm - in.cut.upper_mm;
  for (std::size_t i = 0; i < in.job.diagnoses.size(); ++i) {
    if (!in.job.diagnoses[i] || !turns_off_centre(in.job, i)) continue;
    for (const Finding& finding : in.job.diagnoses[i]->findings) {
      const double shift_mm = std::abs(finding.axis_shift.value);
      if (is_function_of_reading(*finding.term.effect) && 2.0 * shift_mm > room_mm)
        return {{ReasonCode::sensor_or_eccentricity,
                 {i},
                 {{"shift", shift_mm, "mm"}},
                 {{"effect", finding.effect()}}}};
    }
  }
  return {};
}

}  // namespace

constinit const JobCheck sensor_or_eccentricity{
    "sensor_or_eccentricity", CheckedAt::tolerance, Weight::leaves_open, {}, find_sensor};

}  // namespace trueaxis

// SPDX-License-Identifier: Apache-2.0
#include "job/sensor_doubts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <variant>

#include "job/references.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

bool is_function_of_reading(const Effect& effect) {
  const auto* response = std::get_if<Response>(&effect.term);
  return response &&
         (response->of == Response::Of::nonlinearity || response->of == Response::Of::cyclic);
}

/// Whether the readings of a reference change by its eccentricity more than by anything else.
bool turns_off_centre(const JobResult& result, std::size_t i) {
  const FitResult& fit = result.fits[i];
  if (fit.surface == SurfaceKind::plane || list_set_ups(result.streams[i]).size() > 1) return false;
  double off_mm = 0.0;
  for (const double z : {fit.position_min_mm, fit.position_max_mm}) {
    const auto [x, y] = fit.axis.axis.at(z);
    off_mm = std::max(off_mm, std::hypot(x, y));
  }
  const double length_mm = fit.position_max_mm - fit.position_min_mm;
  return std::abs(fit.shape.tan_half_angle) * length_mm < 2.0 * off_mm;
}

}  // namespace

std::string sensor_or_eccentricity(const JobResult& result, double room_mm) {
  for (std::size_t i = 0; i < result.diagnoses.size(); ++i) {
    if (!result.diagnoses[i] || !turns_off_centre(result, i)) continue;
    for (const Finding& finding : result.diagnoses[i]->findings) {
      if (!is_function_of_reading(*finding.term.effect)) continue;
      const double shift_mm = std::abs(finding.axis_shift.value);
      if (!(2.0 * shift_mm > room_mm)) continue;
      return fmt::format(
          "{}{} moves the axis by {:.2g} µm, and on a part that turns off-centre it looks as lobes "
          "in "
          "phase with the eccentricity do, which move no axis: probe once more with the slide "
          "moved "
          "by some tenths of a millimetre, as a set-up of its own, or calibrate the sensor",
          of_reference(result, i), finding.effect(), shift_mm / mm_per_um);
    }
  }
  return "";
}

}  // namespace trueaxis

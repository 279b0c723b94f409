// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>

#include "trueaxis/calibration.hpp"

namespace trueaxis {

std::string implausible(const Calibration& found, const CalibrationOptions& options) {
  constexpr double far_beyond = 50.0;  // largest plausible sizes: 5 mm, 0.6 degrees
  for (const CalibratedParameter& p : found.parameters) {
    const auto name = parse_error_name(std::string_view(p.name).substr(0, 3));
    const bool angle = name && name->angular();
    const double most =
        far_beyond * (angle ? options.largest_angle_rad : options.largest_length_mm);
    const double least = std::abs(p.estimate.value) - options.coverage_factor * p.estimate.u;
    if (!(least > most)) continue;
    const double to_file = angle ? 1.0 / rad_per_deg : 1.0;
    return fmt::format(
        "{} would be {:.4g} {}: no machine is so far from its model. See whether the machine file, "
        "the tool length, units and senses of the columns are those of the measurement",
        p.name, p.estimate.value * to_file, angle ? "deg" : "mm");
  }
  return "";
}

}  // namespace trueaxis

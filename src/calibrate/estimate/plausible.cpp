// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>

#include "trueaxis/calibration.hpp"

namespace trueaxis {

std::string implausible(const Calibration& found, const CalibrationOptions& options) {
  constexpr double far_beyond = 50.0;  // largest plausible sizes: 5 mm, 0.6 degrees
  for (const CalibratedParameter& p : found.parameters) {
    const bool angle = p.estimate.unit == "rad";
    const double most =
        far_beyond * (angle ? options.largest_angle_rad : options.largest_length_mm);
    const double least = std::abs(p.estimate.value) - options.coverage_factor * p.estimate.u;
    if (!(least > most)) continue;
    return fmt::format(
        "{} is {:.4g} {}: no machine is so far from its model. Check that the machine file, the "
        "tool length, and the units and signs of the columns belong to the measurement",
        p.name, p.estimate.value * edge_factor(p.estimate.unit), angle ? "deg" : "mm");
  }
  return "";
}

}  // namespace trueaxis

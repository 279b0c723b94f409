// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "trueaxis/calibration.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis::cli {

/// @param left_by_all_mm as of `likely_mistake`
/// @throws Refusal where a measurement of a machine is most likely written wrongly
inline void expect_no_mistake(const Machine& machine, std::span<const MachineMeasurement> data,
                              const CalibrationOptions& options, const Calibration& found,
                              double left_by_all_mm) {
  const std::string mistake = likely_mistake(machine, data, options, found, left_by_all_mm);
  const std::string why = found.converged ? implausible(found, options) : "";
  if (!mistake.empty()) throw Refusal(mistake);
  if (!why.empty()) throw Refusal(why);
}

}  // namespace trueaxis::cli

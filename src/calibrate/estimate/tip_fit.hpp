// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>

#include "calibrate/estimate/solve.hpp"

namespace trueaxis::calibrate_detail {

/// Files of kinds ball, bar and array fitted.
struct TipFit {
  Problem problem;
  std::vector<Unknown> unknowns;
  Solution solution;
  ErrorModel given;
};

/// A calibration to begin with: the errors that were given and those of the read-outs.
Calibration of_read_outs(const Machine& machine, std::span<const MachineMeasurement> data,
                         const CalibrationOptions& options);

/// Adds the fit to `out`; nothing where there is no such file. `array_errors`: position and
/// straightness of the axes of arrays are unknown too.
std::optional<TipFit> fit_tips(const Machine& machine, std::span<const MachineMeasurement> data,
                               const CalibrationOptions& options, bool array_errors,
                               Calibration& out);

}  // namespace trueaxis::calibrate_detail

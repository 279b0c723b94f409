// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "job/check.hpp"

namespace trueaxis {

/// Of the first reference where a function of the sensor's reading was found on a part whose
/// readings change by its eccentricity alone: it is then lobes in phase with the eccentricity, and
/// a part of the eccentricity itself. Were it the part's, the axis is elsewhere by more than the
/// room that the tolerance leaves.
extern const JobCheck sensor_or_eccentricity;

}  // namespace trueaxis

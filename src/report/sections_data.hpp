// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "format/json.hpp"
#include "report/chart_readings.hpp"

namespace trueaxis {

/// Up to three polar sections (both ends and the middle): the readings of about one revolution
/// nearest to each height, means per degree where there are more than 360, and the model's curve
/// there.
Json sections_data(const ChartReadings& all, const CoaxialNominal& nominal);

}  // namespace trueaxis

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "trueaxis/diagnosis.hpp"

namespace trueaxis {

/// Blocks of diagnosis_text: what the data do not show, their noise, what was seen of their
/// quality, what to measure next. Each starts with an empty line; empty where there is nothing.
std::string not_observable_text(const Diagnosis& diagnosis);
std::string noise_text(const NoiseReport& noise);
std::string remarks_text(const std::vector<std::string>& remarks);
std::string checks_text(const std::vector<QualityCheck>& checks);
std::string next_text(const NextMeasurement& next);

}  // namespace trueaxis

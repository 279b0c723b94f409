// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "trueaxis/diagnosis.hpp"

namespace trueaxis {

/// The verdict in one line: "EFFECTS: 2 causes found; held-out RMS 99.2 → 38.1 µm (ratio 0.38 …".
std::string diagnosis_line(const Diagnosis& diagnosis);

/// The diagnosis for a person at a terminal, 100 columns wide: verdict, findings by axis_bias, what
/// is unexplained, what cannot be seen, noise, checks, next measurement. Small lengths in µm.
std::string diagnosis_text(const Diagnosis& diagnosis);

/// The findings alone, a line or two each, for a result that has much else to say.
std::string findings_text(const Diagnosis& diagnosis);

/// The next measurement and the table of all plans.
std::string advice_text(const Diagnosis& diagnosis);

}  // namespace trueaxis

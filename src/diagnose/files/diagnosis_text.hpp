// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "trueaxis/diagnosis.hpp"
#include "trueaxis/effect.hpp"

namespace trueaxis {

/// The verdict in one line: "EFFECTS: 2 causes found; cross-validated RMS 99.2 → 38.1 µm (ratio
/// 0.38 …".
std::string diagnosis_line(const Diagnosis& diagnosis);

/// The diagnosis for a person at a terminal, 100 columns wide: verdict, causes by axis_bias, what
/// is unexplained, what cannot be seen, noise, checks, next measurement. Small lengths in µm.
std::string diagnosis_text(const Diagnosis& diagnosis);

/// The causes alone, a line or two each, for a result that has much else to say.
std::string findings_text(const Diagnosis& diagnosis);

/// The next measurement and the table of all plans.
std::string advice_text(const Diagnosis& diagnosis);

/// Blocks of diagnosis_text: what the data do not show, their noise, what was seen of their
/// quality, what to measure next. Each starts with an empty line; empty where there is nothing.
std::string not_observable_text(const Diagnosis& diagnosis);
std::string noise_text(const NoiseReport& noise);
std::string remarks_text(const std::vector<std::string>& remarks);
std::string checks_text(const std::vector<QualityCheck>& checks);
std::string next_text(const NextMeasurement& next);

/// "3 UPR", "7.41 UPR", "local form"
std::string harmonic_text(const Pattern& pattern);

/// "constant along Z", "P2 in time", "turning along Z, 0.14 per mm", "at 70.0° (± 12.5°)" …
std::string dependence_text(const Pattern& pattern);

/// "order 3, amplitude 4.2 ± 0.3 µm, phase 12.4 ± 1.2 deg"
std::string finding_parameters(const Finding& finding, double coverage_factor);

/// "part.roundness or spindle.radial_synchronous (0.50, 0.50): the data cannot tell"
std::string finding_class(const Finding& finding);

/// "moves the axis by 1.2 ± 0.3 µm", and whether it is cosmetic
std::string finding_axis_bias(const Finding& finding, double coverage_factor, bool face = false);

/// "RC, re-index by 70 deg: power 0.50 → 0.99, 12 min"
std::string separating_text(const Separating& separating);

/// axis bias per unit in µm
std::string axis_bias_per_unit_text(const Estimate& axis_bias);

}  // namespace trueaxis

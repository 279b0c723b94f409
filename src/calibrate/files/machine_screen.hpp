// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "trueaxis/machine_diagnosis.hpp"

/// What fits a screen of a machine's calibration and diagnosis: verdict, reason, what to do next.
/// Lines are not broken (the command does), their text begins in column 8; µm and µrad. The texts
/// of `--verbose` have the rest.
namespace trueaxis {

/// mm or rad, as sizes of a machine's errors are shown.
std::string small_size(double size, const std::string& unit);
/// A cause with its size, and what it is in the readings where that is a length.
std::string size_in_readings(const MachineFinding& finding);

std::string calibration_screen(const Calibration& calibration);

/// Without the next measurement, which may depend on what is weighed on a program.
/// Its first line; `arrow` comes between before and after.
std::string machine_diagnosis_line(const MachineDiagnosis& diagnosis, const char* arrow);
std::string machine_diagnosis_screen(const MachineDiagnosis& diagnosis);

/// The causes and what these positions do not show, a few lines.
std::string machine_findings_screen(const MachineDiagnosis& diagnosis);

/// "next   …": the measurement that shows and separates most.
/// The measurement that tells most, by the code of its plan or by what is done.
enum class PlanBy { code, deed };
std::string next_plan_text(const MachineDiagnosis& diagnosis, PlanBy by);
std::string next_screen(const MachineDiagnosis& diagnosis);

std::string machine_advice_screen(const MachineDiagnosis& diagnosis);

}  // namespace trueaxis

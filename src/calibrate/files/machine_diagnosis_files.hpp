// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "format/json.hpp"
#include "trueaxis/machine_diagnosis.hpp"

namespace trueaxis {

/// Schema trueaxis.machine_diagnosis/2, keys as those of trueaxis.diagnosis: lengths in mm, angles
/// in degrees, each with its unit; a number that is not there is null next to the reason.
Json machine_diagnosis_object(const MachineDiagnosis& diagnosis, const Machine& machine);
std::string machine_diagnosis_json(const MachineDiagnosis& diagnosis, const Machine& machine);

/// For a terminal: µm and µrad.
std::string machine_diagnosis_text(const MachineDiagnosis& diagnosis);

/// The positions of the next measurement with the columns of a measurement, those that are read
/// left empty: filled in it is one. Nothing where there is no next measurement.
std::string measurement_plan_csv(const MachineDiagnosis& diagnosis, const Machine& machine);

/// The next measurement with its positions' count, and what every plan shows and tells apart.
std::string machine_advice_text(const MachineDiagnosis& diagnosis);

}  // namespace trueaxis

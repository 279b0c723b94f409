// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "format/json.hpp"
#include "trueaxis/virtual_lathe.hpp"

namespace trueaxis {

/// The number of a {"value", "unit"} object inside: mm, rad, s. @throws Json::exception where there
/// is none.
double inside_value(const Json& quantity);

/// An amplitude and phase, a cos(angle − phase) = c cos(angle) + s sin(angle).
struct Wave {
  double amplitude = 0.0, phase_rad = 0.0;
  static Wave of(double c, double s);
};

/// Where u = (position − z_mid)/z_half of a diagnosis comes from, and its clock.
struct DiagnosisFrame {
  double z_mid_mm = 0.0, z_half_mm = 1.0;
  double time_start_s = 0.0, time_end_s = 0.0;
};

/// A finding of trueaxis.diagnosis/1 as the virtual lathe has it: its term's linear parameters and
/// shape as effects, two where the lathe has one phase and the term two.
/// @throws InputError for an id that the lathe has not, Json::exception for a malformed term.
std::vector<virtual_lathe::Effect> effects_of_finding(const Json& finding,
                                                      const DiagnosisFrame& frame);

/// A pattern that no cause explained, as an effect extra.*.
virtual_lathe::Effect effect_of_unexplained(const Json& unexplained, const DiagnosisFrame& frame);

}  // namespace trueaxis

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "trueaxis/job.hpp"
#include "trueaxis/units.hpp"

/// Job results for the tests of the report, made by formulas of this file and not by the engine:
/// the fit is the truth, the residuals are the noise that was added.
namespace trueaxis::example {

inline constexpr double noise_mm = 0.002;
inline constexpr unsigned seed = 20240611;

/// 0.11 mm off at z = 0 towards 37°, tilted by 1 mrad towards 110°.
Axis true_axis();

Revolved true_cone();

/// X of the contact: Constantin et al. Eq. 11 with the tilt's effect on the height to first order
/// in the slopes.
double contact_mm(const Revolved& cone, double c_rad, double z_mm);

/// An angle is given in degrees.
FitParameter parameter(std::string name, double value, double u, std::string unit);

ProbeStream helix(std::size_t readings, double length_mm);

/// Fills the readings of `stream` and the parts of `fit` that every fit has.
void read_surface(ProbeStream& stream, FitResult& fit, const Revolved& surface);

FitResult cone_fit(ProbeStream& stream);

/// 150 revolutions × 360 rows of a cylinder R = 30 mm about the axis, the command ahead by the lag.
Correction cylinder_correction(const AxisEstimate& axis);

JobResult cone_job(std::size_t readings = 1500);

JobResult rank_deficient_job();

/// One section at z = 12 mm, without Z: 5 turns.
JobResult section_job();

void add_face(JobResult& result);

/// A shaft read by a gauge, a face next to it, and an actuator that cannot follow.
JobResult shaft_and_face_job();

}  // namespace trueaxis::example

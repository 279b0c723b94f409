// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <limits>
#include <utility>

#include "support/report_example.hpp"
#include "trueaxis/diagnosis.hpp"

/// A diagnosis for the tests of what shows it, made by formulas of this file and not by the engine:
/// three lobes and a wandering pattern are added to the noise of report_example.hpp.
namespace trueaxis::example {

inline constexpr double lobes_mm = 0.006, lobes_phase_deg = 40.0, wander_mm = 0.0012;

TermValue fitted(const char* effect, const TermShape& shape, std::vector<double> linear);

Finding lobes();

Finding tilt_motion();

Unexplained wander();

NoiseReport noise_report();

/// The diagnosis of a stream that was fitted with nothing but noise: the readings get the effects.
Diagnosis diagnosed(ProbeStream& stream, FitResult& fit);

/// The cone of cone_job() with a diagnosis that found something.
JobResult diagnosed_job(std::size_t readings = 1500);

/// The same, simulated again: the ideal simulation misses lobes and wander, the extended one the
/// noise alone.
JobResult resimulated_job(std::size_t readings = 1500);

Diagnosis cone_diagnosis(std::size_t readings = 1500);

}  // namespace trueaxis::example

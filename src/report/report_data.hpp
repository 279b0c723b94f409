// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "trueaxis/job.hpp"

namespace trueaxis {

/// Everything the page shows (schema trueaxis.report/1). The unit of a number is in its key; a
/// number that is not determined is NaN, which JSON writes as null.
nlohmann::json report_data(const JobResult& result);

/// The name of the job, or its file when it has none.
std::string job_title(const Job& job);

/// What went in: streams with hash, options of fit, tool and actuator, as label and text.
nlohmann::json inputs_data(const JobResult& result);

/// One fitted reference: status, parameters, budget, rejected readings.
nlohmann::json fit_data(const FitResult& fit);

/// The charts of one reference: maps, sections, residuals, histogram; thinned above
/// `max_points` readings.
nlohmann::json readings_data(const ProbeStream& stream, const FitResult& fit);

/// What the model gets wrong: findings, gain, simulation.
nlohmann::json diagnosis_data(const ProbeStream& stream, const Diagnosis& diagnosis,
                              const Resimulation* again);

/// Measured against simulated, before and after: discrepancy, spectrum, maps; null where the model
/// was not evaluated at every reading.
/// @param again by the virtual lathe; none: the model stands for it
nlohmann::json simulation_data(const ProbeStream& stream, const Diagnosis& diagnosis,
                               const Resimulation* again);

/// Coaxiality of each reference before and after, the axes over the length to be cut.
nlohmann::json target_data(const JobResult& result);

nlohmann::json correction_data(const Correction& correction);

/// More readings than this are shown as means of cells and envelopes of bins.
inline constexpr std::size_t max_points = 20000;
/// Rejected readings that are listed one by one; the rest is counted.
inline constexpr std::size_t max_rejected_listed = 200;

/// `value` to `decimals` places: keeps the page small and its bytes free of the last bits.
double rounded(double value, int decimals);

}  // namespace trueaxis

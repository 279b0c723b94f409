// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>

#include "format/json.hpp"
#include "trueaxis/diagnosis.hpp"
#include "trueaxis/fit.hpp"
#include "trueaxis/job.hpp"
#include "trueaxis/part_form.hpp"
#include "trueaxis/probe_stream.hpp"

namespace trueaxis {

/// The report of a job, which is in `file`: one HTML page that opens offline (Apache ECharts
/// embedded).
std::string render_report(const JobResult& result, const std::string& file = "");

/// Everything the page shows (schema trueaxis.report/2): fits and diagnoses as the files have them,
/// and what the charts draw. There the unit of a number is in its key; a number that is not
/// determined is NaN, which JSON writes as null.
Json report_data(const JobResult& result, const std::string& file = "");

/// A fit as in its file, with `rejected` as a count and the first rows.
Json fit_data(const FitResult& fit);

/// Rejected readings that are listed one by one; the rest is counted.
inline constexpr std::size_t max_rejected_listed = 200;

/// The page of one fitted stream: that of a job without a target.
std::string render_fit_report(const ProbeStream& stream, const FitResult& fit,
                              const FitOptions& options);

/// The same of a diagnosed one; the part is measured again by the virtual lathe, as in a run.
std::string render_diagnosis_report(const ProbeStream& stream, const Diagnosis& diagnosis,
                                    const FitOptions& options, const PartForm& form);

}  // namespace trueaxis

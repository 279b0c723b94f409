// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "trueaxis/diagnosis.hpp"
#include "trueaxis/fit.hpp"
#include "trueaxis/part_form.hpp"
#include "trueaxis/probe_stream.hpp"

namespace trueaxis {

/// The page of one fitted stream: that of a job without a target.
std::string render_fit_report(const ProbeStream& stream, const FitResult& fit,
                              const FitOptions& options);

/// The same of a diagnosed one; the part is measured again by the virtual lathe, as in a run.
std::string render_diagnosis_report(const ProbeStream& stream, const Diagnosis& diagnosis,
                                    const FitOptions& options, const PartForm& form);

}  // namespace trueaxis

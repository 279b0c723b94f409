// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "format/json.hpp"
#include "trueaxis/job.hpp"

namespace trueaxis {

/// The charts of one reference: maps, sections, residuals, histogram; thinned above
/// `max_points` readings.
Json readings_data(const ProbeStream& stream, const FitResult& fit);

/// Measured against simulated, before and after: discrepancy, spectrum, maps; null where the model
/// was not evaluated at every reading.
/// @param again by the virtual lathe; none: the model stands for it
Json simulation_data(const ProbeStream& stream, const Diagnosis& diagnosis,
                     const Resimulation* again);

/// What went in: streams with hash, options of fit, tool and actuator, as label and text.
Json inputs_data(const JobResult& result);

/// Coaxiality of each reference before and after, the axes over the length to be cut.
Json target_data(const JobResult& result);

/// The table as revolutions and a map, harmonics, the actuator's margin.
Json correction_data(const Correction& correction);

}  // namespace trueaxis

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "format/json.hpp"
#include "trueaxis/job.hpp"

namespace trueaxis {

/// The charts of one reference: maps, sections, residuals, histogram; thinned above
/// `max_points` readings.
/// @param diagnosis of them; none: nullptr. What was found is drawn in the sections then.
Json readings_data(const ProbeStream& stream, const FitResult& fit,
                   const Diagnosis* diagnosis = nullptr);

/// A section's trace about its least-squares circle: peak, valley, RMS, harmonics from order 2 on;
/// null where there is no usable fit.
Json roundness_data(const ProbeStream& stream, const FitResult& fit);

/// Form of the part: tolerances, values with and without what is not of it, the worst section with
/// its circles and harmonics, a row a section.
Json part_form_data(const PartForm& form);

/// Measured against simulated, before and after: discrepancy, spectrum, maps; null where the model
/// was not evaluated at every reading.
/// @param again by the virtual lathe; none: the model stands for it
Json simulation_data(const ProbeStream& stream, const Diagnosis& diagnosis,
                     const Resimulation* again);

/// The inputs: streams with hash, options of fit, tool and actuator, as label and text.
Json inputs_data(const JobResult& result);

/// Coaxiality of each reference before and after, the axes over the length to be cut.
Json target_data(const JobResult& result);

/// The seats along Z and what is cut: z_mm and radius_mm of both ends (a face: X at one Z).
Json seats_data(const JobResult& result);

/// Standard uncertainty of an axis point at Z, as an ellipse: u along both of its axes, and where
/// the longer one points.
Json ellipse_data(const AxisEstimate& estimate, double z_mm);

/// result.json as the page lists it: without the reasons as data, which it has in words.
Json job_tables(const JobResult& result);

/// What is to be minded: {text, of}, `of` the references; reservations first.
Json warnings_data(const JobResult& result);

/// What to do next, sentences.
Json next_data(const JobResult& result);

/// The table as revolutions and a map, harmonics, the actuator's margin.
Json correction_data(const Correction& correction);

/// What a page's banner is coloured by.
/// @param judged that something was, so that a decision without an objection is a go
const char* outcome_of(Decision decision, bool judged);

}  // namespace trueaxis

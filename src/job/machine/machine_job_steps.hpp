// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "job/machine/part_displacement.hpp"
#include "job/machine/tip_uncertainty.hpp"
#include "trueaxis/machine_job.hpp"

namespace trueaxis::machine_job {

/// For every axis of the machine, where the data and the cutting moves of the program have it.
std::vector<AxisRange> axis_ranges(const MachineJob& job, const std::vector<ProgramEnd>& ends);

/// Whether the program has an axis beyond where it was measured: by more than a tenth of what was
/// measured. A rotary axis that was measured over 300° is known all round.
bool beyond_measured(const AxisRange& range);

/// The errors of a job's machine with what is uncertain of them. If all that the diagnosis found
/// are errors of the machine, they count as known in a calibration of the measurement, but for
/// those whose form is not sure. Every other component error then counts with its plausible size;
/// their own covariance is added. With a slip, a drift or a reversal, which a calibration does not
/// have, the errors are those of the diagnosis, with the covariance of such a calibration.
ErrorModel job_errors(const MachineJob& job, const MachineDiagnosis& diagnosis);

/// The same for the job's own program: how far balls and bars went is weighed by the verdict
/// (machine-job.md). Beyond that an error that was found is NOT PROVEN, any other a reservation;
/// ranges of given errors, read-outs and arrays stay.
ErrorModel to_be_weighed(const MachineJob& job, ErrorModel errors);

/// The largest distance of the tip between the ends of cutting blocks from the straight lines that
/// the program has there. It is for the program as it was read, without the displacement of the
/// part as a whole. @param ends of every move of the program, in its order
LargestInProgram off_between_before(const MachineModel& model, const std::vector<ProgramEnd>& ends,
                                    const RigidFit::Body& part);

inline constexpr std::size_t map_cells = 24;  ///< along each side

/// Two planes of linear axes (X-Y, X-Z) and the rotary axes against each other, over what was
/// measured and what the program uses together; the other axes where the program has its middle, or
/// the measurement. @param part the program's, subtracted from the errors before
std::vector<ErrorMap> error_maps(const MachineModel& model, const std::vector<AxisRange>& ranges,
                                 const Setting& setting, const ProbedTipUncertainty& uncertainty,
                                 const RigidFit::Body& part);

/// The positions of all maps, if there is no program to take the part's displacement from.
std::vector<Stand> map_stands(const std::vector<AxisRange>& ranges, const Machine& machine,
                              const Setting& setting);

/// The decision by ISO 14253-1 at a risk of 5 %. `numbers` has what the decision rests on: before,
/// after, between, U, not_corrected. The tip is off by at most the residual and what is not
/// corrected, plus U. The |δ|² of a normal δ with the covariance's trace u² exceeds (2u)² with at
/// most 5 %, which is the case of one direction (Eq. 222).
MachineJobVerdict decide(const MachineJobResult& result, MachineJobVerdict numbers);

}  // namespace trueaxis::machine_job

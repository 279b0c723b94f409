// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "job/machine/tip_uncertainty.hpp"

namespace trueaxis::machine_job {

inline constexpr std::size_t map_cells = 24;  ///< along each side

/// Two planes of linear axes (X-Y, X-Z) and the rotary axes against each other, over what was
/// measured and what the program uses together; the other axes where the program has its middle, or
/// the measurement. @param part the program's, taken off the errors before
std::vector<ErrorMap> error_maps(const MachineModel& model, const std::vector<AxisRange>& ranges,
                                 const Setting& setting, const ProbedTipUncertainty& uncertainty,
                                 const RigidFit::Body& part);

/// The stands of all maps, where there is no program to take the part's displacement from.
std::vector<Stand> map_stands(const std::vector<AxisRange>& ranges, const Machine& machine,
                              const Setting& setting);

}  // namespace trueaxis::machine_job

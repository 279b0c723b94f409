// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "form/section_model.hpp"

namespace trueaxis::form {

/// Lobes that the sections show together, constant along Z or growing. A makeshift cut-off (below
/// the 15 UPR where those of ISO 12181-2 begin) takes more than 5 % of them. Eq. 309.
std::vector<SwallowedLobes> swallowed_lobes(const std::vector<SectionModel>& sections,
                                            const FormOptions& options);

/// Whether a cut-off that lets so much of an order through is one that a found order speaks
/// against.
bool is_swallowed(const FormOptions& options, double passed);

/// Takes the values out that rest on what was swallowed, and leaves their bounds.
void withhold_swallowed(FormResult& result);
/// The same of what else is not in the surface: each is off by `lost_mm` at most.
void bound_values(FormResult& result, double lost_mm, const std::string& why);

}  // namespace trueaxis::form

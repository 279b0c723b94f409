// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "trueaxis/diagnosis.hpp"
#include "trueaxis/effect.hpp"

namespace trueaxis {

/// A title up to what explains it: "roundness of the part".
std::string short_title(const Effect& effect);

/// What a cause looks like in the readings, its size with U and no name: "3 undulations per
/// revolution, 4.11 ± 0.16 µm, the same along Z".
std::string seen_text(const Finding& finding, double coverage_factor);

/// The same of a pattern of no cause.
std::string seen_text(const Unexplained& pattern, double coverage_factor);

/// The causes of a class with their probability and what follows, the likeliest first: one line
/// each, "roundness of the part (44 %): nothing to do for the axis [part.roundness]"; at most
/// `most`, then how many more.
std::vector<std::string> cause_lines(const Diagnosis& diagnosis, const Finding& finding,
                                     std::size_t most);

}  // namespace trueaxis

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "trueaxis/diagnosis.hpp"

namespace trueaxis {

/// Under `heading` the final axis with those of the named model and of the ideal fit, and what
/// moved it from there or widened its U; empty if nothing was fitted, and for a face.
std::string axes_text(const Diagnosis& diagnosis, const std::string& heading);

/// "part.roundness instead of probe.height (probability 0.31) would move it by 4.2 ± 0.8 µm".
std::string share_text(const AxisShare& share, double k);

/// Those of the shares that are worth a line, the widest first: each moves the average by a tenth
/// of its u or more, or makes up a tenth of u².
std::vector<AxisShare> telling_shares(const Diagnosis& diagnosis);

}  // namespace trueaxis

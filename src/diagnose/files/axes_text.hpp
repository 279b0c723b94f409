// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "trueaxis/diagnosis.hpp"

namespace trueaxis {

/// The axis that is stated beside those of the named model and of the ideal fit, and what moved it
/// from there; empty where nothing was fitted.
std::string axes_text(const Diagnosis& diagnosis);

/// "part.roundness instead of probe.height (probability 0.31) would move it by 4.2 ± 0.8 µm".
std::string share_text(const AxisShare& share, double k);

/// Those of the shares that are worth a line: they move the average by a tenth of its u or more.
std::vector<AxisShare> telling_shares(const Diagnosis& diagnosis);

}  // namespace trueaxis

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "diagnose/regression/joint.hpp"
#include "diagnose/search/search.hpp"
#include "trueaxis/diagnosis.hpp"

namespace trueaxis::diagnose_detail {

/// The checks of the catalogue.
std::vector<QualityCheck> check_quality(const ProbeStream& stream, const Joint& joint,
                                        const std::vector<double>& residual_mm,
                                        const NoiseReport& noise);

/// That the second harmonic of X is that of an off-centre circle, e²/(4R), and how much ovality is
/// left beside it; nothing where the one is below the other's uncertainty, or an effect of two
/// undulations is in the model.
std::vector<std::string> off_centre_remark(const Problem& problem, const Model& model);

}  // namespace trueaxis::diagnose_detail

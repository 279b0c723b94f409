// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "diagnose/regression/joint.hpp"
#include "diagnose/search/ideal_model.hpp"
#include "diagnose/search/search.hpp"
#include "trueaxis/diagnosis.hpp"

namespace trueaxis::diagnose_detail {
/// σ of a reading from each source that the data have, the best one chosen; gaps and interruptions.
/// Eq. 67.
/// @param residual_mm readings minus surface and causes
NoiseReport report_noise(const ProbeStream& stream, const Joint& joint,
                         const std::vector<double>& residual_mm, std::vector<Rejected> masked,
                         const std::optional<double>& stated_mm);

/// The checks of the catalogue.
std::vector<QualityCheck> check_quality(const IdealModel& ideal, const Joint& joint,
                                        const std::vector<double>& residual_mm,
                                        const NoiseReport& noise);

/// That the second harmonic of X is that of an off-centre circle, e²/(4R), and how much ovality is
/// left after it; nothing if the one is below the other's uncertainty, or an effect of two
/// undulations is in the model (Eq. 12).
std::vector<std::string> off_centre_remark(const Problem& problem, const Model& model);

}  // namespace trueaxis::diagnose_detail

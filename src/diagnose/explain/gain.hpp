// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "diagnose/explain/averaged_axis.hpp"
#include "diagnose/regression/joint.hpp"
#include "diagnose/search/dictionary.hpp"
#include "trueaxis/diagnosis.hpp"

namespace trueaxis::diagnose_detail {
/// Before and after: the surface alone and with all terms, cross-validated block by block (Eqs.
/// 101, 102). @param average the axis that is stated
Gain measure_gain(const Problem& problem, const Joint& joint, const AveragedAxis& average,
                  double noise_floor_mm);

/// Amplitude of both residuals over the order, in steps of a resolution cell and at most 400 bins.
std::vector<SpectrumBin> spectrum_of(const LinearisationPoint& point, const Resolution& resolution,
                                     const std::vector<double>& before_mm,
                                     const std::vector<double>& after_mm);

}  // namespace trueaxis::diagnose_detail

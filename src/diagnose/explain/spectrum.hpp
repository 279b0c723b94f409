// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "diagnose/search/fourier_legendre_basis.hpp"
#include "trueaxis/diagnosis.hpp"

namespace trueaxis::diagnose_detail {

/// Amplitude of both residuals over the order, in steps of a resolution cell and at most 400 bins.
std::vector<SpectrumBin> spectrum_of(const LinearisationPoint& point, const Resolution& resolution,
                                     const std::vector<double>& before_mm,
                                     const std::vector<double>& after_mm);

}  // namespace trueaxis::diagnose_detail

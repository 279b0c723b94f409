// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>

#include "measure/column_checks.hpp"
#include "trueaxis/fit.hpp"

namespace trueaxis {

/// Fits another reading of the same stream, or another surface, by the same options.
using Refit = std::function<FitResult(const ProbeStream&, SurfaceKind)>;

/// Why a fit cannot be that of a probed part, with the likely mistake; empty: nothing speaks
/// against it. In this order: a probe that does not move, columns or units that fit far better when
/// read otherwise, residuals beyond what parts and probes show (theory.md, Eqs. 306 to 308).
std::string implausible(const ProbeStream& stream, const FitResult& fit, const Refit& refit);

/// Columns exchanged, or C in another unit, where that leaves less than a third of the residuals;
/// empty: no such reading of the stream does.
std::string likely_misreading(const ProbeStream& stream, const FitResult& fit, const Refit& refit);

/// RMS of what a fit leaves; if there is no surface at all, of the readings about their mean.
double left_mm(const ProbeStream& stream, const FitResult& fit);

/// "C from 0° to 14508°, 40.3 revolutions, 1.01 per mm"
std::string turns_text(const ProbeStream& stream);

/// Takes every number of the part out of a result: status implausible, with the reason.
void refuse(FitResult& fit, const std::string& why);

/// Withholds them of a plain fit if readings beyond `suspect_sds` draw the axis by more than its U:
/// by 2/N of the sum of their residuals as vectors at C, which is the column of the axis there.
void withhold_if_drawn(const ProbeStream& stream, FitResult& fit);

/// Robust σ: a Gaussian reading lies beyond with a probability of 2e-9.
inline constexpr double suspect_sds = 6.0;

}  // namespace trueaxis

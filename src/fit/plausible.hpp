// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>

#include "trueaxis/fit.hpp"

namespace trueaxis {

/// Fits another reading of the same stream, or another surface, by the same options.
using Refit = std::function<FitResult(const ProbeStream&, SurfaceKind)>;

/// Why a fit cannot be that of a probed part, with the likely mistake; empty: nothing speaks
/// against it. In this order: a probe that does not move, columns or units that fit far better when
/// read otherwise, residuals beyond what parts and probes show (docs/theory.md, Eqs. 306 to 308).
std::string implausible(const ProbeStream& stream, const FitResult& fit, const Refit& refit);

/// A run of readings in which X_M stays the same while C turns by 60° and more, longer than chance
/// makes once in 1000 streams whose neighbours repeat as often as these; empty: there is none.
/// A limit of the sensor that is met again and again is saturation, which the diagnosis handles.
std::string stuck_probe(const ProbeStream& stream);

/// Rows that repeat the row before, or a probe that is read more slowly than C; empty: neither.
std::string repeated_rows(const ProbeStream& stream);

/// X_M that grows by the same amount from row to row; empty: it does not.
std::string counts_rows(const ProbeStream& stream);

/// A column that is larger than any lathe; empty: none is.
std::string no_such_size(const ProbeStream& stream);

/// Two values and more of a column that are a power of ten off both neighbours; empty: none are.
std::string lost_decimal_point(const ProbeStream& stream);

/// Residuals that alternate from row to row, by more than all else that is left; empty: none do.
std::string alternate_rows(const ProbeStream& stream, const FitResult& fit);

/// Columns exchanged, or C in another unit, where that leaves less than a third of the residuals;
/// empty: no such reading of the stream does.
std::string likely_misreading(const ProbeStream& stream, const FitResult& fit, const Refit& refit);

/// What of the columns alone speaks against a stream that was read from a file; empty: nothing
/// does.
std::string column_objection(const ProbeStream& stream);

/// "C from 0° to 14508°, 40.3 revolutions, 1.01 per mm"
std::string turns_text(const ProbeStream& stream);

/// Takes every number of the part out of a result: status implausible, with the reason.
void refuse(FitResult& fit, const std::string& why);

}  // namespace trueaxis

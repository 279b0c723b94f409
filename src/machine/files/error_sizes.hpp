// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "machine/limits.hpp"
#include "trueaxis/machine.hpp"

namespace trueaxis {

/// The size, mm or rad, beyond which an error is rather one in another unit than one of a machine:
/// component errors 1 mm and 2 mrad, location errors 5 mm and 10 mrad, ten and fifty times what is
/// plausible; those of a workpiece 10 mm and 5 degrees.
double largest_size(const ErrorName& name);

/// How large a function becomes: a polynomial over `range`, a table at its points, a Fourier sum by
/// the sum of its amplitudes.
double size_of(const ErrorFunction& function, const PositionRange& range);

/// Where a polynomial is looked at: over ± its scale about its origin, over which files that
/// TrueAxis writes have it; without a scale (1) over the limits of its axis, 500 mm or half a turn
/// where it has none.
PositionRange range_of(const ErrorFunction& function, const ErrorName& name,
                       const Machine& machine);

/// Why `size` is not a size of this error, and what to do; "": it may be.
std::string size_trouble(const ErrorName& name, double size);

/// Whether some error, its u or its variance is larger than that.
bool has_large_errors(const ErrorModel& errors, const Machine& machine);

}  // namespace trueaxis

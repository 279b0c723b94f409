// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trueaxis/fit.hpp"

namespace trueaxis::cli {

/// A fit without an axis where the stream alone speaks against it: the part moved within a pass, or
/// the sensor was at the end of its range. Angles so few that lobes may count are a note.
FitResult checked_fit(const ProbeStream& stream, const FitOptions& options);

}  // namespace trueaxis::cli

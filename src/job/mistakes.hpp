// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "job/axis_likelihood.hpp"
#include "job/check.hpp"
#include "trueaxis/probe_stream.hpp"
#include "trueaxis/reason.hpp"

namespace trueaxis {

/// A way in which a stream is read wrongly: what its columns have to be multiplied by, or turned
/// by, to be right.
struct Mistake {
  ReasonCode what, mend;
  std::vector<ReasonName> of{};  ///< the column, the unit or the convention that both are about
  double x = 1.0, z = 1.0, c = 1.0;
  double turn_rad = 0.0;
  std::optional<OpenNumber> open{};  ///< a number that only the data can tell
};

/// All that are tried on a disagreement of axes.
std::span<const Mistake> mistakes();

/// The stream as it should have been read.
/// @param number that a mistake leaves open: rad or mm that are added
ProbeStream mended(ProbeStream stream, const Mistake& mistake, double number = 0.0);

/// The same of an axis.
HeldAxis mended(HeldAxis axis, const Mistake& mistake, double number = 0.0);

/// ln of the density of a right axis over that of the axis as it was read, where that is smaller: a
/// mistake that shrinks everything would make all axes agree.
double log_shrinkage(const Mistake& mistake, bool plane);

inline constexpr Threshold exchanged_better{"left", 1.0 / 3.0, "of the RMS as given",
                                            "for one of the two"};
inline constexpr Threshold exchanged_as_good{"left", 1.2, "of the RMS as given", "for both"};

/// That two references have each other's stream: each stream is fitted better, or as well, with the
/// surface of the other.
std::optional<Reason> exchanged_streams(const IdentifiedJob& job);

}  // namespace trueaxis

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "job/check.hpp"

namespace trueaxis {

inline constexpr Threshold exchanged_better{"left", 1.0 / 3.0, "of the RMS as given",
                                            "for one of the two"};
inline constexpr Threshold exchanged_as_good{"left", 1.2, "of the RMS as given", "for both"};

/// That two references have each other's stream: each stream is fitted better, or as well, with the
/// surface of the other.
std::optional<Reason> exchanged_streams(const IdentifiedJob& job);

}  // namespace trueaxis

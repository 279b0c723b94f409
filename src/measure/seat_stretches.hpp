// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "measure/seat_profile.hpp"
#include "measure/seats.hpp"

namespace trueaxis {

/// Turns [first, last] of a profile along one straight line.
struct Stretch {
  std::size_t first = 0, last = 0;
};

/// A profile as stretches and what parts them: one break between each two of them.
struct Stretches {
  std::vector<Stretch> stretches;
  std::vector<SeatBreak> breaks;
};

/// The break between two stretches; false: none that a seat ends at.
bool find_break(const SeatProfile& profile, const Stretch& before, const Stretch& after,
                SeatBreak& out);

/// The profile as the fewest straight lines that its noise allows. Two of them become one if the
/// break between them is too small for a shoulder, or bends as the lines themselves do.
Stretches straight_stretches(const SeatProfile& profile);

}  // namespace trueaxis

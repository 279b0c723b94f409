// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "diagnose/geometry/linearisation_point.hpp"

namespace trueaxis::diagnose_detail {

/// Of a set-up.
const Clamping& clamping_of(const std::vector<Clamping>& clampings, int number);

/// That of a reading if the part may have slipped (LinearisationFacts::before).
const Clamping& clamping_at(const std::vector<Clamping>& clampings,
                            const std::vector<Clamping>& before, int number, std::size_t reading);

/// Makes readings [begin, end) of a point whose C, Z, time, passes and clampings are there.
void make_part(const LinearisationPoint& point, std::size_t begin, std::size_t end, PointRoom& out);

constexpr Extent nowhere{1e300, -1e300};

inline void widen(Extent& range, const Extent& by) {
  range = {std::min(range.low, by.low), std::max(range.high, by.high)};
}

/// How far the readings go.
struct Reach {
  Extent x = nowhere, s = nowhere, side[2] = {nowhere, nowhere};  ///< of what is sensed

  void add(const PointPart& at);
  void add(const Reach& other);
};

/// Keeps the columns where there are few readings, and looks how far these go.
Reach fill_contacts(LinearisationPoint& point, int threads = 1);

}  // namespace trueaxis::diagnose_detail

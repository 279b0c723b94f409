// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "trueaxis/probe_stream.hpp"
#include "trueaxis/surface.hpp"

namespace trueaxis {

/// A set-up of the stream, its clamping (the set-ups from one move of the part to the next) and the
/// side it was probed from.
struct PlacedSetUp {
  SetUp set_up;
  std::size_t clamping = 0;
  Root root = Root::front;
  double z_shift_mm =
      0.0;  ///< of the part; 0 for a face, whose position is X, and for one clamping

  bool operator==(const PlacedSetUp&) const = default;
};

/// "set-up 2".
std::string set_up_name(const SetUp& set_up);

/// The metadata give the clampings, and the metadata or else the sign of X_M the sides.
/// @throws InputError where X_M changes sign within a set-up, or contradicts a stated side.
std::vector<PlacedSetUp> place_set_ups(const ProbeStream& stream);

/// Lowest and highest position on the part, Z less its shift (X of a face), for every clamping.
std::vector<std::array<double, 2>> probed_ranges(const ProbeStream& stream,
                                                 const std::vector<PlacedSetUp>& set_ups);

}  // namespace trueaxis

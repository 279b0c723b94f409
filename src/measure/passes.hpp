// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "trueaxis/probe_stream.hpp"

namespace trueaxis {

/// A maximal run of one set-up with the same signs of C and Z feed (zero is a sign). If the stream
/// has t, its spindle speed is constant within 1 %.
struct Pass {
  std::size_t begin = 0, end = 0;  ///< readings [begin, end)
  int setup = 0;
  int c_sign = 0, feed_sign = 0;  ///< -1, 0, +1
  double speed_rad_per_s = 0.0;   ///< signed like C; 0 where the stream has no t
  double feed_mm_per_rev =
      0.0;  ///< dZ per revolution, signed like feed_sign; 0 in a dwell or a stationary capture
  double readings_per_revolution = 0.0;  ///< mean; 0 where C stands still
};

/// The passes of a stream, in order; they cover every reading once. A `pass` column is taken at its
/// word. Single steps between runs (positioning moves) belong to the pass that they end.
std::vector<Pass> find_passes(const ProbeStream& stream);

/// Another pass of the set-up that has most of its readings excluded at the place of those that are
/// excluded among [begin, end): the surface is so there, as no slip comes twice. Null: none has, or
/// one has most of them used, as before a slip.
/// @param place_mm, excluded a value a reading; `place_mm` may be empty
template <typename Places, typename Excluded>
const Pass* met_again(std::span<const Pass> passes, const Places& place_mm,
                      const Excluded& excluded, std::size_t begin, std::size_t end) {
  constexpr std::size_t least = 8;
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (std::size_t i = begin; i < end && place_mm.size() > 0; ++i)
    if (excluded[i]) low = std::min(low, place_mm[i]), high = std::max(high, place_mm[i]);
  const auto here = std::ranges::find_if(
      passes, [&](const Pass& pass) { return pass.begin < end && end <= pass.end; });
  if (!(low < high) || here == passes.end()) return nullptr;
  const Pass* found = nullptr;
  for (const Pass& pass : passes) {
    if (pass.begin == here->begin || pass.setup != here->setup) continue;
    std::size_t there = 0, out = 0;
    for (std::size_t i = pass.begin; i < pass.end; ++i) {
      if (place_mm[i] < low || place_mm[i] > high) continue;
      ++there;
      out += excluded[i] ? 1 : 0;
    }
    if (there < least) continue;
    if (2 * out < there) return nullptr;
    found = &pass;
  }
  return found;
}

}  // namespace trueaxis

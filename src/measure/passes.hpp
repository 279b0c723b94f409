// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
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

}  // namespace trueaxis

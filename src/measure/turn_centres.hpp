// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "trueaxis/probe_stream.hpp"

namespace trueaxis {

/// Where the centre of one turn, or of a few if a turn has few readings, lies: the cosine and sine
/// of its values.
struct TurnCentre {
  std::size_t begin = 0, end = 0;  ///< readings [begin, end)
  int run = 0;                     ///< turns of one sense that follow upon each other
  double position_mm = 0.0;        ///< mean of Z (of X of a face)
  double x_mm = 0.0, y_mm = 0.0;
  std::array<double, 3> cofactor{};  ///< variances and covariance of x, y over σ²: xx, yy, xy
};

struct TurnCentres {
  std::vector<TurnCentre> list;
  double sigma_mm = 0.0;  ///< by which the values of a turn scatter about it
  double u_mm = 0.0;      ///< of x and of y of one that follows, root mean square
};

/// Readings lie about an axis that runs along Z within a turn; what a fit leaves of them does not.
enum class CentresOf { readings, residuals };

/// The centres of all turns of `value_mm`, one a reading. Values that are not finite and chips,
/// single values far off, do not count. Lobes move none of them, and count in u. No turn holds
/// readings of two passes.
TurnCentres turn_centres(const ProbeStream& stream, std::span<const double> value_mm,
                         CentresOf of = CentresOf::readings);

/// By how much the centres scatter beyond their u, √(χ²/ν) (Birge 1932); 1 if noise does so once in
/// 1000 streams. Eq. 313. @param lines what a fit took out of the centres: parameters
double centres_spread(const TurnCentres& centres, std::size_t parameters);

}  // namespace trueaxis

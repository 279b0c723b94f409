// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "trueaxis/probe_stream.hpp"

namespace trueaxis {

inline constexpr std::size_t shown_run = 8;    ///< readings that show a pattern
inline constexpr double few_at_a_limit = 5.0;  ///< readings at an extreme that may be a coincidence
inline constexpr double more_at_a_limit = 12.0;  ///< as above, of the readings of any value
inline constexpr double near_steps = 3.0;        ///< steps within which a value is where it belongs

/// Median of the steps from row to row; 0: a column of one row.
double usual_step(const std::vector<double>& column);

/// A run of readings in which X_M stays the same while C turns by 60° and more; empty: there is
/// none. It is longer than noise makes once in 1000 streams whose neighbours repeat as often as
/// these. A limit of the sensor that is met again and again is saturation, which the diagnosis
/// handles.
std::string stuck_probe(const ProbeStream& stream);

/// Readings at the very extremes of a stream that is not empty; a sensor at the end of its range
/// shows more of them than noise puts there.
struct LimitsMet {
  double low_mm = 0.0, high_mm = 0.0;
  std::size_t at_low = 0, at_high = 0;
  bool saturates = false;
};
LimitsMet limits_met(const ProbeStream& stream);

/// Rows that repeat the row before, or a probe that is read more slowly than C; empty: neither.
std::string repeated_rows(const ProbeStream& stream);

/// X_M that grows by the same amount from row to row; empty: it does not.
std::string counts_rows(const ProbeStream& stream);

/// A column that is larger than any lathe; empty: none is.
std::string no_such_size(const ProbeStream& stream);

/// Two values and more of a column that are a power of ten off both neighbours; empty: none are.
std::string lost_decimal_point(const ProbeStream& stream);

/// A column that goes on in another unit from one row on: 25.4 or a power of ten times as large,
/// X_M twice as large or of the other sign, C in radians, all that follows too. Empty: none does.
std::string unit_changes(const ProbeStream& stream);

/// What of the columns alone speaks against a stream that was read from a file; empty: nothing
/// does.
std::string column_objection(const ProbeStream& stream);

/// A column whose rows are no longer those of the others: C or Z jumps at random while the other
/// goes on as a machine moves, or X_M was sorted. Rows that were sorted or shuffled whole keep
/// their numbers together and pass. Empty: nothing of that kind (theory.md, Eq. 316).
std::string column_out_of_order(const ProbeStream& stream);

}  // namespace trueaxis

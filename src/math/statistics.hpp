// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace trueaxis {

/// Consistent estimate of a Gaussian σ from absolute deviations about zero: median(|r|) / Φ⁻¹(3/4).
/// Eq. 28.
double mad_sigma(std::span<const double> residuals);

/// The largest difference of neighbours, if it is beyond `times` the MAD σ of all of them: whatever
/// the noise and however slow, it does not go from one reading to the next at once (Eq. 63a).
struct Jump {
  std::size_t after = 0;  ///< index of the second of the two
  double size = 0.0, usual = 0.0;
};
/// @param values NaN parts neighbours @returns none: nothing jumps, or most
/// neighbours are equal, as when readings are rounded
std::optional<Jump> largest_jump(std::span<const double> values, double times);

/// Correlation of neighbours after clipping at ± `clip`; 0 for fewer than three values or none that
/// vary.
double neighbour_correlation(std::span<const double> residuals, double clip);

/// The upper of the two middle values of a column that is not empty.
double median(std::vector<double> values);

/// What the values of an indication are.
struct DistinctValues {
  std::size_t count = 0;
  /// The smallest difference of two values where 95 % of all are multiples of it off the least, as
  /// of what was rounded; 0: there is none.
  double step = 0.0;
};
DistinctValues distinct_values(std::vector<double> values);

/// Smallest and largest of a column that is not empty.
struct Extent {
  double low, high;
  double length() const { return high - low; }
};
Extent range_of(std::span<const double> values);

/// Student's t over k, both of one probability (JCGM 100, G.3). If σ comes from residuals with
/// `freedom` degrees of freedom, u times this makes U = k u hold what it holds of a normal
/// quantity. From a thousand on it is 1, which is right to 0.2 % for k = 2.
double student_widening(double freedom, double coverage_factor);

/// Chips: which of the residuals, in order of time, lie far off while their neighbours do not. A
/// part that moved takes its neighbours along. Those that are not finite are not far.
std::vector<bool> lone_outliers(std::span<const double> left_mm);

}  // namespace trueaxis

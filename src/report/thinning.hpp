// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <limits>
#include <vector>

#include "format/json.hpp"

namespace trueaxis {

/// More readings than this are shown as means of cells and envelopes of bins.
inline constexpr std::size_t max_points = 20000;

/// What a chart leaves out.
inline constexpr double not_there = std::numeric_limits<double>::quiet_NaN();

/// `value` to `decimals` places: keeps the page small and its bytes free of the last bits.
double rounded(double value, int decimals);

/// An interval cut into equal bins.
struct Bins {
  double low = 0.0, high = 1.0;
  std::size_t count = 1;

  /// The bin of `value`; values outside fall into the first or the last.
  std::size_t of(double value) const;
  double width() const { return (high - low) / static_cast<double>(count); }
  double center(std::size_t bin) const { return low + (static_cast<double>(bin) + 0.5) * width(); }
};

/// `count` bins over the range of the values; a range of 0 is made 1.
Bins bins_over(const std::vector<double>& values, std::size_t count);

/// Means of what falls into the cells of an unrolled surface (x: C, y: Z or X).
class CellMeans {
 public:
  CellMeans(Bins x, Bins y);
  void add(double x, double y, double value);
  /// Row by row from the lowest y; an empty cell is NaN.
  Json to_json(int decimals) const;

 private:
  Bins x_, y_;
  std::vector<double> sum_;
  std::vector<std::size_t> count_;
};

/// Least, greatest and mean value of each bin.
class Envelope {
 public:
  explicit Envelope(Bins x);
  void add(double x, double value);
  /// {"low", "high", "min", "max", "mean"}, one entry a bin; an empty bin is NaN.
  Json to_json(int decimals) const;

 private:
  Bins x_;
  std::vector<double> min_, max_, sum_;
  std::vector<std::size_t> count_;
};

/// Counts of `values` in equal bins over their range: {"center", "count", "width"}; the number of
/// bins is the Freedman-Diaconis one within [8, 80].
Json histogram(std::vector<double> values, int decimals);

/// `values` with each one rounded to `decimals` places.
Json column(const std::vector<double>& values, int decimals);

}  // namespace trueaxis

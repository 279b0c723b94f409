// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <limits>

#include "report/chart_readings.hpp"

namespace trueaxis {

std::size_t Bins::of(double value) const {
  const double place = (value - low) / width();
  if (!(place > 0.0)) return 0;
  return static_cast<std::size_t>(std::min(place, static_cast<double>(count - 1)));
}

Bins bins_over(const std::vector<double>& values, std::size_t count) {
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  return {*low, *high > *low ? *high : *low + 1.0, count};
}

CellMeans::CellMeans(Bins x, Bins y)
    : x_(x), y_(y), sum_(x.count * y.count, 0.0), count_(x.count * y.count, 0) {}

void CellMeans::add(double x, double y, double value) {
  const std::size_t cell = y_.of(y) * x_.count + x_.of(x);
  sum_[cell] += value;
  ++count_[cell];
}

Json CellMeans::to_json(int decimals) const {
  return list_of_first(sum_.size(), [&](std::size_t cell) {
    const double count = static_cast<double>(count_[cell]);
    return count_[cell] == 0 ? not_there : rounded(sum_[cell] / count, decimals);
  });
}

Envelope::Envelope(Bins x)
    : x_(x),
      min_(x.count, std::numeric_limits<double>::infinity()),
      max_(x.count, -std::numeric_limits<double>::infinity()),
      sum_(x.count, 0.0),
      count_(x.count, 0) {}

void Envelope::add(double x, double value) {
  const std::size_t bin = x_.of(x);
  min_[bin] = std::min(min_[bin], value);
  max_[bin] = std::max(max_[bin], value);
  sum_[bin] += value;
  ++count_[bin];
}

Json Envelope::to_json(int decimals) const {
  std::vector<double> low(x_.count, not_there), high = low, mean = low;
  for (std::size_t bin = 0; bin < x_.count; ++bin) {
    if (count_[bin] == 0) continue;
    low[bin] = min_[bin];
    high[bin] = max_[bin];
    mean[bin] = sum_[bin] / static_cast<double>(count_[bin]);
  }
  return {{"low", rounded(x_.low, 6)},
          {"high", rounded(x_.high, 6)},
          {"min", column(low, decimals)},
          {"max", column(high, decimals)},
          {"mean", column(mean, decimals)}};
}

Json histogram(std::vector<double> values, int decimals) {
  if (values.size() < 2) return nullptr;
  std::sort(values.begin(), values.end());
  const double low = values.front(), high = values.back();
  if (!(high > low)) return nullptr;
  const double quartiles = values[values.size() * 3 / 4] - values[values.size() / 4];
  // Freedman & Diaconis 1981: width 2 IQR N^(-1/3).
  const double width = 2.0 * quartiles / std::cbrt(static_cast<double>(values.size()));
  const double wanted = width > 0.0 ? std::ceil((high - low) / width) : 8.0;
  const Bins bins{low, high, static_cast<std::size_t>(std::clamp(wanted, 8.0, 80.0))};
  std::vector<std::size_t> count(bins.count, 0);
  for (const double value : values) ++count[bins.of(value)];
  std::vector<double> center;
  for (std::size_t bin = 0; bin < bins.count; ++bin) center.push_back(bins.center(bin));
  return {{"center", column(center, decimals + 2)},
          {"count", count},
          {"width", rounded(bins.width(), decimals + 2)}};
}

Json column(const std::vector<double>& values, int decimals) {
  return list_of(values, [decimals](double value) { return rounded(value, decimals); });
}

double rounded(double value, int decimals) {
  const double scale = std::pow(10.0, decimals);
  return std::round(value * scale) / scale + 0.0;
}

}  // namespace trueaxis

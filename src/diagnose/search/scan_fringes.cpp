// SPDX-License-Identifier: Apache-2.0
#include "diagnose/search/scan_fringes.hpp"

#include <algorithm>
#include <cmath>

#include "math/fourier_sums.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis::diagnose_detail {
namespace {

constexpr double places_a_swing = 2.5;  // of the swing
/// Half a place off, |F| and |R| of readings that are spread over the swing are up to 6.5 % higher:
/// (sin x/x)⁻² at x = π/2.5/2 is 1.14. For readings at its ends only it is a little more.
constexpr double between_places = 1.25;
constexpr std::size_t worth = 8;  // bins a cell, or they save nothing

}  // namespace

std::vector<FringeCell> fringe_cells(const LineNorms& norms, const LinearisationPoint& point,
                                     const Scan& scan, const std::vector<double>& left, double low,
                                     double df, std::size_t bins) {
  const double wide = 1.0 / (places_a_swing * point.swing_mm);
  if (scan.turns != 0.0 || !(wide > static_cast<double>(worth) * df)) return {};
  const auto each = static_cast<std::size_t>(wide / df);
  const std::size_t cells = (bins + each - 1) / each;
  const double step = df * static_cast<double>(each);
  const double middle = low + 0.5 * step;  // of the first cell
  const Extent range = point.range(scan.x);
  const auto values = [&](std::size_t begin, std::size_t size, std::span<double* const> out) {
    PointRoom room;
    const PointPart at = point.part(begin, begin + size, room);
    std::ranges::copy(at.*scan.x, out[0]);
  };
  const auto sides = [&](std::size_t begin, std::size_t size, std::span<double* const> out) {
    PointRoom room;
    const PointPart at = point.part(begin, begin + size, room);
    for (std::size_t i = 0; i < size; ++i) {
      out[0][i] = at.rear[i] ? 0.0 : left[begin + i];
      out[1][i] = at.rear[i] ? left[begin + i] : 0.0;
    }
  };
  const auto sums = FourierSums(values, point.size(), 0.5 * range.low + 0.5 * range.high,
                                two_pi * middle, two_pi * step, cells)
                        .of(sides, 2);
  const std::vector<double> norm2 = norms.of(scan, middle, step, cells);
  std::vector<FringeCell> out;
  for (std::size_t k = 0; k < cells; ++k) {
    const double amplitude = std::abs(sums[0][k]) + std::abs(sums[1][k]);
    out.push_back({k * each, std::min(each, bins - k * each),
                   between_places * amplitude * amplitude / norm2[k]});
  }
  std::ranges::stable_sort(out, std::greater<>(), &FringeCell::most);
  return out;
}

}  // namespace trueaxis::diagnose_detail

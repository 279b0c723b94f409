// SPDX-License-Identifier: Apache-2.0
#include "diagnose/search/scan_bumps.hpp"

#include <algorithm>
#include <cmath>

#include "diagnose/search/scan.hpp"
#include "math/statistics.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis::diagnose_detail {
namespace {

/// Share of a window that its readings go over: at a standing spindle they see one place, and what
/// is off there is no form.
constexpr double least_seen = 0.25;
constexpr Extent nowhere{1e300, -1e300};

void widen(Extent& extent, double to) {
  extent.low = std::min(extent.low, to), extent.high = std::max(extent.high, to);
}

}  // namespace

std::vector<Hypothesis> scan_bumps(const NormalEquations& equations,
                                   std::span<const double> remainder_mm, double& tests) {
  const LinearisationPoint& point = equations.point();
  const ObservationMask& mask = equations.mask();
  const std::vector<double> g = weighted(equations, {remainder_mm.begin(), remainder_mm.end()});
  std::vector<Hypothesis> best;
  PointRoom room;
  const PointPart all = point.all(room);
  tests = 0.0;
  // Of few readings a form has few; of many the smallest windows would be chances among very many.
  // Three quarters of the least make a form: (1 − 1/n)² is left of n equal ones without one.
  const std::size_t least_readings = std::clamp<std::size_t>(point.size() / 100, 4, 8);
  const double making = 0.75 * static_cast<double>(least_readings);
  const double without_one = (1.0 - 1.0 / making) * (1.0 - 1.0 / making);
  for (const std::size_t sectors : {6U, 12U, 24U, 48U}) {
    for (const std::size_t lengths : {1U, 3U, 6U, 12U, 24U}) {
      if (lengths > 1 && !point.has_position) continue;
      if (mask.folds() < 12 && lengths > 6) continue;
      std::vector<double> sum(sectors * lengths, 0.0);
      std::vector<std::size_t> count(sectors * lengths, 0);
      std::vector<double> largest(sum.size(), 0.0);
      std::vector<Extent> around(sum.size(), nowhere), along(sum.size(), nowhere);
      for (std::size_t i = 0; i < point.size(); ++i) {
        if (!mask.used[i]) continue;
        const double turn = (all.theta[i] / two_pi - std::floor(all.theta[i] / two_pi)) *
                            static_cast<double>(sectors);
        const double u =
            std::clamp(0.5 + 0.5 * (all.s[i] - point.z_mid_mm) / point.z_half_mm, 0.0, 0.999999) *
            static_cast<double>(lengths);
        const auto sector = std::min(sectors - 1, static_cast<std::size_t>(turn));
        const std::size_t at = sector * lengths + static_cast<std::size_t>(u);
        widen(around[at], turn), widen(along[at], u);
        const double value = all.rear[i] ? -g[i] : g[i];
        sum[at] += value;
        ++count[at];
        if (std::abs(value) > std::abs(largest[at])) largest[at] = value;
      }
      double top = 0.0;
      std::size_t where = 0;
      for (std::size_t b = 0; b < sum.size(); ++b) {
        const double seen = std::max(around[b].length(), along[b].length());
        if (count[b] < least_readings || seen < least_seen) continue;
        tests += 1.0;
        const double value = sum[b] * sum[b] / static_cast<double>(count[b]);
        const double rest = sum[b] - largest[b];  // a form is not made by a reading or two
        if (rest * rest / static_cast<double>(count[b] - 1) < without_one * value) continue;
        if (value > top) top = value, where = b;
      }
      if (!(top > 0.0)) continue;
      Hypothesis h;
      const double width = two_pi / static_cast<double>(sectors);
      const double length = 2.0 * point.z_half_mm / static_cast<double>(lengths);
      h.pattern.kind = Pattern::Kind::bump;
      h.pattern.angle_rad = (static_cast<double>(where / lengths) + 0.5) * width;
      h.pattern.width_rad = 0.5 * width;
      h.pattern.position_mm =
          point.z_mid_mm - point.z_half_mm + (static_cast<double>(where % lengths) + 0.5) * length;
      h.pattern.length_mm = lengths > 1 ? 0.5 * length : 0.0;
      best.push_back(h);
    }
  }
  return best;
}

}  // namespace trueaxis::diagnose_detail

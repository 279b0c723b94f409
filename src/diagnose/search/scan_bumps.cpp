// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "diagnose/geometry/contacts.hpp"
#include "diagnose/search/propose.hpp"
#include "diagnose/search/scan.hpp"
#include "math/statistics.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis::diagnose_detail {
namespace {

/// Share of a window that its readings go over: at a standing spindle they see one place, and what
/// is off there is no form.
constexpr double least_seen = 0.25;

void widen(Extent& extent, double to) {
  extent.low = std::min(extent.low, to), extent.high = std::max(extent.high, to);
}

}  // namespace

// In few readings a form has few; in many the smallest windows would be coincidences among very
// many.
BumpScanner::BumpScanner(const LinearisationPoint& point, const ObservationMask& mask)
    : point_(&point),
      mask_(&mask),
      least_readings_(std::clamp<std::size_t>(point.size() / 100, 4, 8)) {
  PointRoom room;
  const PointPart all = point.all(room);
  rear_.assign(all.rear.begin(), all.rear.end());
  for (const std::size_t sectors : {6U, 12U, 24U, 48U}) {
    for (const std::size_t lengths : {1U, 3U, 6U, 12U, 24U}) {
      if (lengths > 1 && !point.has_position) continue;
      if (mask.folds() < 12 && lengths > 6) continue;
      grids_.push_back(grid_of(sectors, lengths));
      tests_ += static_cast<double>(std::ranges::count(grids_.back().seen, 1));
    }
  }
}

BumpScanner::Grid BumpScanner::grid_of(std::size_t sectors, std::size_t lengths) const {
  PointRoom room;
  const PointPart all = point_->all(room);
  Grid out{sectors, lengths, {}, {}, {}};
  out.window.resize(point_->size());
  out.count.resize(sectors * lengths);
  std::vector<Extent> around(out.count.size(), nowhere), along(out.count.size(), nowhere);
  for (std::size_t i = 0; i < point_->size(); ++i) {
    const double turn =
        (all.theta[i] / two_pi - std::floor(all.theta[i] / two_pi)) * static_cast<double>(sectors);
    const double u =
        std::clamp(0.5 + 0.5 * (all.s[i] - point_->z_mid_mm) / point_->z_half_mm, 0.0, 0.999999) *
        static_cast<double>(lengths);
    const auto sector = std::min(sectors - 1, static_cast<std::size_t>(turn));
    const std::size_t at = sector * lengths + static_cast<std::size_t>(u);
    out.window[i] = static_cast<std::uint16_t>(at);
    if (!mask_->used[i]) continue;
    widen(around[at], turn), widen(along[at], u);
    ++out.count[at];
  }
  for (std::size_t b = 0; b < out.count.size(); ++b)
    out.seen.push_back(out.count[b] >= least_readings_ &&
                       !(std::max(around[b].length(), along[b].length()) < least_seen));
  return out;
}

std::vector<Hypothesis> BumpScanner::operator()(const NormalEquations& equations,
                                                std::span<const double> remainder_mm) const {
  std::vector<double> left = weighted(equations, {remainder_mm.begin(), remainder_mm.end()});
  for (std::size_t i = 0; i < left.size(); ++i)
    left[i] = !mask_->used[i] ? 0.0 : rear_[i] ? -left[i] : left[i];
  std::vector<Hypothesis> best;
  for (const Grid& grid : grids_) {
    Hypothesis h;
    if (best_of(grid, left, h)) best.push_back(std::move(h));
  }
  return best;
}

bool BumpScanner::best_of(const Grid& grid, std::span<const double> left, Hypothesis& best) const {
  std::vector<double> sum(grid.count.size(), 0.0), largest(sum.size(), 0.0);
  for (std::size_t i = 0; i < left.size(); ++i) {
    double& most = largest[grid.window[i]];
    sum[grid.window[i]] += left[i];
    if (std::abs(left[i]) > std::abs(most)) most = left[i];
  }
  // Three quarters of the least make a form: (1 − 1/n)² is left of n equal ones without one.
  const double making = 0.75 * static_cast<double>(least_readings_);
  const double without_one = (1.0 - 1.0 / making) * (1.0 - 1.0 / making);
  double top = 0.0;
  std::size_t where = 0;
  for (std::size_t b = 0; b < sum.size(); ++b) {
    if (!grid.seen[b]) continue;
    const double value = sum[b] * sum[b] / static_cast<double>(grid.count[b]);
    const double rest = sum[b] - largest[b];  // a form is not made by a reading or two
    if (rest * rest / static_cast<double>(grid.count[b] - 1) < without_one * value) continue;
    if (value > top) top = value, where = b;
  }
  const double width = two_pi / static_cast<double>(grid.sectors);
  const double length = 2.0 * point_->z_half_mm / static_cast<double>(grid.lengths);
  best.pattern.kind = Pattern::Kind::bump;
  best.pattern.angle_rad = (static_cast<double>(where / grid.lengths) + 0.5) * width;
  best.pattern.width_rad = 0.5 * width;
  best.pattern.position_mm = point_->z_mid_mm - point_->z_half_mm +
                             (static_cast<double>(where % grid.lengths) + 0.5) * length;
  best.pattern.length_mm = grid.lengths > 1 ? 0.5 * length : 0.0;
  return top > 0.0;
}

}  // namespace trueaxis::diagnose_detail

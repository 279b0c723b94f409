// SPDX-License-Identifier: Apache-2.0
#include "job/seat_distance.hpp"

#include <algorithm>
#include <cmath>

#include "job/references.hpp"
#include "job/slip.hpp"

namespace trueaxis {
namespace {

/// The second axis less the first, an axis itself, about the first's z_ref.
AxisEstimate difference(const AxisEstimate& first, const AxisEstimate& second) {
  AxisEstimate out;
  const double z = first.axis.z_ref_mm;
  const auto [x, y] = second.axis.at(z);
  out.axis = {x - first.axis.x_mm, y - first.axis.y_mm, second.axis.slope_x - first.axis.slope_x,
              second.axis.slope_y - first.axis.slope_y, z};
  // (x, y)(z) of the second is (x, y)(its z_ref) + slope d: J C Jᵀ with J = [[1, d], [0, 1]].
  const double d = z - second.axis.z_ref_mm;
  std::array<double, 16> moved = second.covariance.by_rows;
  for (std::size_t row = 0; row < 2; ++row)
    for (std::size_t column = 0; column < 4; ++column)
      moved[4 * row + column] += d * moved[4 * (row + 2) + column];
  for (std::size_t row = 0; row < 4; ++row)
    for (std::size_t column = 0; column < 2; ++column)
      moved[4 * row + column] += d * moved[4 * row + column + 2];
  std::ranges::transform(first.covariance.by_rows, moved, out.covariance.by_rows.begin(),
                         std::plus{});
  return out;
}

AxisOffset offset_at(const AxisEstimate& apart, double z_mm) {
  const auto [x, y] = apart.axis.at(z_mm);
  return {z_mm, x, y, apart.u_at(z_mm)};
}

AxisOffset worst_of(const AxisEstimate& apart, const FitResult& seat) {
  const AxisOffset low = offset_at(apart, seat.position_min_mm),
                   high = offset_at(apart, seat.position_max_mm);
  return low.size_mm() > high.size_mm() ? low : high;
}

constexpr double least_slip_mm = 0.01;  // the smallest that is typical (part.slip)

/// No reading of one lies in time between two of the other; streams without times may not either.
bool one_after_the_other(const ProbeStream& a, const ProbeStream& b) {
  if (a.time_s.empty() || b.time_s.empty()) return true;
  return a.time_s.back() <= b.time_s.front() || b.time_s.back() <= a.time_s.front();
}

SeatDistance distance_of(const PlannedJob& result, std::size_t i, std::size_t j) {
  const FitResult &a = fit_used(result, i), &b = fit_used(result, j);
  const AxisEstimate apart = difference(axis_of_reference(result, i), axis_of_reference(result, j));
  const auto middle = [](const FitResult& fit) {
    return 0.5 * (fit.position_min_mm + fit.position_max_mm);
  };
  SeatDistance out{.first = i, .second = j, .middle = {}, .worst = {}};
  out.middle = {offset_at(apart, middle(a)), offset_at(apart, middle(b))};
  out.worst = {worst_of(apart, a), worst_of(apart, b)};
  out.tilt_rad = std::atan(std::hypot(apart.axis.slope_x, apart.axis.slope_y));
  out.u_tilt_rad = apart.u_slope();
  out.slip_looks_alike =
      one_after_the_other(result.streams[i], result.streams[j]) &&
      std::ranges::all_of(out.middle, [&](const AxisOffset& at) {
        return at.size_mm() > std::max(least_slip_mm, a.coverage_factor * at.u_mm);
      });
  return out;
}

bool has_a_line(const FitResult& fit) {
  return fit.surface == SurfaceKind::cone || fit.surface == SurfaceKind::cylinder;
}

}  // namespace

double AxisOffset::size_mm() const { return std::hypot(x_mm, y_mm); }

bool axis_is_known(const PlannedJob& result, std::size_t reference) {
  const bool slipped = reference < result.diagnoses.size() && result.diagnoses[reference] &&
                       result.diagnoses[reference]->slip() && !part_slipped(result).empty();
  return !slipped && fit_used(result, reference).axis_known() && !result.agreement.reason;
}

std::vector<SeatDistance> seat_distances(const PlannedJob& result) {
  std::vector<SeatDistance> out;
  for (std::size_t i = 0; i < result.fits.size(); ++i)
    for (std::size_t j = i + 1; j < result.fits.size(); ++j)
      if (has_a_line(fit_used(result, i)) && has_a_line(fit_used(result, j)) &&
          axis_is_known(result, i) && axis_is_known(result, j))
        out.push_back(distance_of(result, i, j));
  return out;
}

}  // namespace trueaxis

// SPDX-License-Identifier: Apache-2.0
#include "fit/moved.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <vector>

#include "math/statistics.hpp"

namespace trueaxis {
namespace {

/// A lone reading far off moves the centre of its turn; a part that moved takes its neighbours
/// along.
std::vector<double> without_lone_outliers(std::span<const double> left_mm) {
  constexpr double far = 5.0;  // σ: of 1e6 readings of noise one
  std::vector<double> out(left_mm.begin(), left_mm.end()), there;
  std::ranges::copy_if(out, std::back_inserter(there), [](double r) { return std::isfinite(r); });
  const double limit_mm = far * mad_sigma(there);
  const auto is_far = [&](std::size_t i) { return std::abs(left_mm[i]) > limit_mm; };
  for (std::size_t i = 0; i < out.size(); ++i)
    if (is_far(i) && !(i > 0 && is_far(i - 1)) && !(i + 1 < out.size() && is_far(i + 1)))
      out[i] = std::numeric_limits<double>::quiet_NaN();
  return out;
}

}  // namespace

double U_of_axis_mm(const FitResult& fit) {
  const double outer_mm = std::max(std::abs(fit.position_min_mm), std::abs(fit.position_max_mm));
  const double u_mm =
      fit.surface == SurfaceKind::plane
          ? outer_mm * fit.axis.u_slopes()
          : std::max(fit.axis.u_at(fit.position_min_mm), fit.axis.u_at(fit.position_max_mm));
  return fit.coverage_factor * u_mm;
}

std::optional<CentreStep> moved_in_pass(const ProbeStream& stream, std::span<const double> left_mm,
                                        const FitResult& fit, double by_chance) {
  if (!fit.axis_known() || left_mm.size() != stream.size()) return {};
  const std::vector<double> counted_mm = without_lone_outliers(left_mm);
  const auto step =
      find_centre_step(turn_centres(stream, counted_mm, CentresOf::residuals), by_chance);
  if (!step || !(step->size_mm > U_of_axis_mm(fit))) return {};
  std::vector<double> value_mm = stream.reading_mm;
  for (std::size_t i = 0; i < value_mm.size(); ++i)
    if (!std::isfinite(counted_mm[i])) value_mm[i] = counted_mm[i];
  return weighed_with_delay(*step, stream, value_mm);
}

}  // namespace trueaxis

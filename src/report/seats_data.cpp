// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "report/chart_readings.hpp"
#include "report/page_data.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

/// The lengths probed: Z of a lateral surface, X of a face at the mean of its readings.
Json seat_data(const JobResult& result, std::size_t i) {
  const FitResult& fit = result.fits[i];
  const ProbeStream& stream = result.streams[i];
  const bool face = stream.kind == StreamKind::face;
  Json seat{{"index", i}, {"face", face}, {"bore", fit.bore}};
  if (face) {
    double sum = 0.0;
    for (const double z : stream.reading_mm) sum += z;
    const double count = static_cast<double>(std::max<std::size_t>(1, stream.size()));
    seat["z_mm"] = Json::array_t{rounded(sum / count, 3), rounded(sum / count, 3)};
    seat["radius_mm"] =
        Json::array_t{rounded(fit.position_min_mm, 3), rounded(fit.position_max_mm, 3)};
    return seat;
  }
  const auto radius = [&](double z_mm) {
    return rounded(
        fit.shape.radius_mm + fit.shape.tan_half_angle * (z_mm - fit.shape.axis.z_ref_mm), 3);
  };
  seat["z_mm"] = Json::array_t{rounded(fit.position_min_mm, 3), rounded(fit.position_max_mm, 3)};
  seat["radius_mm"] = Json::array_t{radius(fit.position_min_mm), radius(fit.position_max_mm)};
  return seat;
}

Json cut_data(const TargetSurface& target) {
  if (target.kind == TargetKind::face)
    return {{"face", true},
            {"bore", false},
            {"z_mm", {target.z_face_mm, target.z_face_mm}},
            {"radius_mm", {target.radius_start_mm, target.radius_end_mm}}};
  const double end_mm =
      target.radius_mm + target.tan_half_angle * (target.z_end_mm - target.z_start_mm);
  return {{"face", false},
          {"bore", target.bore},
          {"z_mm", {target.z_start_mm, target.z_end_mm}},
          {"radius_mm", {target.radius_mm, end_mm}}};
}

}  // namespace

Json seats_data(const JobResult& result) {
  Json data{{"seats", Json::array()}};
  for (std::size_t i = 0; i < std::min(result.fits.size(), result.streams.size()); ++i) {
    if (!fit_is_usable(result.streams[i], result.fits[i]) || !result.streams[i].has_position())
      continue;
    data["seats"].push_back(seat_data(result, i));
  }
  if (result.job.target) data["cut"] = cut_data(*result.job.target);
  return data;
}

Json ellipse_data(const AxisEstimate& estimate, double z_mm) {
  const auto& c = estimate.covariance;
  const double dz = z_mm - estimate.axis.z_ref_mm;
  using enum AxisRow;
  const double xx = c(x, x) + 2.0 * dz * c(x, slope_x) + dz * dz * c(slope_x, slope_x);
  const double yy = c(y, y) + 2.0 * dz * c(y, slope_y) + dz * dz * c(slope_y, slope_y);
  const double xy = c(x, y) + dz * (c(x, slope_y) + c(y, slope_x)) + dz * dz * c(slope_x, slope_y);
  const double middle = 0.5 * (xx + yy), half = std::hypot(0.5 * (xx - yy), xy);
  return {{"u_long_mm", std::sqrt(middle + half)},
          {"u_short_mm", std::sqrt(std::max(0.0, middle - half))},
          {"towards_deg", 0.5 * std::atan2(2.0 * xy, xx - yy) / rad_per_deg}};
}

}  // namespace trueaxis

// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <utility>

#include "job/files/job_words.hpp"
#include "job/references.hpp"
#include "job/slip.hpp"
#include "job/target_datum.hpp"
#include "report/page_data.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

double tilt_deg(const Axis& axis) {
  return std::atan(std::hypot(axis.slope_x, axis.slope_y)) / rad_per_deg;
}

double offset_mm(const Axis& axis, double z_mm) {
  const auto [x, y] = axis.at(z_mm);
  return std::hypot(x, y);
}

Json axis_data(const AxisEstimate& estimate, double z_start_mm, double z_end_mm) {
  const auto end = [&estimate](double z_mm) {
    const auto [x, y] = estimate.axis.at(z_mm);
    return Json{{"z_mm", z_mm},
                {"x_mm", x},
                {"y_mm", y},
                {"u_mm", estimate.u_at(z_mm)},
                {"ellipse", ellipse_data(estimate, z_mm)}};
  };
  return {{"start", end(z_start_mm)},
          {"end", end(z_end_mm)},
          {"tilt_deg", tilt_deg(estimate.axis)},
          {"u_tilt_deg", estimate.u_slope() / rad_per_deg}};
}

/// Coaxiality with the spindle axis as the datum, as it would be cut without correction; a face: 2
/// R tilt.
Json before(const AxisEstimate& estimate, double face_radius_mm, std::pair<double, double> length) {
  const auto [z_start, z_end] = length;
  if (face_radius_mm > 0.0) {
    const double tilt = std::hypot(estimate.axis.slope_x, estimate.axis.slope_y);
    return {{"coaxiality_mm", 2.0 * face_radius_mm * tilt},
            {"u_mm", 2.0 * face_radius_mm * estimate.u_slope()}};
  }
  const bool at_start = offset_mm(estimate.axis, z_start) >= offset_mm(estimate.axis, z_end);
  const double worse_z = at_start ? z_start : z_end;
  return {{"coaxiality_mm", 2.0 * offset_mm(estimate.axis, worse_z)},
          {"u_mm", 2.0 * estimate.u_at(worse_z)}};
}

std::pair<double, double> length_shown(const JobResult& result) {
  if (result.job.target) return {result.job.target->z_start_mm, result.job.target->z_end_mm};
  double low = 0.0, high = 0.0;
  bool first = true;
  for (std::size_t i = 0; i < result.fits.size(); ++i) {
    if (i < result.streams.size() && result.streams[i].kind == StreamKind::face) continue;
    const FitResult& fit = result.fits[i];
    low = first ? fit.position_min_mm : std::min(low, fit.position_min_mm);
    high = first ? fit.position_max_mm : std::max(high, fit.position_max_mm);
    first = false;
  }
  return {low, high};
}

double face_radius(const JobResult& result, std::size_t i) {
  if (i >= result.streams.size() || result.streams[i].kind != StreamKind::face) return 0.0;
  const double given =
      i < result.job.references.size() ? result.job.references[i].face_radius_mm : 0.0;
  const FitResult& fit = result.fits[i];
  return given > 0.0 ? given : std::max(-fit.position_min_mm, fit.position_max_mm);
}

Json remainder_data(const Remainder& left) {
  return {{"offset_start_mm", left.offset_start_mm}, {"offset_end_mm", left.offset_end_mm},
          {"tilt_deg", left.tilt_rad / rad_per_deg}, {"coaxiality_mm", left.coaxiality_mm},
          {"u_coaxiality_mm", left.u_coaxiality_mm}, {"at_most_mm", left.limit_mm}};
}

/// The residual of the datum if the part were cut about the spindle axis.
Json before_datum(const JobResult& result, const std::pair<double, double>& length) {
  const Reference datum = judged(result, references_of(result)).front();
  return before(datum.axis, datum.face_radius_mm, length);
}

}  // namespace

Json target_data(const JobResult& result) {
  const std::pair<double, double> length = length_shown(result);
  Json data{{"z_start_mm", length.first},
            {"z_end_mm", length.second},
            {"of_cut", result.job.target.has_value()},
            {"references", Json::array()}};
  const std::vector<Remainder> left = result.datum         ? result.datum->references
                                      : result.target_axis ? result.target_axis->remainders
                                                           : std::vector<Remainder>{};
  const bool unsure = !part_slipped(result).empty();
  for (std::size_t i = 0; i < result.fits.size(); ++i) {
    const FitResult& fit = fit_used(result, i);
    const bool slipped =
        unsure && result.diagnoses.size() > i && result.diagnoses[i] && result.diagnoses[i]->slip();
    const bool withheld = i < result.axis_unknown.size() && result.axis_unknown[i];
    const bool solved =
        !slipped && !withheld &&
        (fit.status == FitStatus::converged || fit.status == FitStatus::max_iterations);
    const double radius = face_radius(result, i);
    Json reference{{"index", i}, {"face", radius > 0.0}, {"face_radius_mm", radius}};
    if (i < result.job.references.size()) reference["weight"] = result.job.references[i].weight;
    if (solved) {
      const bool associated = i < result.associated.size() && result.associated[i];
      const AxisEstimate axis = associated ? axis_of_reference(result, i) : fit.axis;
      reference["axis"] = axis_data(axis, length.first, length.second);
      reference["before"] = before(axis, radius, length);
    }
    if (i < left.size()) reference["after"] = remainder_data(left[i]);
    data["references"].push_back(reference);
  }
  if (result.target_axis) {
    data["axis"] = axis_data(result.target_axis->axis, length.first, length.second);
    if (result.datum)
      data["datum"] = {{"name", result.datum->name},
                       {"how", datum_words(result)},
                       {"before", before_datum(result, length)},
                       {"after", remainder_data(result.target_axis->remainders.front())}};
  }
  return data;
}

}  // namespace trueaxis

// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/number.hpp"
#include "fit/files/fit_files.hpp"
#include "format/text_layout.hpp"
#include "job/files/job_results.hpp"
#include "job/references.hpp"
#include "job/seat_distance.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

double towards_deg(double x_mm, double y_mm) {
  const double deg = std::atan2(y_mm, x_mm) / rad_per_deg;
  return deg < 0.0 ? deg + 360.0 : deg;
}

/// The angle of a line to the spindle axis.
Estimate tilt_of(const AxisEstimate& axis) {
  return {std::atan(std::hypot(axis.axis.slope_x, axis.axis.slope_y)), axis.u_tilt(), "rad", ""};
}

Json offset_object(const AxisOffset& at) {
  return {{"z", with_unit(at.z_mm, "mm")},
          {"x", with_unit(at.x_mm, "mm")},
          {"y", with_unit(at.y_mm, "mm")},
          {"offset", to_json(Estimate{at.size_mm(), at.u_mm, "mm", ""})},
          {"towards", with_unit(towards_deg(at.x_mm, at.y_mm), "deg")}};
}

std::array<AxisOffset, 2> ends_of(const FitResult& fit, const AxisEstimate& axis) {
  std::array<AxisOffset, 2> ends;
  const double z[] = {fit.position_min_mm, fit.position_max_mm};
  for (std::size_t e = 0; e < 2; ++e) {
    const auto [x, y] = axis.axis.at(z[e]);
    ends[e] = {z[e], x, y, axis.u_at(z[e])};
  }
  return ends;
}

std::string um_pm(double value_mm, double u_mm, double k) {
  return layout::size_plus_minus({value_mm, u_mm, "mm", ""}, k, 1.0 / mm_per_um, "µm");
}

std::string z_text(double z_mm) { return fmt::format("Z {:.6g} mm", hundredths(z_mm)); }

}  // namespace

Json seat_axis_object(const JobResult& result, std::size_t reference) {
  const FitResult& fit = fit_used(result, reference);
  if (!axis_is_known(result, reference)) return nullptr;
  const AxisEstimate axis = axis_of_reference(result, reference);
  Json json{{"tilt", to_json(tilt_of(axis))}, {"tap", tap_text(fit)}};
  if (fit.surface == SurfaceKind::plane) return json;
  json["ends"] = list_of(ends_of(fit, axis), offset_object);
  return json;
}

Json seats_apart_array(const JobResult& result) {
  return list_of(seat_distances(result), [&](const SeatDistance& d) -> Json {
    const auto seat = [&](std::size_t s) -> Json {
      return {{"reference", result.job.references[s == 0 ? d.first : d.second].name},
              {"in_its_middle", offset_object(d.middle[s])},
              {"coaxiality_about_the_other",
               to_json(Estimate{d.coaxiality_mm(s), d.u_coaxiality_mm(s), "mm", ""})}};
    };
    return {{"first", result.job.references[d.first].name},
            {"second", result.job.references[d.second].name},
            {"angle", to_json(Estimate{d.tilt_rad, d.u_tilt_rad, "rad", ""})},
            {"slip_looks_alike", d.slip_looks_alike},
            {"at", list_of_first(2, seat)}};
  });
}

std::string seat_axis_screen(const JobResult& result, std::size_t reference) {
  const FitResult& fit = fit_used(result, reference);
  if (!axis_is_known(result, reference)) return fit.axis_known() ? "" : axis_screen(fit);
  const AxisEstimate axis = axis_of_reference(result, reference);
  std::string text = axis_screen(fit);
  if (result.fits.size() == 1 || fit.surface == SurfaceKind::plane ||
      fit.position_min_mm == fit.position_max_mm)
    return text;  // axis and tap say it of the only one
  const auto ends = ends_of(fit, axis);
  text += "offset ";
  for (std::size_t e = 0; e < 2; ++e)
    text += (e == 0 ? "" : ", ") + um_pm(ends[e].size_mm(), ends[e].u_mm, fit.coverage_factor) +
            " at " + z_text(ends[e].z_mm);
  return text + ", tilt " +
         layout::size_plus_minus(tilt_of(axis), fit.coverage_factor, 1.0 / rad_per_deg, "°") + "\n";
}

std::string largest_distance_text(const JobResult& result) {
  const auto larger = [](const AxisOffset& a, const AxisOffset& b) {
    return a.size_mm() < b.size_mm();
  };
  const SeatDistance* of = nullptr;
  const AxisOffset* at = nullptr;
  const std::vector<SeatDistance> distances = seat_distances(result);
  for (const SeatDistance& d : distances) {
    const AxisOffset& middle = *std::ranges::max_element(d.middle, larger);
    if (at == nullptr || larger(*at, middle)) of = &d, at = &middle;
  }
  if (of == nullptr) return "";
  const double k = result.job.references.front().fit.coverage_factor;
  return fmt::format("; {} between the axes of {} and {} at {} (k = {:g})",
                     um_pm(at->size_mm(), at->u_mm, k), result.job.references[of->first].name,
                     result.job.references[of->second].name, z_text(at->z_mm), k);
}

std::string seats_apart_screen(const JobResult& result) {
  const double k = result.job.references.front().fit.coverage_factor;
  std::string text;
  for (const SeatDistance& d : seat_distances(result)) {
    const std::string a = result.job.references[d.first].name,
                      b = result.job.references[d.second].name;
    const auto at = [&](std::size_t s) {
      return um_pm(d.middle[s].size_mm(), d.middle[s].u_mm, k) + " at " + z_text(d.middle[s].z_mm) +
             ", the middle of " + (s == 0 ? a : b);
    };
    const auto coaxiality = [&](std::size_t s) {
      return um_pm(d.coaxiality_mm(s), d.u_coaxiality_mm(s), k);
    };
    text += "apart  " + b + " from " + a + ": " + at(0) + "; " + at(1) + "; angle " +
            layout::size_plus_minus({1e3 * d.tilt_rad, 1e3 * d.u_tilt_rad, "mrad", ""}, k, 1.0,
                                    "mrad") +
            "\n";
    text += "       coaxiality " + coaxiality(1) + " of " + b + " with " + a + " as datum, " +
            coaxiality(0) + " of " + a + " with " + b +
            " as datum (axes over the probed lengths)\n";
    if (d.slip_looks_alike)
      text += "       or the part slipped between " + a + " and " + b +
              ", which would look the same: probe " + a + " again, and compare\n";
  }
  return text;
}

}  // namespace trueaxis

// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <optional>

#include "base/counted.hpp"
#include "base/number.hpp"
#include "fit/files/fit_files.hpp"
#include "fit/probe_height.hpp"
#include "format/text_layout.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {

using namespace layout;
namespace {

/// "radius 32.00396 ± 0.00013 mm", of a length below 1 mm in µm; empty where there is none.
std::string parameter_line(const FitResult& result, const std::string& name,
                           const std::string& label) {
  for (const auto* list : {&result.parameters, &result.derived}) {
    const auto found = std::ranges::find(*list, name, &FitParameter::name);
    if (found == list->end()) continue;
    const Estimate e = at_edge(found->estimate);
    const bool small = e.unit == "mm" && std::abs(e.value) < 1.0;
    // h off it hides h²/2R.
    constexpr double off_mm = 0.1;
    const bool on_centre = holds_on_centre_height(result) && label == "radius" && e.determined();
    return padded(label, 7) +
           plus_minus(e, result.coverage_factor, small ? 1.0 / mm_per_um : 1.0,
                      small ? "µm" : e.unit) +
           (on_centre ? fmt::format(" with the probe on centre height; {:g} mm off hides {}",
                                    off_mm, um(off_mm * off_mm / (2.0 * e.value)))
                      : "") +
           "\n";
  }
  return "";
}

std::string rejected_text(const FitResult& result) {
  constexpr std::size_t most = 5;
  if (result.rejected.empty()) return "";
  std::vector<std::size_t> rows;
  for (const Rejected& one : result.rejected) rows.push_back(one.row);
  return fmt::format(", {} excluded as outliers (row{} {}; row {}: {})", rows.size(),
                     rows.size() == 1 ? "" : "s", ranges_text(rows, most), rows.front(),
                     result.rejected.front().why);
}

std::string why_unknown(const FitResult& fit) {
  for (const FitParameter& one : fit.parameters)
    if (!one.estimate.determined() && !one.estimate.why_not.empty()) return one.estimate.why_not;
  return "the readings do not determine it";
}

}  // namespace

namespace {

struct Tap {
  double c_deg = 0.0, off_mm = 0.0, at_mm = 0.0;
  char along = 'Z';
};

/// Of a face what its tilt makes at the outer end: Z is largest where its normal leans away. Beyond
/// the spindle axis X is negative.
Tap farthest(const FitResult& fit) {
  Tap out;
  double towards_rad = 0.0;
  const bool face = fit.surface == SurfaceKind::plane;
  if (face) out.along = 'X';
  for (const double end_mm : {fit.position_min_mm, fit.position_max_mm}) {
    const Axis& axis = fit.axis.axis;
    const auto at =
        face ? std::array{-end_mm * axis.slope_x, -end_mm * axis.slope_y} : axis.at(end_mm);
    const double off_mm = std::hypot(at[0], at[1]);
    if (off_mm <= out.off_mm) continue;
    out.off_mm = off_mm, out.at_mm = hundredths(end_mm);
    towards_rad = std::atan2(at[1], at[0]);
  }
  const bool rear = !face && !fit.set_ups.empty() && fit.set_ups.back().side == Root::rear;
  out.c_deg = std::fmod(std::round(towards_rad / rad_per_deg) + (rear ? 540.0 : 360.0), 360.0);
  return out;
}

std::optional<Tap> tap_of(const FitResult& fit) {
  if (!fit.axis_known()) return std::nullopt;
  const Tap tap = farthest(fit);
  const double u_mm =
      tap.along == 'X' ? std::abs(tap.at_mm) * fit.axis.u_slopes() : fit.axis.u_at(tap.at_mm);
  return tap.off_mm > 2.0 * fit.coverage_factor * u_mm ? std::optional(tap) : std::nullopt;
}

}  // namespace

std::string tap_text(const FitResult& fit) {
  const auto tap = tap_of(fit);
  return tap ? fmt::format("high spot at C = {:.0f}°, run-out {} at {} {:.6g} mm: tap there by {}",
                           tap->c_deg, um(2.0 * tap->off_mm), tap->along, tap->at_mm,
                           um(tap->off_mm))
             : "";
}

std::string tap_screen(const FitResult& fit, const std::string& name) {
  const auto tap = tap_of(fit);
  // "A" is a name, "cone seat" a word.
  const bool word = !name.empty() && std::islower(static_cast<unsigned char>(name.front())) != 0;
  return tap ? fmt::format("tap    {}{} runs out {} at {} {:.6g} mm: tap at C = {:.0f}° by {}\n",
                           word ? "The " : "", name, um(2.0 * tap->off_mm), tap->along, tap->at_mm,
                           tap->c_deg, um(tap->off_mm))
             : "";
}

std::string axis_accuracy(const FitResult& fit) {
  if (!fit.axis_known()) return "axis not known";
  if (fit.surface == SurfaceKind::sphere) return "";
  if (fit.surface == SurfaceKind::plane) {
    const std::string tilt = parameter_line(fit, "tilt", "tilt");
    return tilt.empty() ? "" : "tilt " + tilt.substr(7, tilt.size() - 8);
  }
  const double U_um =
      fit.coverage_factor *
      std::max(fit.axis.u_at(fit.position_min_mm), fit.axis.u_at(fit.position_max_mm)) / mm_per_um;
  return std::isfinite(U_um) ? fmt::format("axis known to ± {:.{}f} µm (k = {:g})", U_um,
                                           decimals_of(U_um, 0), fit.coverage_factor)
                             : "axis without an uncertainty";
}

std::string axis_screen(const FitResult& fit) {
  if (fit.status != FitStatus::converged) return "";
  if (!fit.axis_known()) return "axis   not known: " + why_unknown(fit) + "\n";
  if (fit.surface == SurfaceKind::plane) return parameter_line(fit, "tilt", "tilt");
  if (fit.surface == SurfaceKind::sphere)
    return parameter_line(fit, "x0", "x0") + parameter_line(fit, "y0", "y0") +
           parameter_line(fit, "z0", "z0") + parameter_line(fit, "eccentricity", "off");
  std::string text;
  for (const double z : {fit.position_min_mm, fit.position_max_mm}) {
    const auto at = fit.axis.axis.at(z);
    const double U_um = fit.coverage_factor * fit.axis.u_at(z) / mm_per_um;
    const int decimals = decimals_of(U_um, 0);
    text += fmt::format(
        "{}x {:.{}f} µm, y {:.{}f} µm, {}", text.empty() ? "axis   " : "       ", at[0] / mm_per_um,
        decimals, at[1] / mm_per_um, decimals,
        std::isfinite(U_um) ? fmt::format("U {:.{}f} µm", U_um, decimals) : "U not determined");
    if (fit.position_min_mm == fit.position_max_mm) {
      text += "\n";
      break;
    }
    text += fmt::format(" at Z {:.6g} mm\n", hundredths(z));
  }
  return text;
}

std::string fit_screen(const FitResult& result) {
  const bool converged = result.status == FitStatus::converged;
  const std::string accuracy = converged ? axis_accuracy(result) : "";
  std::string text = fmt::format("{}: {}{}{}; {} of {}, residuals {} RMS{}\n",
                                 !converged            ? "NOT FITTED"
                                 : result.axis_known() ? "FITTED"
                                                       : "NOT KNOWN",
                                 to_string(result.surface), accuracy.empty() ? "" : ", ", accuracy,
                                 counted(result.points, "reading"), result.source,
                                 um(result.rms_mm), rejected_text(result));
  if (!converged) {
    for (const std::string& note : result.input_notes) text += "input  " + note + "\n";
    return text + "why    " + result.message + "\n";
  }
  text += tap_screen(result, to_string(result.surface)) + axis_screen(result);
  if (result.surface == SurfaceKind::cone) {
    text += parameter_line(result, "radius_mid", "radius") +
            parameter_line(result, "half_angle", "angle");
  } else {
    text += parameter_line(result, "radius", "radius");
  }
  if (result.surface == SurfaceKind::torus)
    text += parameter_line(result, "minor_radius", "tube") + parameter_line(result, "z0", "z0");
  if (result.surface != SurfaceKind::plane) text += parameter_line(result, "tilt", "tilt");
  for (const std::string& note : result.input_notes) text += "input  " + note + "\n";
  for (const std::string& note : result.notes) text += "note   " + note + "\n";
  return text;
}

}  // namespace trueaxis

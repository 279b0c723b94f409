// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/never.hpp"
#include "base/number.hpp"
#include "correct/files/table_files.hpp"
#include "format/reason_words.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

constexpr double um = 1.0 / mm_per_um;

std::string actuator_text(const Actuator& actuator) {
  const std::string response =
      actuator.measured.empty()
          ? fmt::format("{:.6g} Hz, damping {:.6g}", actuator.natural_frequency_hz,
                        actuator.damping)
          : fmt::format("frequency response measured at {} frequencies", actuator.measured.size());
  return fmt::format("stroke {:.6g} µm, {}, delay {:.6g} ms, slew {:.6g} mm/s, sampling {:.6g} Hz",
                     actuator.stroke_mm * um, response, actuator.delay_s * 1e3,
                     actuator.slew_mm_per_s, actuator.sampling_hz);
}

std::string target_text(const TargetSurface& target) {
  if (target.kind == TargetKind::face) {
    return "face at Z " + fixed(target.z_face_mm, 6) + " mm, X from " +
           fixed(target.radius_start_mm, 6) + " to " + fixed(target.radius_end_mm, 6) + " mm";
  }
  std::string text = target.kind == TargetKind::cone ? "cone" : "cylinder";
  if (target.bore) text += " (bore)";
  text += ", radius " + fixed(target.radius_mm, 6) + " mm at Z " + fixed(target.z_start_mm, 6) +
          " mm, to Z " + fixed(target.z_end_mm, 6) + " mm";
  if (target.kind == TargetKind::cone) {
    text += ", half angle " + fixed(std::atan(target.tan_half_angle) / rad_per_deg, 6) +
            " deg (positive: radius grows with Z)";
  }
  return text;
}

/// "Z 60.000000 to 40.000000 mm"; of a face X.
std::string range_text(bool face, double start_mm, double end_mm) {
  return (face ? "X " : "Z ") + fixed(start_mm, 6) + " to " + fixed(end_mm, 6) + " mm";
}

std::string axis_text(const AxisEstimate& estimate) {
  const Axis& axis = estimate.axis;
  return "x " + fixed(axis.x_mm, 7) + " mm, y " + fixed(axis.y_mm, 7) + " mm at Z " +
         fixed(axis.z_ref_mm, 6) + " mm, dx/dz " + fixed(axis.slope_x, 9) + ", dy/dz " +
         fixed(axis.slope_y, 9) + ", u " + fixed(estimate.u_at(axis.z_ref_mm) * um, 4) +
         " µm there (k = 1)";
}

std::string contact_text(const Correction& correction) {
  const TargetSurface& target = correction.target;
  return target.kind == TargetKind::face
             ? range_text(true, target.radius_start_mm, target.radius_end_mm)
             : range_text(false, target.z_start_mm, target.z_end_mm);
}

std::string following_text(const ActuatorMargin& margin) {
  return fixed(margin.following_mm * um, 4) + " µm peak (" +
         fixed(margin.following_uncompensated_mm * um, 4) +
         " µm if the wanted profile were sent), steady run";
}

/// Rounded down; at least the speed of the table.
std::string speed_limit_text(const ActuatorMargin& margin, double speed_rpm) {
  return fmt::format("{:.6g} rpm, the highest that the actuator follows",
                     std::max(speed_rpm, std::floor(std::min(margin.max_speed_rpm, 99999.0))));
}

std::string speed_text(const ActuatorMargin& margin) {
  if (!(margin.max_speed_rpm > 0.0)) return "at no speed";
  return or_never(margin.max_speed_rpm, "rpm",
                  fmt::format("highest speed {:.12g} rpm", std::floor(margin.max_speed_rpm)),
                  "at every speed of a lathe's spindle");
}

}  // namespace

std::string correction_header(const Correction& correction) {
  const ToolSetup& tool = correction.tool;
  const ActuatorMargin& margin = correction.margin;
  const bool face = correction.target.kind == TargetKind::face;
  const std::string along = face ? "Z" : "X";
  const std::pair<std::string, std::string> lines[] = {
      {"schema", "trueaxis.correction/1"},
      {"version", TRUEAXIS_VERSION},
      {"units", "mm, deg; X is a radius"},
      {along + "_fts",
       face ? "Z commanded - Z programmed at this X, positive along +Z"
            : "X commanded - X programmed at this Z, positive away from the spindle axis"},
      {along + "_command", correction.actuator.precompensate ? "precompensated for the actuator"
                                                             : "as wanted, no precompensation"},
      {"c_zero", "that of the probe stream"},
      {"c_sense", tool.sense > 0 ? "+1 while cutting" : "-1 while cutting"},
      {face ? "x_datum" : "z_datum", face ? "spindle axis; the centre of the tool's nose"
                                          : "that of the probe stream; the centre of the tool's "
                                            "nose"},
      {"target", target_text(correction.target)},
      {"contact", contact_text(correction)},
      {"nose_centre", range_text(face, correction.position_start_mm, correction.position_end_mm) +
                          ": the programmed path"},
      {"tool_height", fixed(tool.height_mm, 6) + " mm"},
      {"tool_angle_from_probe", fixed(tool.angle_from_probe_rad / rad_per_deg, 6) + " deg"},
      {"nose_radius", fixed(tool.nose_radius_mm, 6) + " mm"},
      {"speed", fmt::format("{:.6g} rpm", tool.speed_rpm)},
      {"speed_limit", speed_limit_text(margin, tool.speed_rpm)},
      {"feed", fmt::format("{:.6g} mm/rev", tool.feed_mm_per_rev)},
      {"rows_per_revolution",
       fmt::format("{}, linear in between, {}_fts there off by at most {} µm; held until the next, "
                   "off by at most {} µm",
                   tool.rows_per_revolution, along,
                   fixed(correction.between_rows.largest_mm * um, 4),
                   fixed(correction.held_rows.largest_mm * um, 4))},
      {"interpolation", to_string(tool.interpolation)},
      {"actuator", actuator_text(correction.actuator)},
      {"stroke_used", fixed(margin.stroke_used_mm * um, 3) + " µm of " +
                          fixed(margin.stroke_available_mm * um, 3) + " µm"},
      {"following_error", following_text(margin)},
      {"target_axis", axis_text(correction.axis)}};
  std::string text;
  for (const auto& [key, value] : lines) text += fmt::format("# {}: {}\n", key, value);
  if (correction.loop.u_lag_rad > 0.0)
    text +=
        fmt::format("# machine_loop: the table is corrected for gain {:+.6f}, lag {:+.5f} deg\n",
                    correction.loop.gain, correction.loop.lag_rad / rad_per_deg);
  for (const LearnedMotion& one : correction.loop.motion)
    text += fmt::format("# machine_motion: {} UPR, cos {:+.6f} um, sin {:+.6f} um\n", one.order,
                        one.cos_mm * um, one.sin_mm * um);
  return text;
}

std::string correction_preview(const Correction& correction) {
  const bool face = correction.target.kind == TargetKind::face;
  const CorrectionRows& rows = correction.rows;
  const ActuatorMargin& margin = correction.margin;
  const auto range = [](const std::vector<double>& values) {
    if (values.empty()) return std::string("none");
    const auto [low, high] = std::minmax_element(values.begin(), values.end());
    return fixed(*low * um, 3) + " to " + fixed(*high * um, 3) + " µm";
  };
  std::string text = "target      " + target_text(correction.target) + '\n';
  text += "contact     " + contact_text(correction) + ", centre of the nose " +
          range_text(face, correction.position_start_mm, correction.position_end_mm) + '\n';
  text += "rows        " + std::to_string(rows.wanted_mm.size()) + " in " +
          std::to_string(rows.revolution.empty() ? 0 : rows.revolution.back() + 1) +
          " revolutions, straight lines between them off by at most " +
          fixed(correction.between_rows.largest_mm * um, 3) + " µm, rows held until the next by " +
          fixed(correction.held_rows.largest_mm * um, 3) + " µm\n";
  text += std::string(face ? "Z_fts       " : "X_fts       ") + range(rows.wanted_mm) + '\n';
  text += std::string(face ? "Z_command   " : "X_command   ") + range(rows.command_mm) + '\n';
  text += "harmonics   A cos(nC - phase), at the start and the end of the cut\n";
  for (const CorrectionHarmonic& h : correction.harmonics) {
    text += fmt::format(
        "  n = {}   {:10.4f} µm {:9.3f} deg   {:10.4f} µm {:9.3f} deg   actuator gain {:.5f}, lag "
        "{:.3f} deg\n",
        h.order, h.amplitude_start_mm * um, h.phase_start_rad / rad_per_deg,
        h.amplitude_end_mm * um, h.phase_end_rad / rad_per_deg, h.gain, h.lag_rad / rad_per_deg);
  }
  if (correction.harmonics.empty()) text += "  none above 1 nm\n";
  text += "stroke      " + fixed(margin.stroke_used_mm * um, 3) + " of " +
          fixed(margin.stroke_available_mm * um, 3) + " µm\n";
  text += "slew        " + fixed(margin.slew_used_mm_per_s, 3) + " of " +
          fixed(margin.slew_available_mm_per_s, 3) + " mm/s\n";
  text += "frequency   " + fixed(margin.highest_frequency_hz, 2) + " Hz, bandwidth " +
          fixed(margin.bandwidth_hz, 2) + " Hz\n";
  text += "following   " + following_text(margin) + '\n';
  text += margin.follows ? "follows     yes"
                         : "follows     no: " + words_of(margin.breaks, "; ") + "; " +
                               words_of(margin.remedies, ", or ");
  return text + ", " + speed_text(margin) + '\n';
}

}  // namespace trueaxis

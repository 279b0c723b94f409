// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "correct/files/control_table.hpp"
#include "correct/profile.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

/// Largest distance of the middle of two rows from the wanted correction there, mm.
double largest_between_mm(const Correction& correction, const Profile& profile) {
  const CorrectionRows& rows = correction.rows;
  double largest = 0.0;
  for (std::size_t i = 0; i + 1 < rows.wanted_mm.size(); ++i) {
    const double middle = profile.at(0.5 * (rows.c_rad[i] + rows.c_rad[i + 1]),
                                     0.5 * (rows.position_mm[i] + rows.position_mm[i + 1]));
    largest =
        std::max(largest, std::abs(middle - 0.5 * (rows.wanted_mm[i] + rows.wanted_mm[i + 1])));
  }
  return largest;
}

/// Seven digits, without an exponent.
std::string feed_word(double f) {
  return fmt::format(" F{:.{}f}", f, std::max(6, 6 - static_cast<int>(std::floor(std::log10(f)))));
}

Profile profile_of(const Correction& c) { return {c.axis.axis, c.target, c.tool, c.motions}; }

}  // namespace

MadeControlTable halstreamer_text(const Correction& correction) {
  constexpr double unit_mm = 1e-9;  // µm with six decimals
  const CorrectionRows& rows = correction.rows;
  const bool face = correction.target.kind == TargetKind::face;
  std::string text = "# schema: trueaxis.halstreamer/1\n";
  put(text,
      "# cfg=ff: {}_command in um ({}), C in degrees; {} lines a revolution at {:.6g} rpm; the "
      "last line twice\n",
      face ? "Z" : "X", correction.actuator.precompensate ? "precompensated" : "as wanted",
      correction.tool.rows_per_revolution, correction.tool.speed_rpm);
  const std::size_t count = rows.command_mm.size();
  text.reserve(text.size() + 24 * count);
  for (std::size_t i = 0; i <= count; ++i) {
    const std::size_t row = std::min(i, count - 1);
    put(text, "{:.6f} {:.6f}\n", rows.command_mm[row] / mm_per_um, rows.c_rad[row] / rad_per_deg);
  }
  return {std::move(text), 0.5 * unit_mm,
          largest_between_mm(correction, profile_of(correction)) + 0.5 * unit_mm};
}

MadeControlTable servo_nc(const Correction& correction, const ControlTable& table) {
  constexpr double unit_mm = 1e-6;
  const CorrectionRows& rows = correction.rows;
  const Profile profile = profile_of(correction);
  const bool face = correction.target.kind == TargetKind::face;
  const double minutes = 1.0 / (correction.tool.speed_rpm * correction.tool.rows_per_revolution);
  const double scale = table.x_is_diameter ? 2.0 : 1.0;
  std::string text = "( schema: trueaxis.servo_nc/1 )\n";
  put(text, "( X IS A {}, OF THE CENTRE OF THE NOSE; C IN DEGREES, RUNNING, AS PROBED; F IN {} )\n",
      table.x_is_diameter ? "DIAMETER" : "RADIUS",
      table.minutes ? "MINUTES A BLOCK" : "BLOCKS A MINUTE");
  text += table.head;
  put(text, "G93\n");
  const std::string feed = feed_word(table.minutes ? minutes : 1.0 / minutes);
  for (std::size_t i = 0; i < rows.wanted_mm.size(); ++i) {
    const double along = rows.position_mm[i];
    const double programmed = profile.programmed_mm(along) + rows.wanted_mm[i];
    put(text, "{}C{:.6f} X{:.6f} Z{:.6f}{}\n", i == 0 ? "G1 " : "", rows.c_rad[i] / rad_per_deg,
        scale * (face ? along : programmed), face ? programmed : along, feed);
  }
  text += "G94\n" + table.tail;
  const double rounding_mm = 0.5 * unit_mm / (face ? 1.0 : scale);
  return {std::move(text), rounding_mm, largest_between_mm(correction, profile) + rounding_mm};
}

}  // namespace trueaxis

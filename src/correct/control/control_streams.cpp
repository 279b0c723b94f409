// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "correct/control/as_read.hpp"
#include "correct/control/control_table.hpp"
#include "correct/profile.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

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
      "# cfg=ff: {}_command in um ({}), C in degrees; {} lines per revolution at {:.6g} rpm; the "
      "last line twice\n",
      face ? "Z" : "X", correction.actuator.precompensate ? "precompensated" : "as wanted",
      correction.tool.rows_per_revolution, correction.tool.speed_rpm);
  const std::size_t count = rows.command_mm.size();
  text.reserve(text.size() + 24 * count);
  for (std::size_t i = 0; i <= count; ++i) {
    const std::size_t row = std::min(i, count - 1);
    put(text, "{:.6f} {:.6f}\n", rows.command_mm[row] / mm_per_um, rows.c_rad[row] / rad_per_deg);
  }
  const Deviation off = halstreamer_as_read(correction, text);
  return {std::move(text), 0.5 * unit_mm, off};
}

MadeControlTable servo_nc(const Correction& correction, const ControlTable& table) {
  constexpr double unit_mm = 1e-6;
  const CorrectionRows& rows = correction.rows;
  const Profile profile = profile_of(correction);
  const bool face = correction.target.kind == TargetKind::face;
  const double minutes = 1.0 / (correction.tool.speed_rpm * correction.tool.rows_per_revolution);
  const double scale = table.x_is_diameter ? 2.0 : 1.0;
  std::string text = "( schema: trueaxis.servo_nc/1 )\n";
  put(text,
      "( X IS A {}, OF THE CENTRE OF THE NOSE, POSITIVE AWAY FROM THE AXIS; X AND Z IN MM )\n"
      "( C IN DEGREES, RUNNING, AS PROBED; F IN {} )\n",
      table.x_is_diameter ? "DIAMETER" : "RADIUS",
      table.minutes ? "MINUTES A BLOCK" : "BLOCKS A MINUTE");
  std::string blocks;
  const auto put_block = [&](std::size_t row, const char* before, const std::string& f) {
    const double along = rows.position_mm[row];
    const double depth = profile.programmed_mm(along) + rows.wanted_mm[row];
    put(blocks, "{}C{:.6f} X{:.6f} Z{:.6f}{}\n", before, rows.c_rad[row] / rad_per_deg,
        scale * (face ? along : depth), face ? depth : along, f);
  };
  put_block(0, "( BEFORE THE NEXT BLOCK THE CENTRE OF THE NOSE MUST BE AT ", " )");
  put(blocks,
      "( FROM ELSEWHERE THE NEXT BLOCK FEEDS THERE, IN MM A MINUTE AT THE FEED OF THE CUT )\n");
  put(blocks, "G94\n");
  put_block(0, "G1 ", feed_word(correction.tool.feed_mm_per_rev * correction.tool.speed_rpm));
  put(blocks, "G93\n");
  const std::string feed = feed_word(table.minutes ? minutes : 1.0 / minutes);
  for (std::size_t i = 1; i < rows.wanted_mm.size(); ++i) put_block(i, "", feed);
  blocks += "G94\n";
  const double rounding_mm = 0.5 * unit_mm / (face ? 1.0 : scale);
  const Deviation off = servo_as_read(correction, table, blocks);
  // A control wants the lines % and O before all others.
  std::size_t first = 0;
  for (const char line : {'%', 'O'})
    if (first < table.head.size() && table.head[first] == line)
      first = std::min(table.head.find('\n', first), table.head.size() - 1) + 1;
  return {table.head.substr(0, first) + text + table.head.substr(first) + blocks + table.tail,
          rounding_mm, off};
}

}  // namespace trueaxis

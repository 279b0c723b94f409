// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <limits>
#include <string_view>

namespace trueaxis::nc {

enum class Motion : std::uint8_t { none, rapid, feed, arc_clockwise, arc_counterclockwise };
enum class Plane : std::uint8_t { xy, zx, yz };
enum class FeedMode : std::uint8_t { per_minute, inverse_time, per_revolution };
/// What the control does with the tool's length: nothing (G49), adds it along the tool's axis
/// (G43), or moves the tip where the words say (G43.4).
enum class LengthOffset : std::uint8_t { none, along_axis, tip };

constexpr bool is_arc(Motion motion) { return motion >= Motion::arc_clockwise; }

/// What stays in force from block to block, positions apart. As a control starts: G21 G90 G54 G94
/// G17 G49, no motion.
struct ModalState {
  Motion motion = Motion::none;
  Plane plane = Plane::xy;
  FeedMode feed_mode = FeedMode::per_minute;
  LengthOffset length = LengthOffset::none;
  bool inch = false, incremental = false;
  std::uint8_t cycle = 0;        ///< canned cycle: 81, 82, 83; 0: none
  bool back_to_r = false;        ///< G99, else G98
  std::uint8_t work_offset = 0;  ///< 0: G54 … 5: G59
  int tool = 0;                  ///< in the spindle, by T N M6; 0: none was put in
  double feed = std::numeric_limits<double>::quiet_NaN();  ///< the last F, as written
  bool operator==(const ModalState&) const = default;
};

/// G codes in tenths: G43.4 is 434.
inline constexpr int g_dwell = 40, g_home = 280, g_second_home = 300, g_machine = 530;

/// Groups of G codes of which a block has one at most, as ISO 6983 has them.
enum class Group : std::uint8_t {
  none,
  motion,
  plane,
  feed_mode,
  units,
  distance,
  cutter,
  length,
  work_offset,
  path,
  cycle,
  retract,
  once
};

/// The group of a G code that is read; `none` for any other.
Group group_of(int g_tenths);

/// Whether it is a drilling cycle that is read: G81, G82, G83.
constexpr bool is_cycle(int g_tenths) {
  return g_tenths == 810 || g_tenths == 820 || g_tenths == 830;
}

/// Why a G code is not read and what to do; "" where there is no more to say.
std::string_view why_not_g(int g_tenths);

/// The same of an M code that hides moves or blocks; "" for one that is read.
std::string_view why_not_m(int m);

/// Why M47, M96 and M99 P are not read.
inline constexpr std::string_view jump =
    "goes on at another block: write the blocks in the order in which they are carried out";

/// M codes that act after the block's move on every control: M0 M1 M2 M30 M60 M99.
bool stops(int m);
/// M codes that switch on before or with the block's move and may occur twice: M3 M4 M7 M8. (Off,
/// M5 and M9, is after the move by ISO 6983-1 and before it on LinuxCNC.)
bool starts(int m);

/// Puts a G code that is read into force.
void apply_g(ModalState& state, int g_tenths);

}  // namespace trueaxis::nc

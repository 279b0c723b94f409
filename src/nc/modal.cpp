// SPDX-License-Identifier: Apache-2.0
#include "nc/modal.hpp"

#include <array>

namespace trueaxis::nc {
namespace {

constexpr std::string_view canned =
    "is a canned cycle that is not read (G81, G82 and G83 are): write its moves as G0 and G1";
constexpr std::string_view cutter =
    "moves the path by the cutter's radius: post the path of the tool's centre with G40";
constexpr std::string_view zero =
    "moves the zero: put it into [workpiece] of the machine and use G54 to G59";
constexpr std::string_view turned =
    "turns the frame of the words: put it into [workpiece] as rotation_deg";
constexpr std::string_view macro = "calls blocks in another place: write them out";

struct Code {
  int tenths;
  Group group;
};
constexpr std::array codes = {
    Code{0, Group::motion},        Code{10, Group::motion},       Code{20, Group::motion},
    Code{30, Group::motion},       Code{g_dwell, Group::once},    Code{170, Group::plane},
    Code{180, Group::plane},       Code{190, Group::plane},       Code{200, Group::units},
    Code{210, Group::units},       Code{g_home, Group::once},     Code{g_second_home, Group::once},
    Code{400, Group::cutter},      Code{430, Group::length},      Code{434, Group::length},
    Code{490, Group::length},      Code{g_machine, Group::once},  Code{540, Group::work_offset},
    Code{550, Group::work_offset}, Code{560, Group::work_offset}, Code{570, Group::work_offset},
    Code{580, Group::work_offset}, Code{590, Group::work_offset}, Code{610, Group::path},
    Code{640, Group::path},        Code{800, Group::cycle},       Code{900, Group::distance},
    Code{810, Group::cycle},       Code{820, Group::cycle},       Code{830, Group::cycle},
    Code{980, Group::retract},     Code{990, Group::retract},     Code{910, Group::distance},
    Code{930, Group::feed_mode},   Code{940, Group::feed_mode},   Code{950, Group::feed_mode}};

}  // namespace

Group group_of(int g_tenths) {
  for (const Code& code : codes)
    if (code.tenths == g_tenths) return code.group;
  return Group::none;
}

std::string_view why_not_g(int g_tenths) {
  const int whole = g_tenths / 10;
  if (whole == 41 || whole == 42) return cutter;
  if (whole == 10 || whole == 52 || whole == 92) return zero;
  if (whole == 68 || whole == 69) return turned;
  if (whole == 73 || whole == 74 || whole == 76 || (whole >= 81 && whole <= 89)) return canned;
  if (whole >= 65 && whole <= 67) return macro;
  if (whole == 59 || whole == 54) return "is a work offset that is not known here: use G54 to G59";
  return "";
}

std::string_view why_not_m(int m) {
  if (m == 47 || m == 96) return jump;
  if (m == 128 || m == 129)
    return "makes X Y Z the tip on HEIDENHAIN (TCPM): write G43.4 or G49, or remove it and state "
           "mode = "
           "\"tip\"";
  if (m == 61) return "says which tool is in the spindle: write T and M6";
  if (m >= 70 && m <= 73) return "may save or restore G codes: write the codes themselves";
  return m == 97 || m == 98 || m == 198 ? macro : "";
}

bool stops(int m) { return m <= 2 || m == 30 || m == 60 || m == 99; }
bool starts(int m) { return m == 3 || m == 4 || m == 7 || m == 8; }

void apply_g(ModalState& state, int g_tenths) {
  switch (group_of(g_tenths)) {
    case Group::motion:
      state.motion = static_cast<Motion>(g_tenths / 10 + 1);
      state.cycle = 0;
      break;
    case Group::plane:
      state.plane = static_cast<Plane>(g_tenths / 10 - 17);
      break;
    case Group::feed_mode:
      state.feed_mode = g_tenths == 930   ? FeedMode::inverse_time
                        : g_tenths == 940 ? FeedMode::per_minute
                                          : FeedMode::per_revolution;
      break;
    case Group::units:
      state.inch = g_tenths == 200;
      break;
    case Group::distance:
      state.incremental = g_tenths == 910;
      break;
    case Group::length:
      state.length = g_tenths == 430   ? LengthOffset::along_axis
                     : g_tenths == 434 ? LengthOffset::tip
                                       : LengthOffset::none;
      break;
    case Group::cycle:
      // Controls differ in what goes on after G80: the motion must be given.
      if (g_tenths == 800 && state.cycle != 0) state.motion = Motion::none;
      state.cycle = static_cast<std::uint8_t>(g_tenths == 800 ? 0 : g_tenths / 10);
      break;
    case Group::retract:
      state.back_to_r = g_tenths == 990;
      break;
    case Group::work_offset:
      state.work_offset = static_cast<std::uint8_t>(g_tenths / 10 - 54);
      break;
    default:
      break;
  }
}

}  // namespace trueaxis::nc

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>

#include <iterator>
#include <string>
#include <utility>

#include "trueaxis/control_table.hpp"

namespace trueaxis {

/// Appends what fmt makes of it.
template <class... T>
void put(std::string& text, fmt::format_string<T...> form, T&&... values) {
  fmt::format_to(std::back_inserter(text), form, std::forward<T>(values)...);
}

// One a format. What the control does with the numbers is that of its maker's manual, named there.

/// `C[deg]\Z[mm]` and a column for every position, then a row for every angle, µm.
MadeControlTable grid_csv(const Correction& correction, const ControlTable& table);
/// LinuxCNC halstreamer(1): blank-separated columns X_command in µm and C in degrees (cfg=ff), a
/// line a sample; lines with '#' are skipped. The last line is there twice, as halstreamer may hold
/// back the last of a multiple of its depth.
MadeControlTable halstreamer_text(const Correction& correction);
/// Blocks `C X Z`, C running, six decimals, one point a block under G93.
MadeControlTable servo_nc(const Correction& correction, const ControlTable& table);
/// SINUMERIK interpolatory compensation ($AN_CEC), a table of one turn for each band.
MadeControlTable sinumerik_cec(const Correction& correction, const ControlTable& table);
/// Beckhoff TwinCAT CNC and ISG plane compensation (kw.crosscomp2), integers of 0.1 µm.
MadeControlTable beckhoff_crosscomp2(const Correction& correction, const ControlTable& table);

}  // namespace trueaxis

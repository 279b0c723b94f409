// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <complex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "simulate/machine/block_words.hpp"
#include "trueaxis/machine.hpp"

namespace trueaxis::virtual_machine {

/// An arc in a plane of two of X Y Z, as complex numbers first + i second. It is of positions of
/// the axes, or of the tip. What lies across the plane, and every rotary axis, goes evenly with the
/// angle.
struct ArcWay {
  std::size_t first = 0, second = 1;  ///< G17: X Y, G18: Z X, G19: Y Z
  std::complex<double> centre_mm;
  double turn_rad = 0.0;  ///< from the first towards the second axis

  std::complex<double> in_plane(const Vector3& point) const {
    return {point[first], point[second]};
  }
  /// `even`, which went evenly, put on the arc from `from` to `to`; their distances from the centre
  /// pass into each other.
  Vector3 put_on_arc(Vector3 even, const Vector3& from, const Vector3& to, double share) const;
  double length_mm(const Vector3& from) const;
};

/// The arc of G2 (`clockwise`) or G3 by I J K from its start, or R (negative: more than half a
/// turn). Nothing where the words make none.
std::optional<ArcWay> arc_of(const BlockWords& block, double unit_mm, int plane, bool clockwise,
                             const Vector3& from, const Vector3& to);

/// A move that the control makes of a block. Its way is that of the nominal machine, which
/// is the only one that a control knows.
struct ControlMove {
  std::size_t line = 0;
  bool rapid = false;
  bool leaves = false;  ///< G28 G30 G53: away from the part, to where the machine's own zero says
  /// If no block of the program said where it begins: at its start, after `leaves` and a tool
  /// change.
  bool begins_anew = false;
  bool along_tip = false;  ///< the tip goes evenly (mode tip), else every axis does
  AxisPositions from{}, to{};
  Setting setting;  ///< program frame and tool that are in force
  double start_s = 0.0, duration_s = 0.0;
  std::optional<ArcWay> arc;  ///< of the axes, or of the tip where it goes evenly
  BlockWords words;
};

/// Carries out a program of ISO 6983 words block by block, as a control with a machine of this file
/// does. Words that are not given leave an axis where it is, in mode tip the tip where it is; after
/// G43, G43.4, G49 and another work offset nothing moves until a word says so. G28 and G30 take the
/// axes that are named (all, where none is) to 0, G53 takes words for positions of the axes. At
/// first all axes are at 0, or where [program] start of the machine says. A rapid move has 10 000
/// mm/min or °/min; F of a move without a way of the tip counts in degrees; dwells have s. @throws
/// InputError with all that this control cannot do, each with its line
std::vector<ControlMove> moves_of_program(const Machine& machine, std::string_view program,
                                          const std::string& file);

/// The axes on the way of a move, 0 ≤ share ≤ 1.
AxisPositions axes_on_way(const Machine& machine, const ControlMove& move, double share);

}  // namespace trueaxis::virtual_machine

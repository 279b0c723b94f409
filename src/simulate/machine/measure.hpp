// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "simulate/machine/bodies.hpp"

namespace trueaxis::virtual_machine {

enum class MeasurementKind {
  ball,   ///< a ball on the table, probed at positions of the rotary axes
  bar,    ///< the length between a ball on the table and one in the spindle
  array,  ///< balls along a straight bar on the table, probed one after the other
  axis    ///< commanded against actual position of one axis
};

/// What goes wrong while measuring or cutting and is not an error of the machine's geometry.
struct Disturbance {
  AxisPositions reversal{};    ///< what an axis loses when it is approached from above, mm or rad
  Vector3 drift_mm_per_s{};    ///< of the ball or the part against the tip, linear in time
  Vector3 slip_mm{};           ///< of the ball on the table …
  std::size_t slip_after = 0;  ///< … after so many rows; 0: never
};

struct MeasurementPlan {
  MeasurementKind kind = MeasurementKind::ball;
  std::uint64_t seed = 1;
  double noise_mm = 0.0;  ///< standard deviation of what is read, each coordinate
  double tool_length_mm = 0.0;
  std::vector<Vector3>
      balls_mm;  ///< centres on the table, in M, zero position; of an array all of them
  std::vector<AxisPositions> positions;  ///< rotary axes; of kind axis: the one that is read
  std::vector<Vector3> bar_mm;  ///< kind bar: from the ball to the tip, in M; at every position all
  AxisName axis = AxisName::X;  ///< kinds array and axis
  double pace_s = 10.0;
  bool centred = false;  ///< kind ball: the linear axes are moved until d = 0 and then read
  Disturbance disturbance;
};

/// A row of a measurement: which of its columns are there follows from the kind.
struct MeasuredRow {
  int setup = 1, ball = 1;
  AxisPositions axes{};
  Vector3 deviation_mm{};  ///< ball centre − tip, in machine axes
  double length_mm = 0.0;  ///< kind bar
  double along_mm = 0.0;   ///< kind array: s
  double actual = 0.0;     ///< kind axis: mm or rad
  double time_s = 0.0;
};

/// What the machine with these errors would read, in order.
/// @throws InputError if the linear axes cannot follow a ball (they do not span space).
std::vector<MeasuredRow> measure(const Machine& machine, const ErrorModel& errors,
                                 const MeasurementPlan& plan);

}  // namespace trueaxis::virtual_machine

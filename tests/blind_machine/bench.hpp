// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "simulate/machine/bodies.hpp"

/// A blind study of the diagnosis of machines: what is measured, and what the virtual machine reads
/// of it. Nothing here calls `machine` or `calibrate`.
namespace trueaxis::blind_machine {

/// The machines of the study by name, each with the range of its rotary axes.
struct Layout {
  std::string name;
  Machine machine;
  std::vector<double> first_rad;  ///< five positions of the rotary axis that does not go round
  AxisName first = AxisName::A, round = AxisName::C;
};
const std::vector<Layout>& layouts();

/// One reading: where the axes are commanded to, at which ball, with which tool.
struct Visit {
  int ball = 1;
  Vector3 centre_mm{};  ///< of the ball in M, zero position
  double tool_mm = 0.0;
  AxisPositions axes{};
  double time_s = 0.0;
};
struct Plan {
  std::string name;
  bool bar = false;  ///< lengths, not deviations
  double noise_mm = 0.0;
  std::vector<Visit> visits;

  std::size_t numbers() const { return bar ? 1 : 3; }  ///< read at a visit
};
inline constexpr double pace_s = 6.0;

/// ball: one ball, five by twelve positions, and back; balls: two balls, two tools; eighths: every
/// 45°, two tools, and back; bar: four directions of a bar of 100 mm.
std::vector<std::string> plan_names();
Plan plan_of(const std::string& name, const Layout& layout, std::uint64_t seed);

/// What is wrong with the machine while it is measured.
struct Fault {
  ErrorModel errors;
  AxisPositions reversal{};  ///< how much too high an axis is that came from above
  Vector3 drift_mm{};        ///< of the tip in M from the first visit to the last
  double end_s = 0.0;        ///< of the visits that the drift is over
  Vector3 slip_mm{};
  std::size_t slip_at = 0;  ///< the visit, from 1 on
  /// Component errors of one visit alone, in addition to `errors`.
  std::function<std::vector<ErrorTerm>(const Visit&)> of_visit;
};

/// What the virtual machine reads without noise, mm: deviations or lengths, visit by visit.
std::vector<double> readings(const Machine& machine, const Plan& plan, const Fault& fault);

/// The linear axes that put the tip of the nominal machine `apart_mm` from the ball.
AxisPositions following(const Machine& machine, Visit visit, const Vector3& apart_mm);

}  // namespace trueaxis::blind_machine

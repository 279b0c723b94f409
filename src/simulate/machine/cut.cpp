// SPDX-License-Identifier: Apache-2.0
#include "simulate/machine/cut.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "simulate/machine/nominal_path.hpp"

namespace trueaxis::virtual_machine {
namespace {

constexpr double not_said = std::numeric_limits<double>::quiet_NaN();

double angle_rad(const Vector3& a, const Vector3& b) {
  // Of unit vectors: their difference and sum are the legs of a right angle.
  Vector3 difference, sum;
  for (std::size_t i = 0; i < 3; ++i) difference[i] = a[i] - b[i], sum[i] = a[i] + b[i];
  return 2.0 * std::atan2(std::hypot(difference[0], difference[1], difference[2]),
                          std::hypot(sum[0], sum[1], sum[2]));
}

/// From the straight line between two points.
double off_line_mm(const Vector3& point, const Vector3& from, const Vector3& to) {
  double along = 0.0, length = 0.0;
  for (std::size_t i = 0; i < 3; ++i) {
    along += (point[i] - from[i]) * (to[i] - from[i]);
    length += (to[i] - from[i]) * (to[i] - from[i]);
  }
  const double share = length > 0.0 ? std::fmin(std::fmax(along / length, 0.0), 1.0) : 0.0;
  Vector3 foot;
  for (std::size_t i = 0; i < 3; ++i) foot[i] = std::lerp(from[i], to[i], share);
  return distance_mm(point, foot);
}

void take(LargestOff& largest, double value, std::size_t line) {
  if (value > largest.value) largest = {value, line};
}

class Cutting {
 public:
  Cutting(const Machine& machine, const ErrorModel& errors, const CutPlan& plan)
      : machine_(machine), errors_(errors), plan_(plan) {}

  Cut make() {
    const auto moves = moves_of_program(machine_, plan_.program, plan_.program_file);
    const auto nominal = moves_of_program(machine_, plan_.nominal, plan_.nominal_file);
    const auto nominal_of = nominal_moves_of(machine_, moves, nominal, plan_.program_file);
    out_.blocks = moves.size();
    for (std::size_t i = 0; i < moves.size(); ++i) {
      const std::size_t j = nominal_of[i];
      const bool ends_block = i + 1 == moves.size() || nominal_of[i + 1] != j;
      carry_out(moves[i], nominal[j], ends_block);
    }
    return std::move(out_);
  }

 private:
  void carry_out(const ControlMove& move, const ControlMove& nominal, bool ends_block) {
    take_lost_motion(plan_.disturbance.reversal, move.from, move.to, beside_.lost);
    const Vector3 from = tool_in_part(machine_, {}, nominal.from, nominal.setting).tip_mm;
    const ToolInPart to = tool_in_part(machine_, {}, nominal.to, nominal.setting);
    const bool path_is_said = !nominal.leaves && !nominal.begins_anew && !nominal.rapid;
    if (path_is_said)
      take(out_.off_between, off_line_mm(row_at(move, 0.0).tool.tip_mm, from, to.tip_mm),
           nominal.line);
    const std::size_t pieces = pieces_of(move);
    for (std::size_t k = 1; k <= pieces; ++k) {
      const bool end = k == pieces;
      CutRow row = row_at(move, end ? 1.0 : static_cast<double>(k) / static_cast<double>(pieces));
      row.end = end && ends_block;
      row.off_mm = row.angle_rad = not_said;
      if (path_is_said) {
        row.off_mm = off_line_mm(row.tool.tip_mm, from, to.tip_mm);
        take(out_.off_between, row.off_mm, nominal.line);
      }
      if (row.end && !nominal.leaves) judge_end(row, to, nominal.line);
      out_.rows.push_back(row);
    }
    out_.time_s = move.start_s + move.duration_s;
  }

  void judge_end(CutRow& row, const ToolInPart& nominal, std::size_t line) {
    row.off_mm = distance_mm(row.tool.tip_mm, nominal.tip_mm);
    row.angle_rad = angle_rad(row.tool.direction, nominal.direction);
    take(out_.off_at_ends, row.off_mm, line);
    take(out_.angle_at_ends, row.angle_rad, line);
    ++out_.judged_ends;
  }

  std::size_t pieces_of(const ControlMove& move) const {
    double pieces = 1.0;
    for (std::size_t k = 0; k < axis_count && !move.rapid; ++k) {
      const auto& step = k < 3 ? plan_.step_mm : plan_.step_rad;
      if (step) pieces = std::fmax(pieces, std::ceil(std::fabs(move.to[k] - move.from[k]) / *step));
    }
    return static_cast<std::size_t>(pieces);
  }

  CutRow row_at(const ControlMove& move, double share) {
    CutRow row;
    row.line = move.line;
    row.time_s = move.start_s + share * move.duration_s;
    for (std::size_t i = 0; i < 3; ++i)
      beside_.part_drift_mm[i] = plan_.disturbance.drift_mm_per_s[i] * row.time_s;
    const AxisPositions axes = share == 1.0 ? move.to : axes_on_way(machine_, move, share);
    row.tool = tool_in_part(machine_, errors_, axes, move.setting, beside_);
    return row;
  }

  const Machine& machine_;
  const ErrorModel& errors_;
  const CutPlan& plan_;
  BesideCommand beside_;
  Cut out_;
};

}  // namespace

Cut cut(const Machine& machine, const ErrorModel& errors, const CutPlan& plan) {
  return Cutting(machine, errors, plan).make();
}

}  // namespace trueaxis::virtual_machine

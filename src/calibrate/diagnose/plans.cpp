// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <optional>
#include <ranges>

#include "calibrate/diagnose/advise.hpp"
#include "machine/screw.hpp"
#include "math/linear_algebra.hpp"

namespace trueaxis::calibrate_detail {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double seconds_a_position = 6.0, longer_tool_mm = 70.0, further_ball_mm = 60.0;

/// One position of a plan, in place of a row of the data.
struct Position {
  AxisPositions axes{};
  double tool_length_mm = 0.0;
  Vector3d ball = Vector3d::Zero();
  int ball_number = 1;
  Vector3d apart = Vector3d::Zero();  ///< ball − tip that is wanted, in M
};

class Planner {
 public:
  Planner(const Problem& problem, std::span<const MachineMeasurement> data,
          const ErrorModel& errors, const VectorXd& places)
      : problem_(problem), data_(data.begin(), data.end()), model_(*problem.machine, errors) {
    for (const Row& row : problem.rows) {
      if (row.read_out || row.kind == MeasurementKind::array) continue;
      if (rows_.empty()) file_ = row.file;
      if (row.file != file_) continue;
      rows_.push_back(&row);
      const double* const place = places.data() + problem.targets[row.target].first;
      positions_.push_back({row.axes, row.tool_length_mm,
                            problem.targets[row.target].point(place, 0.0),
                            problem.targets[row.target].ball, Vector3d::Zero()});
      positions_.back().apart = apart(positions_.back());
    }
  }

  std::vector<Plan> plans() {
    std::vector<Plan> out;
    if (rows_.empty()) return out;
    auto reversed = positions_;
    std::ranges::reverse(reversed);
    out.push_back(made("RV", "the same positions in reverse order", 1.0, reversed));
    if (problem_.machine->linear_count() != 3) return out;
    auto longer = positions_;
    for (Position& one : longer) one.tool_length_mm += longer_tool_mm;
    out.push_back(made("L2", "the same positions with a tool 70 mm longer", 5.0, followed(longer)));
    out.push_back(made("B2", "the same rotary positions with a ball 60 mm off in radius and height",
                       10.0, followed(with_further_ball())));
    auto grid = rotary_grid();
    if (!grid.empty())
      out.push_back(made("AC",
                         "a grid of " + std::to_string(grid.size()) +
                             " rotary positions: five of one axis by every 30 deg of the other",
                         2.0, followed(grid)));
    return out;
  }

  /// The grid and back from nothing but a ball's place.
  Plan from_nothing(double noise_mm) {
    auto grid = rotary_grid();
    for (Position& one : grid) one.apart = Vector3d::Zero();
    grid = followed(grid);
    const auto there = grid;
    grid.insert(grid.end(), there.rbegin(), there.rend());
    data_.clear();
    data_.emplace_back();
    data_.front().source = "plan B1";
    Plan out = made("B1",
                    fmt::format("a ball at a grid of {} rotary positions and back, read with a "
                                "noise of {:.3g} µm",
                                there.size(), noise_mm / mm_per_um),
                    10.0, grid);
    MachineMeasurement& file = out.data.front();
    file.noise_mm = noise_mm;
    for (std::size_t i = 0; i < file.rows(); ++i)
      file.time_s.push_back(seconds_a_position * static_cast<double>(i));
    return out;
  }

 private:
  Vector3d apart(const Position& at) const {
    const ChainEnds ends = actual_ends(model_.compiled(), at.axes);
    Setting setting;
    setting.tool_length_mm = at.tool_length_mm;
    return ends.workpiece * at.ball - ends.tool * model_.compiled().tip(setting);
  }

  /// The linear axes so that ball and tip are apart as wanted; the chain is linear in them but for
  /// errors.
  std::vector<Position> followed(std::vector<Position> list) const {
    for (Position& one : list)
      for (int step = 0; step < 2; ++step) {
        const Vector3d off = apart(one) - one.apart;
        Matrix3d slope;
        for (std::size_t k = 0; k < 3; ++k) {
          Position moved = one;
          moved.axes[k] += 1.0;
          slope.col(static_cast<Eigen::Index>(k)) = apart(moved) - one.apart - off;
        }
        const Vector3d move = linear::solve(slope, off);
        for (std::size_t k = 0; k < 3; ++k) one.axes[k] -= move[static_cast<Eigen::Index>(k)];
      }
    return list;
  }

  const MachineAxis* rotary(std::size_t which) const {
    for (const MachineAxis& axis : problem_.machine->axes)
      if (is_rotary(axis.name) && which-- == 0) return &axis;
    return nullptr;
  }

  std::vector<Position> with_further_ball() const {
    auto list = positions_;
    int number = 0;
    for (const Position& one : list) number = std::max(number, one.ball_number);
    Vector3d up = Vector3d::UnitZ(), point = Vector3d::Zero();
    if (const MachineAxis* const axis = rotary(0)) {
      up = rigid::eigen(axis->direction);
      point = rigid::eigen(axis->point_mm);
    }
    const Vector3d first = list.front().ball, from = first - point;
    Vector3d out = from - up * up.dot(from);
    if (!(out.norm() > 1.0)) out = up.unitOrthogonal();
    for (Position& one : list) {
      one.ball = first + further_ball_mm * (out.normalized() + up);
      one.ball_number = number + 1;
    }
    return list;
  }

  std::vector<Position> rotary_grid() const {
    const MachineAxis *const inner = rotary(0), *const outer = rotary(1);
    if (inner == nullptr) return {};
    const auto span = [&](const MachineAxis& axis, double half) {
      const AxisRange range = axis_range(problem_, axis.name);
      return std::pair{std::max(axis.low, std::min(range.low, -half)),
                       std::min(axis.high, std::max(range.high, half))};
    };
    const auto [low, high] = span(*inner, std::numbers::pi);
    const auto [from, to] = outer ? span(*outer, 0.5 * std::numbers::pi) : std::pair{0.0, 0.0};
    std::vector<Position> grid;
    for (int k = 0; k < (outer ? 5 : 1); ++k)
      for (double at = low; at < high - 1e-9 || at == low; at += two_pi / 12.0) {
        Position one = positions_.front();
        one.axes[index_of(inner->name)] = at;
        if (outer) one.axes[index_of(outer->name)] = from + 0.25 * k * (to - from);
        grid.push_back(one);
      }
    return grid;
  }

  Plan made(const char* code, const std::string& what, double set_up_minutes,
            const std::vector<Position>& positions) const {
    Plan out;
    out.plan.code = code;
    out.plan.what = what;
    out.plan.minutes =
        set_up_minutes + seconds_a_position / 60.0 * static_cast<double>(positions.size());
    out.data = data_;
    for (const Row& row : problem_.rows)
      if (row.read_out) out.data[row.file].noise_mm = row.sigma_mm;
    MachineMeasurement& file = out.data[file_];
    out.plan.kind = file.kind;
    file.noise_mm = rows_.front()->sigma_mm;
    const double step_s = file.time_s.size() > 1 ? (file.time_s.back() - file.time_s.front()) /
                                                       static_cast<double>(file.time_s.size() - 1)
                                                 : 0.0;
    if (file.tool_length_mm.empty())
      file.tool_length_mm.assign(file.rows(), problem_.machine->tool.length_mm);
    for (const Position& one : positions) {
      const int setup = file.setup.empty() ? 1 : file.setup.front();
      out.plan.visits.push_back(
          {setup, one.ball_number, rigid::array(one.ball), one.tool_length_mm, one.axes});
      file.axes.push_back(one.axes);
      file.setup.push_back(setup);
      file.ball.push_back(one.ball_number);
      file.tool_length_mm.push_back(one.tool_length_mm);
      if (!file.time_s.empty()) file.time_s.push_back(file.time_s.back() + step_s);
      if (file.kind == MeasurementKind::ball) file.deviation_mm.push_back(rigid::array(one.apart));
      if (file.kind == MeasurementKind::bar) file.length_mm.push_back(one.apart.norm());
    }
    return out;
  }

  const Problem& problem_;
  std::vector<MachineMeasurement> data_;
  MachineModel model_;
  std::size_t file_ = 0;
  std::vector<const Row*> rows_;
  std::vector<Position> positions_;
};

/// RV of a read-out: its positions again, in reverse order.
Plan reversed_read_out(const Problem& problem, std::span<const MachineMeasurement> data,
                       std::size_t number) {
  Plan out;
  out.data.assign(data.begin(), data.end());
  for (const Row& row : problem.rows) out.data[row.file].noise_mm = row.sigma_mm;
  MachineMeasurement& file = out.data[number];
  const std::string letter(1, letter_of(*file.axis));
  out.plan.code = data.size() == 1 ? "RV" : "RV" + std::to_string(number + 1);
  out.plan.what = "the same positions of " + letter + " in reverse order" +
                  (data.size() == 1 ? "" : ", added to " + file.source);
  out.plan.kind = MeasurementKind::axis;
  out.plan.axis = file.axis;
  out.plan.minutes = 1.0 + seconds_a_position / 60.0 * static_cast<double>(file.rows());
  const std::vector<AxisPositions> there = file.axes;
  for (std::size_t i = there.size(); i-- > 0;) {
    file.axes.push_back(there[i]);
    file.actual.push_back(there[i][index_of(*file.axis)]);
    out.plan.visits.push_back({1, 0, {}, 0.0, there[i]});
    if (file.time_s.empty()) continue;
    const double past = i + 1 < there.size() ? file.time_s[i + 1] - file.time_s[i] : 0.0;
    file.time_s.push_back(file.time_s.back() + past);
  }
  return out;
}

}  // namespace

std::optional<Plan> first_plan(const Machine& machine, const ErrorModel& errors, double noise_mm) {
  if (machine.linear_count() != 3 || machine.rotary_count() == 0) return std::nullopt;
  // The place of the grid's ball: 80 mm off the line of the first rotary axis and 60 mm up along
  // it.
  MachineMeasurement seed;
  const auto axis = std::ranges::find_if(
      machine.axes, [](const MachineAxis& one) { return is_rotary(one.name); });
  const Vector3d up = rigid::eigen(axis->direction);
  const Vector3d ball = rigid::eigen(axis->point_mm) + 80.0 * up.unitOrthogonal() + 60.0 * up;
  const MachineModel model(machine, errors);
  for (const double apart : {0.0, 1.0}) {
    AxisPositions axes{};
    for (std::size_t k = 0; k < axis_count; ++k) {
      const MachineAxis* const one = machine.find(static_cast<AxisName>(k));
      if (one != nullptr) axes[k] = std::clamp(k < 3 ? apart : 0.0, one->low, one->high);
    }
    const ChainEnds ends = actual_ends(model.compiled(), axes);
    Setting setting;
    setting.tool_length_mm = machine.tool.length_mm;
    seed.axes.push_back(axes);
    seed.setup.push_back(1);
    seed.ball.push_back(1);
    seed.deviation_mm.push_back(
        rigid::array(ends.workpiece * ball - ends.tool * model.compiled().tip(setting)));
  }
  const Problem problem = make_problem(machine, std::span(&seed, 1), errors);
  return Planner(problem, std::span(&seed, 1), errors, problem.start).from_nothing(noise_mm);
}

std::vector<Plan> plans_for(const Problem& problem, std::span<const MachineMeasurement> data,
                            const ErrorModel& errors, const VectorXd& places) {
  if (!problem.read_outs()) return Planner(problem, data, errors, places).plans();
  std::vector<Plan> out;
  for (std::size_t number = 0; number < data.size(); ++number)
    out.push_back(reversed_read_out(problem, data, number));
  return out;
}

}  // namespace trueaxis::calibrate_detail

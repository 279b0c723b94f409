// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "calibrate/estimate/place.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis::calibrate_detail {
namespace {

std::size_t target_of(Problem& problem, const MachineMeasurement& file, std::size_t number,
                      std::size_t row) {
  const bool line = file.kind == MeasurementKind::array;
  const int ball = line ? 0 : file.ball[row];
  const auto found = std::ranges::find_if(problem.targets, [&](const Target& t) {
    return t.file == number && t.setup == file.setup[row] && t.ball == ball;
  });
  if (found != problem.targets.end())
    return static_cast<std::size_t>(found - problem.targets.begin());
  Target target;
  target.file = number;
  target.setup = file.setup[row];
  target.ball = ball;
  target.line = line;
  target.first = problem.places;
  problem.places += target.unknowns();
  problem.targets.push_back(target);
  return problem.targets.size() - 1;
}

void add_rows(Problem& problem, const MachineMeasurement& file, std::size_t number) {
  for (std::size_t i = 0; i < file.rows(); ++i) {
    Row row;
    row.file = number;
    row.row = i;
    row.kind = file.kind;
    row.axes = file.axes[i];
    row.target = target_of(problem, file, number, i);
    row.tool_length_mm =
        file.tool_length_mm.empty() ? problem.machine->tool.length_mm : file.tool_length_mm[i];
    if (!file.time_s.empty()) row.time_s = file.time_s[i];
    if (file.kind == MeasurementKind::ball) row.observed = rigid::eigen(file.deviation_mm[i]);
    if (file.kind == MeasurementKind::bar) row.observed[0] = file.length_mm[i];
    if (file.kind == MeasurementKind::array) row.along_mm = file.along_mm[i];
    row.sigma_mm = file.noise_mm.value_or(unstated_noise_mm);
    row.first = problem.equations;
    problem.equations += row.equations();
    problem.rows.push_back(row);
  }
  problem.noise_stated = problem.noise_stated && file.noise_mm;
}

/// A ball wants two positions, of bars four to be placed by, a line three balls.
void check(const Problem& problem, std::span<const MachineMeasurement> data) {
  std::vector<Diagnostic> wrong;
  for (std::size_t t = 0; t < problem.targets.size(); ++t) {
    const Target& target = problem.targets[t];
    const MachineMeasurement& file = data[target.file];
    std::vector<std::vector<double>> different;
    for (const Row& row : problem.rows) {
      if (row.target != t) continue;
      std::vector<double> at(row.axes.begin(), row.axes.end());
      at.push_back(row.tool_length_mm);
      if (target.line) at = {row.along_mm};
      if (std::ranges::find(different, at) == different.end()) different.push_back(std::move(at));
    }
    const std::size_t needed = target.line ? 3 : file.kind == MeasurementKind::bar ? 4 : 2;
    if (different.size() >= needed) continue;
    const std::string setup = "setup " + std::to_string(target.setup);
    wrong.push_back({file.source, 0, 0,
                     target.line ? setup + " has " + std::to_string(different.size()) +
                                       " balls of the array: a line needs three"
                                 : "ball " + std::to_string(target.ball) + " of " + setup +
                                       " was measured at " + std::to_string(different.size()) +
                                       (different.size() == 1 ? " position" : " positions") +
                                       " only: they show only its own place; give " +
                                       std::to_string(needed) + " or more"});
  }
  if (!wrong.empty()) throw InputError(std::move(wrong));
}

}  // namespace

Problem gather(const Machine& machine, std::span<const MachineMeasurement> data) {
  Problem problem;
  problem.machine = &machine;
  for (std::size_t number = 0; number < data.size(); ++number)
    if (data[number].kind != MeasurementKind::axis) add_rows(problem, data[number], number);
  check(problem, data);
  problem.weights.resize(problem.equations);
  for (const Row& row : problem.rows)
    problem.weights.segment(row.first, row.equations()).setConstant(1.0 / row.sigma_mm);
  return problem;
}

}  // namespace trueaxis::calibrate_detail

// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "job/files/job_results.hpp"
#include "report/chart_readings.hpp"
#include "report/page_data.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

/// The rows [begin, end) of one revolution.
struct Turn {
  std::size_t begin = 0, end = 0;
};

std::vector<Turn> turns_of(const CorrectionRows& rows) {
  std::vector<Turn> turns;
  for (std::size_t i = 0; i < rows.revolution.size(); ++i) {
    if (i == 0 || rows.revolution[i] != rows.revolution[i - 1]) turns.push_back({i, i});
    turns.back().end = i + 1;
  }
  return turns;
}

Json turn_data(const CorrectionRows& rows, Turn turn) {
  std::vector<std::size_t> shown;
  const std::size_t step = std::max<std::size_t>(1, (turn.end - turn.begin) / 720);
  for (std::size_t row = turn.begin; row < turn.end; row += step) shown.push_back(row);
  const auto c_of = [&](std::size_t row) { return wrapped_deg(rows.c_rad[row]); };
  std::ranges::stable_sort(shown, {}, c_of);
  std::vector<double> c_deg, wanted, command;
  for (const std::size_t row : shown) {
    c_deg.push_back(c_of(row));
    wanted.push_back(rows.wanted_mm[row] / mm_per_um);
    command.push_back(rows.command_mm[row] / mm_per_um);
  }
  return {{"revolution", rows.revolution[turn.begin]},
          {"position_mm", rounded(rows.position_mm[turn.begin], 4)},
          {"c_deg", column(c_deg, 3)},
          {"wanted_um", column(wanted, 4)},
          {"command_um", column(command, 4)}};
}

/// First, middle and last complete revolution.
Json turns_data(const CorrectionRows& rows, std::vector<Turn> turns) {
  const auto length = [](Turn turn) { return turn.end - turn.begin; };
  std::size_t longest = 0;
  for (const Turn turn : turns) longest = std::max(longest, length(turn));
  std::erase_if(turns, [&](Turn turn) { return length(turn) < longest; });
  std::vector<std::size_t> shown{0, turns.size() / 2, turns.size() - 1};
  shown.erase(std::unique(shown.begin(), shown.end()), shown.end());
  return list_of(shown, [&](std::size_t i) { return turn_data(rows, turns[i]); });
}

Json map_data(const CorrectionRows& rows, std::size_t turns) {
  const Bins position = bins_over(rows.position_mm, std::clamp<std::size_t>(turns, 1, 60));
  CellMeans wanted(map_columns, position);
  for (std::size_t i = 0; i < rows.wanted_mm.size(); ++i) {
    wanted.add(wrapped_deg(rows.c_rad[i]), rows.position_mm[i], rows.wanted_mm[i] / mm_per_um);
  }
  return {{"columns", map_columns.count},
          {"rows", position.count},
          {"position_min_mm", position.low},
          {"position_max_mm", position.high},
          {"wanted_um", wanted.to_json(3)}};
}

}  // namespace

Json correction_data(const Correction& correction) {
  const std::vector<Turn> turns = turns_of(correction.rows);
  Json data = correction_object(correction);
  for (const char* as_data : {"broken", "remedies"}) data["margin"].erase(as_data);
  data["face"] = correction.target.kind == TargetKind::face;
  data["revolutions"] = turns.size();
  data["speed_rpm"] = correction.tool.speed_rpm;
  data["precompensated"] = correction.actuator.precompensate;
  data["turns"] = Json::array();
  if (turns.empty()) return data;
  data["turns"] = turns_data(correction.rows, turns);
  data["map"] = map_data(correction.rows, turns.size());
  return data;
}

}  // namespace trueaxis

// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <array>
#include <cmath>

#include "base/number.hpp"
#include "base/text.hpp"
#include "format/csv_text.hpp"
#include "format/file.hpp"
#include "simulate/files/scenario_files.hpp"
#include "trueaxis/error.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

constexpr std::string_view lateral_header = "rev,Z[mm],C[deg],X_fts[mm],X_command[mm]";
constexpr std::string_view face_header = "rev,X[mm],C[deg],Z_fts[mm],Z_command[mm]";
constexpr std::size_t most_diagnostics = 100;

/// Five finite numbers between commas; or the 1-based column that is wrong.
struct Row {
  std::array<double, 5> values{};
  std::size_t wrong_column = 0;
};

Row parse_row(std::string_view line) {
  Row row;
  std::string_view left = line;
  for (std::size_t i = 0; i < row.values.size(); ++i) {
    const std::size_t at = line.size() - left.size();
    const auto value = take_number<double>(left);
    const bool last = i + 1 == row.values.size();
    const bool closed = last ? left.empty() : take_word(left, ",");
    if (!value || !closed || !std::isfinite(*value)) {
      row.wrong_column = at + 1;
      return row;
    }
    row.values[i] = *value;
  }
  return row;
}

/// Running angle next to `before`, in the sense of the cut; a running column stays as it is.
double unwrapped(double c_rad, double before, int sense) {
  const double ahead = std::fmod(sense * (c_rad - before), two_pi);
  constexpr double backwards = -1e-9;  // rounding of equal angles is not a turn
  return before + sense * (ahead < backwards ? ahead + two_pi : ahead);
}

void append(const Row& row, int sense, virtual_lathe::CutTable& table) {
  const double c = row.values[2] * rad_per_deg;
  table.revolution.push_back(static_cast<int>(row.values[0]));
  table.position_mm.push_back(row.values[1]);
  table.c_rad.push_back(table.c_rad.empty() ? c : unwrapped(c, table.c_rad.back(), sense));
  table.wanted_mm.push_back(row.values[3]);
  table.command_mm.push_back(row.values[4]);
}

}  // namespace

virtual_lathe::CutTable parse_cut_table(std::string_view content, const std::string& path,
                                        int sense) {
  expects(sense == 1 || sense == -1, "sense of rotation +1 or -1");
  virtual_lathe::CutTable table;
  std::vector<Diagnostic> wrong;
  const auto complain = [&](std::size_t line, std::size_t column, std::string message) {
    if (wrong.size() < most_diagnostics) wrong.push_back({path, line, column, std::move(message)});
  };
  bool header = false;
  for_each_line(content, [&](std::string_view line, std::size_t number) {
    if (line.empty() || line.front() == '#') return;
    if (!header) {
      header = true;
      table.face = line == face_header;
      if (!table.face && line != lateral_header)
        complain(number, 1,
                 fmt::format("is not a header of a correction table: write {} or {}",
                             lateral_header, face_header));
    } else if (const Row row = parse_row(line); row.wrong_column != 0) {
      complain(number, row.wrong_column, "is not a number, or the row does not have five columns");
    } else if (std::floor(row.values[0]) != row.values[0] || std::abs(row.values[0]) > 1e9) {
      complain(number, 1, "is not a number of a revolution: write 0, 1, 2");
    } else {
      append(row, sense, table);
    }
  });
  if (!header) complain(0, 0, fmt::format("has no header line {}", lateral_header));
  if (wrong.empty() && table.c_rad.size() < 2) complain(0, 0, "has fewer than two rows");
  if (!wrong.empty()) throw InputError(std::move(wrong));
  return table;
}

virtual_lathe::CutTable read_cut_table(const std::string& path, int sense) {
  return parse_cut_table(read_file(path), path, sense);
}

}  // namespace trueaxis

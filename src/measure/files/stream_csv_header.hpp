// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "format/csv_text.hpp"
#include "format/units.hpp"
#include "trueaxis/probe_stream.hpp"

namespace trueaxis {

enum class CsvRole { reading, more_reading, angle, position, time, pass, setup, unknown };

/// A column as its header names it.
struct CsvColumn {
  CsvRole role = CsvRole::unknown;
  std::string name;           ///< as we write it: X_M, X_M1, C, Z, t, pass, setup
  std::size_t sensor = 0;     ///< of X_M1, X_M2 …: 1, 2 …
  std::size_t character = 0;  ///< where the header names it
  Unit unit{};
  bool diameter = false;  ///< unit says `dia`
  bool running = false;   ///< unit says `running`: C is not unwrapped
};

/// The line that names the columns. `separator` is ' ' for runs of blanks.
struct CsvHeader {
  std::size_t line = 0;  ///< 0: none yet
  char separator = ',';
  StreamKind kind = StreamKind::lateral;
  std::vector<CsvColumn> columns;

  /// The column of a role, or nullptr.
  const CsvColumn* find(CsvRole role) const;
  /// How many columns X_M1, X_M2 … there are; 0 for a stream of one sensor X_M.
  std::size_t sensors() const;
};

/// Reads the header line (comment stripped); what is wrong goes to `diagnostics`. A line of numbers
/// is not a header: the result then has no columns.
CsvHeader csv_parse_header(std::string_view line, std::size_t line_number,
                           CsvDiagnostics& diagnostics);

}  // namespace trueaxis

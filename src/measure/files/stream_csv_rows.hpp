// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

#include "format/csv_text.hpp"
#include "measure/files/stream_csv_header.hpp"
#include "measure/files/stream_csv_invalid.hpp"
#include "trueaxis/probe_stream.hpp"

namespace trueaxis {

/// Appends rows to the columns of a stream, with the numbers of the file (units come later).
class CsvRows {
 public:
  CsvRows(const CsvHeader& header, ProbeStream& stream, CsvDiagnostics& diagnostics,
          bool drop_invalid);

  /// Room for `rows` rows in every column.
  void reserve(std::size_t rows);

  /// Reads the row at `p` if nothing about it is unusual; returns the start of the next line, or
  /// nullptr with nothing appended. There must be a '\n' before `end`.
  const char* fast_row(const char* p, const char* end);

  /// Takes a row of numbers if nothing about it is unusual.
  bool take(std::span<const double> row);

  /// Takes whole columns of numbers if nothing about any row is unusual, else nothing.
  bool take_columns(std::span<const std::span<const double>> columns);

  /// Reads a row whatever it looks like (no line end, no comment); what is wrong is a diagnostic.
  void any_row(std::string_view line, std::size_t line_number);

  /// Rows that hold no value somewhere; with `drop_invalid` they are not mistakes.
  const CsvInvalidRows& invalid() const { return invalid_; }
  /// Whether a line that begins with '#' is such a row.
  bool is_row_of_no_value(std::string_view line);

 private:
  struct Target {
    std::vector<double>* numbers = nullptr;
    std::vector<int>* whole = nullptr;
    const CsvColumn* column = nullptr;
  };

  bool field(const Target& target, std::string_view text, double& value, std::string& why) const;
  bool accept();             ///< appends row_ unless its time falls
  bool begins_pass() const;  ///< row_ has another number of the pass than the row before
  void append();
  void time_is(double t) {
    if (!std::isfinite(first_time_)) first_time_ = t;
    last_time_ = t;
  }

  const CsvHeader& header_;
  CsvDiagnostics& diagnostics_;
  std::vector<Target> targets_;
  std::vector<double> row_;
  std::vector<std::string_view> fields_;
  std::size_t time_at_;  ///< index of t, or the number of columns
  double first_time_, last_time_;
  bool all_known_, drop_invalid_;
  CsvInvalidRows invalid_;
};

}  // namespace trueaxis

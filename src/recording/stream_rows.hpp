// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "format/csv_text.hpp"
#include "measure/files/stream_csv_invalid.hpp"
#include "recording/columns.hpp"
#include "recording/recording.hpp"

namespace trueaxis {

/// The rows of a stream, made of the chosen columns: those of which every cell is good.
struct StreamRows {
  std::string header;              ///< "X_M[mm dia],C[deg],Z[mm]"
  std::vector<double> numbers;     ///< row by row, in the order of the header
  std::vector<std::size_t> rows;   ///< of the recording, each
  std::vector<std::size_t> lines;  ///< of the file, of each row
  std::vector<std::string> notes;
  std::vector<TakenColumn> taken;  ///< in the order of the header
  CsvInvalidRows invalid;          ///< without a value in a chosen column
};

/// `diagnostics` gets what is not a number, one place and a count of each kind. If there is a
/// column Y, (X, Y) at C is a point: the reading is its distance from the spindle axis, signed as
/// X, at the angle C + arctan(Y/X), which is the same point of the part. With `drop_invalid` rows
/// without a value are not mistakes.
StreamRows stream_rows(const Recording& recording, const RecordedText& text,
                       std::vector<TakenColumn> taken, bool diameter, bool drop_invalid,
                       CsvDiagnostics& diagnostics);

/// Row `k` as a stream writes it, with the digits of the text.
std::string row_text(const Recording& recording, const StreamRows& rows, std::size_t k);

}  // namespace trueaxis

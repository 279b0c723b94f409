// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <deque>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "measure/files/stream_csv_metadata.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis {

struct ColumnsSaid;

/// The text of a file of another program: UTF-8 whatever it was saved as, cut into lines.
struct RecordedText {
  explicit RecordedText(const std::string& bytes);
  RecordedText(const RecordedText&) = delete;  // `lines` point into `text`
  RecordedText& operator=(const RecordedText&) = delete;

  std::string text;
  std::vector<std::string_view> lines;  ///< without line ends; line n of the file is lines[n - 1]
};

/// A column of a recording, as its file names it.
struct RecordedColumn {
  std::string name;        ///< without its unit; empty where the file has no names
  std::string unit;        ///< as written; empty where the file says none
  std::string whole;       ///< the field as it is in the header
  bool is_number = false;  ///< most of its fields are numbers
};

/// What a file of another program holds, whatever its layout: a table of fields, row by row.
/// Nothing is converted yet but what the layout itself says (a scale, an instant).
struct Recording {
  std::string
      producer;  ///< what it was recognised as: "a table with semicolons and decimal commas"
  std::vector<RecordedColumn> columns;
  std::vector<std::string_view> cells;  ///< row by row, columns.size() each; of a text
  std::vector<double> numbers;          ///< the same of a binary file
  std::vector<std::size_t> lines;       ///< of each row, 1-based
  char decimal = '.';
  bool of_numbers = false;    ///< a binary file: a row is its line, a unit must be given
  bool in_thousands = false;  ///< every decimal mark may as well part thousands: 20.100
  /// Arrays of a binary file that cannot be columns, with why: "C (199 rows)".
  std::vector<std::string> left_out;
  std::vector<std::string> notes;     ///< what was passed over or joined, in sentences
  std::vector<std::string> metadata;  ///< lines "# key: value" that are handed on as they are
  std::vector<CsvKeyBelow> keys;      ///< of stream.md among these
  std::deque<std::string> made;       ///< text of cells that are not in a file
  std::vector<std::string> unclear;   ///< what a caller must say with the columns, in sentences
  std::vector<Diagnostic> wrong;      ///< rows that do not fit; no file named

  std::size_t rows() const { return lines.size(); }
  /// As it is in a text; in a binary file the word for a number that is not finite.
  std::string_view cell(std::size_t row, std::size_t column) const {
    return of_numbers ? "not finite" : cells[row * columns.size() + column];
  }
  /// The number of a cell; false if it is not a number, or not finite.
  bool number(std::size_t row, std::size_t column, double& value) const;
  /// A cell as a stream writes it: the digits of a text with a decimal point.
  std::string written(std::size_t row, std::size_t column) const;
};

/// A cell read as a number, its decimal comma a point. False if it is not a number.
bool recorded_number(std::string_view cell, char decimal, double& value);

/// "name", "unit" of "Angle (°)", "C[deg]", "X / mm", "X in mm", "X mm", "X_in".
RecordedColumn recorded_column(std::string_view header_field);
/// The same of a whole header, where "X_m" next to "C_rad" or "Z_m" is an X in metres.
std::vector<RecordedColumn> recorded_columns(const std::vector<std::string_view>& header);

/// Takes a line without readings: what says a unit or a convention of the whole file ("Messung in
/// Zoll", "G20") must not be passed over.
void take_title(std::string_view line, Recording& out);
/// Takes a comment line.
void take_comment(std::string_view line, std::size_t number, Recording& out);

// Each reads a layout into `out`; false if the text is not of its kind. A text that is of the
// kind and broken leaves the places in `wrong`.

/// Beckhoff TwinCAT Scope's text export: keyed rows, then "TICKS;v1;v2;…".
bool read_twincat_scope(const RecordedText& text, Recording& out);
/// EPICS camonitor: "PV date time value", channels interleaved and of unequal rates. The others
/// are interpolated linearly at the instants of the readings, the channel that `said` or a name
/// says they are.
bool read_camonitor(const RecordedText& text, const ColumnsSaid& said, Recording& out);
/// The log of a probing program that TrueAxis wrote: its head says all. Rows are touch points, or
/// what halsampler -t writes, appended to it.
bool read_probe_log(const RecordedText& text, Recording& out);

/// A letter and its number.
struct RecordedWord {
  char letter;
  std::string_view number;
};
/// The words of a line that holds nothing else; empty for any other line. A control writes blanks
/// between a letter and its number (FANUC, Haas: DPRNT pads with them), other programs a '='.
std::vector<RecordedWord> recorded_words(std::string_view line);
/// Words of a letter and a number, "X   10.0012 C   30.0000": DPRNT, point lists of RS-274.
bool read_words(const RecordedText& text, Recording& out);
/// The columns of an HDF5, MATLAB or NumPy file, the longest ones; every number to its last digit.
/// @throws InputError for a broken file
Recording recorded_numbers(const std::string& path, const std::string& bytes);
/// Fields between separators, with or without names: spreadsheets, LinuxCNC's PROBEOPEN and
/// halsampler. The first `skip` lines are not looked at; `decimal`: '.' or ',' if `--columns` gives
/// it.
bool read_table(const RecordedText& text, std::size_t skip, std::optional<char> decimal,
                Recording& out);

/// A text in whichever of these layouts it has. @throws InputError if it holds no table of numbers
Recording recognise_recording(const RecordedText& text, const std::string& path, std::size_t skip,
                              const ColumnsSaid& said);

/// "1 Nr., 2 Angle(°), 3 X": what there is to choose from; of a column without a name its number.
std::string columns_listed(const Recording& recording);

/// Seconds of "13:55:48.325" since midnight, of "2022-02-22 13:55:48.325" since 1970 as if in UTC;
/// the seconds may have a decimal comma. Nothing for other text.
std::optional<double> instant_s(std::string_view text);

}  // namespace trueaxis

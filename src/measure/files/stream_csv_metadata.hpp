// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "format/csv_text.hpp"
#include "measure/files/stream_csv.hpp"
#include "measure/files/stream_csv_header.hpp"
#include "trueaxis/probe_stream.hpp"

namespace trueaxis {

/// The known keys among "# key: value", read; absent where the file does not say.
struct CsvKnownMetadata {
  std::optional<bool> diameter;  ///< x_convention
  std::size_t diameter_line = 0;
  std::optional<Indication> indication;  ///< reading
  std::optional<double> nominal_radius_mm, sensor_noise_mm, spindle_rpm, ball_radius_mm;
  std::map<int, SetUp> set_ups;  ///< by number
  struct Place {
    std::size_t line = 0, column = 0;
  };
  std::vector<double> sensor_angles_rad;
  Place sensor_angles_place;
  std::map<int, Place> set_up_places;  ///< where each is first spoken of
};

/// Reads "key: value" lines after '#'. A key is one word of letters, digits, '_', '.', '-'. All
/// keys go to `metadata` (a key that comes again is joined by "; "), known ones, in any case of
/// letters, are read as well. What looks like a known key is a diagnostic (csv_comment_trouble);
/// other comments, and those that begin with "##", are passed over.
class CsvMetadataReader {
 public:
  explicit CsvMetadataReader(CsvDiagnostics& diagnostics) : diagnostics_(diagnostics) {}

  /// `line` starts with blanks and '#'.
  void comment(std::string_view line, std::size_t line_number);
  /// A comment after the header or a row, from byte `hash` of `line`: free text only.
  void comment_behind(std::string_view line, std::size_t hash, std::size_t line_number);

  /// Where a known key that the file states is.
  std::size_t line_of(const std::string& key) const { return known_lines_.at(key); }

  CsvKnownMetadata known;
  std::map<std::string, std::string> metadata;

 private:
  bool refuse_trouble(std::string_view line, std::size_t hash, std::size_t line_number);
  void known_key(const std::string& key, std::string_view value, std::size_t line,
                 std::size_t column);

  CsvDiagnostics& diagnostics_;
  std::map<std::string, std::size_t> known_lines_;
};

/// Whether `key` can be written as metadata and read again unchanged.
bool csv_is_key(std::string_view key);

/// The key of stream.md that a comment line states, as it is written; empty: none.
std::string_view csv_known_key(std::string_view comment);

/// A key that is below `rows` rows of a file. With rows below it as well it may be meant for those
/// alone, and is refused.
struct CsvKeyBelow {
  std::size_t line, column, rows;
  std::string key;
};
void csv_refuse_keys_between(const std::vector<CsvKeyBelow>& keys, std::size_t rows,
                             CsvDiagnostics& diagnostics);

/// Whether a key in small letters is one of a set-up: "setup.2.reindex".
bool csv_is_setup_key(std::string_view key);

/// Takes "setup.2.reindex", "70 deg" into `set_ups`. @returns what is wrong and what to write
/// instead, empty where nothing is.
std::string csv_take_setup(std::string_view key, std::string_view value,
                           std::map<int, SetUp>& set_ups);

/// Number of the set-up that a key belongs to.
int csv_setup_number(std::string_view key);

/// Makes the metadata of set-ups say what the stream's set-ups say; `stated` is what they said.
void csv_put_setups(const ProbeStream& stream, const std::map<int, SetUp>& stated,
                    std::map<std::string, std::string>& metadata);

/// Judges the text after '#' of a comment that holds no known key as it is spelt. Prose is free.
/// What looks like a known key must not be passed over: another spelling, '=' or blanks for ':', a
/// letter or two wrong, a word that means one. Nor must a unit or convention for the whole file.
/// @returns what is wrong and what to write instead, empty for free text. Text that begins with a
/// further '#' is always free.
std::string csv_comment_trouble(std::string_view text);

/// Whether a C column is wrapped: it stays within one turn, [0, turn] or [-turn/2, turn/2] up to a
/// thousandth of a turn, and jumps by more than half a turn.
bool csv_is_wrapped(const std::vector<double>& c, double turn);

/// From the numbers as they are in the file to mm, rad (running), s and radii. What contradicts
/// is a diagnostic; nothing is changed then. `line_of_row` gives the line of a reading (from 0).
void csv_finish(const CsvHeader& header, const CsvMetadataReader& metadata,
                const StreamReadOptions& options,
                const std::function<std::size_t(std::size_t)>& line_of_row, ProbeStream& stream,
                CsvDiagnostics& diagnostics);

}  // namespace trueaxis

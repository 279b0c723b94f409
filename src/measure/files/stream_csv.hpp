// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "trueaxis/probe_stream.hpp"

namespace trueaxis {

/// What a caller knows of a stream that the file does not say; a contradiction is a diagnostic.
struct StreamReadOptions {
  std::optional<bool> diameter;              ///< X_M is a diameter (true) or a radius (false)
  SaidBy diameter_said_by = SaidBy::option;  ///< who says so
  std::optional<Indication> indication;      ///< as metadata `reading`
  std::optional<double> nominal_radius_mm;   ///< as metadata `nominal_radius`
  bool several_sensors = false;              ///< columns X_M1, X_M2 … may be read
  std::vector<double> sensor_angles_rad{};   ///< of a stream that does not say `sensor_angles`
  std::size_t max_diagnostics = 1000;        ///< further ones are counted, not listed
  bool drop_invalid = false;  ///< rows without a value (csv_is_no_value) are excluded and reported
  /// The command that was typed, without what says how a stream is read; empty: none, or a job.
  std::vector<std::string> typed{};

  /// The caller, in words.
  const char* caller() const { return diameter_said_by == SaidBy::job ? "the job" : "the option"; }
};

/// What `options` say of the readings, as options of a command: "--diameter".
std::vector<std::string> words_of(const StreamReadOptions& options);

/// Reads the CSV of stream.md from a file, or from standard input when `path` is "-".
/// @throws InputError with every diagnostic (file, line, column, what to do).
ProbeStream read_stream_csv(const std::string& path, const StreamReadOptions& options = {});

/// The same from its text; `source` is the file that it is of.
ProbeStream read_stream_csv_text(std::string_view text, const std::string& source,
                                 const StreamReadOptions& options = {});

/// The same for a head (comments and the line of the columns) and the rows of numbers below it.
/// `text_of` is a row's text, for messages. `line_of` is the line in the file `source` of a line of
/// head and rows (0: none).
ProbeStream read_stream_rows(std::string_view head, std::span<const double> numbers,
                             const std::function<std::string(std::size_t)>& text_of,
                             const std::string& source, const StreamReadOptions& options,
                             std::function<std::size_t(std::size_t)> line_of);

/// The same of a head and columns of equal length, in the order of its header: arrays of a program.
/// input_hash is of the head and of the bytes of the numbers; a message gives the row from 1.
ProbeStream read_stream_columns(std::string_view head,
                                std::span<const std::span<const double>> columns,
                                const std::string& source, const StreamReadOptions& options = {});

}  // namespace trueaxis

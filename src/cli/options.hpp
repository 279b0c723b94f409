// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

/// What several commands check and are told alike.
namespace trueaxis::cli {

/// `--array` of a command that reads points.
inline constexpr const char* array_help =
    "of an HDF5, MATLAB or NumPy file: the array of three columns that holds the points, or three "
    "columns, as in X,Y,Z";

/// A finite number from `low` (itself not allowed when `open`) to `high`.
inline CLI::Validator number_in(double low, bool open, double high, const std::string& meaning) {
  return {[=](const std::string& text) {
            double value = 0.0;
            const bool number = CLI::detail::lexical_cast(text, value) && std::isfinite(value);
            const bool inside = number && value <= high && (open ? value > low : value >= low);
            return inside ? std::string() : text + " is not " + meaning;
          },
          "", "number"};
}

inline CLI::Validator more_than_0() {
  return {[](const std::string& text) -> std::string {
            double value = 0.0;
            if (!CLI::detail::lexical_cast(text, value) || !std::isfinite(value))
              return text + " is no finite number";
            return value > 0.0 ? "" : text + " must be more than 0";
          },
          "", "number"};
}

inline CLI::Validator a_length() { return number_in(0.0, false, 1e6, "a length of 0 to 1e6"); }
inline CLI::Validator positive_length() {
  return number_in(0.0, true, 1e6, "a length above 0, up to 1e6");
}

/// `--false-alarm` of a diagnosis.
inline void add_false_alarm(CLI::App& command, double& level) {
  command
      .add_option("--false-alarm", level, "chance of a finding in a stream that has none (0.01)")
      ->check(number_in(0.0, true, 0.5, "a probability above 0, up to 0.5"));
}

/// A place to write to: any text but an empty or blank one, which a script's empty variable gives.
inline CLI::Validator a_place() {
  return {[](const std::string& text) {
            return text.find_first_not_of(" \t\r\n") == std::string::npos
                       ? std::string(text.empty() ? "is empty" : "is blank") +
                             ": name a place for the result"
                       : std::string();
          },
          "", "place"};
}

/// `--force`, the same for every command that writes.
inline CLI::Option* add_force(CLI::App& command, bool& force) {
  return command.add_flag("--force", force,
                          "replace files that are there and are not earlier results of this kind; "
                          "never one that is read");
}

/// Each file goes to a place of its own: an option and its place each. @throws CLI::ValidationError
inline void expect_apart(const std::vector<std::pair<std::string, std::string>>& places) {
  for (std::size_t i = 1; i < places.size(); ++i)
    for (std::size_t k = 0; k < i; ++k)
      if (!places[i].second.empty() && places[i].second == places[k].second)
        throw CLI::ValidationError(places[i].first, "cannot go where " + places[k].first + " goes");
}

/// `--json`, `--residuals`, `--report` and `--force` of a command that fits a stream.
struct ResultOptions {
  std::string json, residuals, report;
  bool force = false;

  void add_to(CLI::App& command, const std::string& residuals_hold) {
    command.add_option("--json", json, "write the result here, '-' prints it")->check(a_place());
    command.add_option("--residuals", residuals, "write every reading with " + residuals_hold)
        ->check(a_place());
    command.add_option("--report", report, "write a page here (HTML), '-' prints it")
        ->check(a_place());
    add_force(command, force);
  }
  void expect_apart() const {
    if (!json.empty() && json == residuals)
      throw CLI::ValidationError("--residuals", "cannot go where --json goes");
    if (!report.empty() && (report == json || report == residuals))
      throw CLI::ValidationError("--report", "cannot go where --json or --residuals goes");
  }
  bool printed() const { return json == "-" || residuals == "-" || report == "-"; }
};

}  // namespace trueaxis::cli

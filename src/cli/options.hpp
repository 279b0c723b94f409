// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

/// Options and checks that several commands share.
namespace trueaxis::cli {

/// Groups of options in a command's help; the rest is in "Options".
inline constexpr const char *readings_group = "Readings", *surface_group = "Surface",
                            *points_group = "Points", *machine_group = "Machine",
                            *results_group = "Results";

/// `--array` of a command that reads points.
inline constexpr const char* array_help =
    "array or three columns in an HDF5, MATLAB or NumPy file, as X,Y,Z";

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
              return text + " is not a finite number";
            return value > 0.0 ? "" : text + " must be more than 0";
          },
          "", "number"};
}

inline CLI::Validator a_length() { return number_in(0.0, false, 1e6, "a length of 0 to 1e6"); }
inline CLI::Validator positive_length() {
  return number_in(0.0, true, 1e6, "a length above 0, up to 1e6");
}

/// An option whose value is checked.
template <class Value>
CLI::Option* add_option(CLI::App& command, const std::string& name, Value& value,
                        const CLI::Validator& check, const std::string& help) {
  return command.add_option(name, value, help)->check(check);
}

/// `--bore`, `--ball-radius-mm` and `--noise-um` of a command that evaluates readings.
inline void add_probe(CLI::App& command, bool& bore, double& ball_radius_mm, double& noise_um,
                      const char* group) {
  command.add_flag("--bore", bore, "the part is probed from inside")->group(group);
  add_option(command, "--ball-radius-mm", ball_radius_mm, a_length(),
             "ball radius if X_M is the ball's centre, mm (default 0)")
      ->group(group);
  add_option(command, "--noise-um", noise_um, a_length(),
             "standard deviation of one reading, µm (default from the data)")
      ->group(group);
}

inline CLI::Validator one_of(std::vector<std::string> words) {
  return CLI::IsMember(std::move(words));
}

/// `--coverage-factor` of a command that prints an uncertainty.
inline CLI::Option* add_coverage_factor(CLI::App& command, double& factor) {
  return add_option(command, "--coverage-factor", factor,
                    number_in(0.0, true, 100.0, "a number above 0, up to 100"),
                    "k of U = k u (default 2)");
}

/// `--threads` of a command that computes on several.
inline CLI::Option* add_threads(CLI::App& command, int& threads) {
  return add_option(command, "--threads", threads, CLI::Range(0, 4096),
                    "number of threads (default 0: one per core)");
}

/// `--false-alarm` of a diagnosis.
inline void add_false_alarm(CLI::App& command, double& level) {
  command
      .add_option("--false-alarm", level,
                  "probability of a false alarm in data without a cause (default 0.01)")
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

/// An option that names a file or folder; what is written is among the results.
inline CLI::Option* add_place(CLI::App& command, const std::string& name, std::string& place,
                              const std::string& help) {
  CLI::Option* const option = add_option(command, name, place, a_place(), help)->type_name("FILE");
  return name.ends_with("output") ? option->group(results_group) : option;
}

/// `--force`, the same for every command that writes.
inline CLI::Option* add_force(CLI::App& command, bool& force) {
  return command.add_flag("--force", force,
                          "replace files that TrueAxis did not write; never an input");
}

/// An option without an effect in one use of a command is refused.
/// @throws CLI::ValidationError for an option that was given and is one of `names`, or not
inline void refuse_given(const CLI::App& command, bool one_of_these,
                         const std::vector<std::string>& names, const std::string& why) {
  for (const CLI::Option* option : command.get_options()) {
    const bool listed = std::ranges::find(names, option->get_name()) != names.end();
    if (option->count() > 0 && listed == one_of_these && option->get_name() != "--help")
      throw CLI::ValidationError(option->get_name(), why);
  }
}
inline void expect_only(const CLI::App& command, const std::vector<std::string>& fine,
                        const std::string& why) {
  refuse_given(command, false, fine, why);
}
inline void expect_none(const CLI::App& command, const std::vector<std::string>& of_another,
                        const std::string& why) {
  refuse_given(command, true, of_another, why);
}

}  // namespace trueaxis::cli

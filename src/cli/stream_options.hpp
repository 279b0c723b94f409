// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "cli/checks.hpp"
#include "measure/files/stream_csv.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis::cli {

/// What a caller may say of a stream, the same for every command that reads one.
struct StreamOptions {
  std::string path;
  bool diameter = false, radius = false, relative = false;
  double nominal_radius_mm = 0.0;

  void add_to(CLI::App& command,
              const std::string& what = "probe stream (CSV), '-' for standard input") {
    command.add_option("stream", path, what)->required();
    add_meaning_to(command);
  }

  /// The options that say what the readings are.
  void add_meaning_to(CLI::App& command) {
    auto* as_diameter = command.add_flag("--diameter", diameter, "X_M is a diameter");
    command.add_flag("--radius", radius, "X_M is a radius")->excludes(as_diameter);
    command.add_flag("--relative", relative, "X_M is a gauge's reading, not a position");
    command.add_option("--nominal-radius", nominal_radius_mm, "of a relative gauge, mm")
        ->check(positive_length());
  }

  bool says_anything() const { return diameter || radius || relative || nominal_radius_mm > 0.0; }

  /// What the options say of a stream.
  StreamReadOptions said() const {
    StreamReadOptions options;
    if (diameter || radius) options.diameter = diameter;
    if (relative) options.indication = Indication::relative;
    if (nominal_radius_mm > 0.0) options.nominal_radius_mm = nominal_radius_mm;
    return options;
  }

  ProbeStream read() const { return read_stream_csv(path, said()); }
};

}  // namespace trueaxis::cli

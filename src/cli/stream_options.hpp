// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "cli/options.hpp"
#include "cli/typed_command.hpp"
#include "job/files/influences_toml.hpp"
#include "job/files/job_file.hpp"
#include "surface/surface.hpp"
#include "trueaxis/error.hpp"
#include "trueaxis/fit.hpp"

namespace trueaxis::cli {

/// What a caller may say of a stream, the same for every command that reads one.
struct StreamOptions {
  std::string path;
  bool diameter = false, radius = false, relative = false;
  double nominal_radius_mm = 0.0;
  std::string columns;
  std::size_t skip = 0;
  ZRange range{};
  bool drop_invalid = false;
  const CLI::App* command = nullptr;  ///< whose options these are

  void add_to(CLI::App& command,
              const std::string& what = "probe stream (CSV), '-' for standard input") {
    command.add_option("stream", path, what)->required();
    add_meaning_to(command);
  }

  /// The options that say what the readings are.
  void add_meaning_to(CLI::App& command) {
    this->command = &command;
    auto* as_diameter = command.add_flag("--diameter", diameter, "X_M is a diameter");
    command.add_flag("--radius", radius, "X_M is a radius")->excludes(as_diameter);
    command.add_flag("--relative", relative, "X_M is a gauge's reading, not a position");
    add_option(command, "--nominal-radius", nominal_radius_mm, positive_length(),
               "of a relative gauge, mm");
    add_option(command, "--columns", columns, a_place(),
               "of another program's file: which is which, by name or number, such as "
               "\"X=Diameter,C=Angle(°),Z=3[mm]\"");
    add_option(command, "--skip", skip, CLI::Range(0, 1000000),
               "of another program's file: lines above its table that are passed over");
    command.add_flag(
        "--drop-invalid", drop_invalid,
        "exclude rows without a value (NaN, #N/A, empty) and readings at the end of the sensor's "
        "range, and list them");
  }

  /// The options that take a stretch of Z alone.
  void add_range_to(CLI::App& command) {
    add_option(command, "--z-from-mm", range.from_mm, number_in(-1e6, true, 1e6, "a length in mm"),
               "lower end of the Z that is read, mm (all)");
    add_option(command, "--z-to-mm", range.to_mm, number_in(-1e6, true, 1e6, "a length in mm"),
               "upper end of the Z that is read, mm (all)");
  }

  /// `--ball-radius` of a command that reads a diagnosed stream again.
  static CLI::Option* add_ball_radius(CLI::App& command, double& radius_mm) {
    return add_option(command, "--ball-radius", radius_mm, a_length(),
                      "of the probe's ball, mm, as given to the diagnosis");
  }

  bool says_anything() const {
    return diameter || radius || relative || nominal_radius_mm > 0.0 || drop_invalid ||
           !range.everywhere() || recording().says_anything();
  }

  /// What the options say of a stream.
  StreamReadOptions said() const {
    StreamReadOptions options;
    if (diameter || radius) options.diameter = diameter;
    if (relative) options.indication = Indication::relative;
    if (nominal_radius_mm > 0.0) options.nominal_radius_mm = nominal_radius_mm;
    options.drop_invalid = drop_invalid;
    options.typed = typed_command(*command, {"--diameter", "--radius", "--relative",
                                             "--nominal-radius", "--columns", "--skip"});
    return options;
  }

  /// The same of another program's file.
  RecordingOptions recording() const { return {columns, skip, said()}; }

  StreamFile file() const { return {path, recording(), range}; }

  ProbeStream read() const { return read_stream(file()); }
};

/// How a stream is to be associated, the same for every command that fits one.
struct AssociationOptions {
  FitOptions fit;
  std::string surface = "cone", loss = "plain";
  double noise_um = -1.0;
  std::vector<std::string> known;

  /// @param fit_only the command takes surfaces that are not diagnosed as well
  CLI::Option* add_to(CLI::App& command, bool fit_only = false) {
    std::vector<std::string> surfaces;
    for (const SurfaceInfo& info : surface_catalogue())
      if (fit_only || is_diagnosed(info.kind)) surfaces.emplace_back(info.id);
    CLI::Option* option =
        add_option(command, "--surface", surface, one_of(surfaces), "reference surface");
    add_option(command, "--loss", loss, one_of({"plain", "huber", "tukey"}),
               "how readings far off count: plain (least squares, default); huber and tukey "
               "count them less");
    command.add_flag("--bore", fit.bore, "probed from inside");
    add_option(command, "--ball-radius", fit.ball_radius_mm, a_length(),
               "X_M is the centre of a ball of this radius, mm");
    add_option(command, "--noise", noise_um, a_length(),
               "standard deviation of one reading if known, µm");
    if (!fit_only)
      command
          .add_option("--known", known,
                      "what is known of probe and machine, with its standard uncertainty, such as "
                      "lag_ms=0.4±0.1 or u_gain=0; keys are those of [sensor] of a job")
          ->type_name("KEY=VALUE±U")
          ->expected(1, 100)
          ->allow_extra_args(false);
    add_option(command, "--coverage-factor", fit.coverage_factor,
               number_in(0.0, true, 100.0, "a number above 0, up to 100"), "k of U = k u (2)");
    return option;
  }

  FitOptions chosen() const {
    FitOptions options = fit;
    options.surface = surface_from_id(surface);
    options.loss = loss == "huber" ? Loss::huber : loss == "tukey" ? Loss::tukey : Loss::plain;
    options.influences = influences_of(known);
    if (noise_um >= 0.0) options.noise_mm = noise_um * mm_per_um;
    return options;
  }
};

/// @throws InputError where a stream has fewer readings than the surface has parameters
inline void expect_enough_readings(const FitResult& fit) {
  if (fit.status == FitStatus::too_few) throw InputError(fit.source, fit.message + ": probe more");
}

}  // namespace trueaxis::cli

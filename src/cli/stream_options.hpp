// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "cli/options.hpp"
#include "cli/typed_command.hpp"
#include "job/files/influences_toml.hpp"
#include "job/files/job_file.hpp"
#include "measure/feature.hpp"
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
              const std::string& what = "probe stream (CSV); - for standard input") {
    command.add_option("stream", path, what)->required();
    add_meaning_to(command);
  }

  /// The options that say what the readings are.
  void add_meaning_to(CLI::App& command) {
    this->command = &command;
    auto* as_diameter = command.add_flag("--diameter", diameter, "X_M is a diameter, a radius")
                            ->group(readings_group);
    command.add_flag("--radius", radius, "X_M is a diameter, a radius")
        ->excludes(as_diameter)
        ->group(readings_group);
    command.add_flag("--relative", relative, "X_M is a gauge's reading; its nominal radius, mm")
        ->group(readings_group);
    add_option(command, "--nominal-radius-mm", nominal_radius_mm, positive_length(),
               "X_M is a gauge's reading; its nominal radius, mm")
        ->group(readings_group);
    add_place(command, "--columns", columns,
              "columns in another program's file, as \"X=Diameter,C=Angle(°),Z=3[mm]\"")
        ->type_name("COLUMNS")
        ->group(readings_group);
    add_option(command, "--skip", skip, CLI::Range(0, 1000000),
               "lines above the table in another program's file")
        ->group(readings_group);
    command
        .add_flag("--drop-invalid", drop_invalid,
                  "exclude and list rows without a value, readings of a saturated sensor")
        ->group(readings_group);
  }

  /// The options that take a stretch of Z alone.
  void add_range_to(CLI::App& command) {
    add_option(command, "--z-from-mm", range.from_mm, number_in(-1e6, true, 1e6, "a length in mm"),
               "range of Z to use, mm (default all)")
        ->group(readings_group);
    add_option(command, "--z-to-mm", range.to_mm, number_in(-1e6, true, 1e6, "a length in mm"),
               "range of Z to use, mm (default all)")
        ->group(readings_group);
  }

  /// `--ball-radius-mm` of a command that reads a diagnosed stream again.
  static CLI::Option* add_ball_radius(CLI::App& command, double& radius_mm) {
    return add_option(command, "--ball-radius-mm", radius_mm, a_length(),
                      "ball radius as given to the diagnosis, mm (default 0)")
        ->group(readings_group);
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
                                             "--nominal-radius-mm", "--columns", "--skip"});
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
        add_option(command, "--surface", surface, one_of(surfaces), "reference surface")
            ->group(surface_group);
    add_option(command, "--loss", loss, one_of({"plain", "huber", "tukey"}),
               "weight of outlying readings (default plain)")
        ->group(surface_group);
    add_probe(command, fit.bore, fit.ball_radius_mm, noise_um, surface_group);
    if (!fit_only)
      command.add_option("--known", known, "known value, as lag_ms=0.4±0.1; keys of [sensor]")
          ->group(surface_group)
          ->type_name("KEY=VALUE±U")
          ->expected(1, 100)
          ->allow_extra_args(false);
    add_coverage_factor(command, fit.coverage_factor)->group(surface_group);
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
  /// With what the stream states of its feature.
  FitOptions chosen(const ProbeStream& stream) const {
    FitOptions options = chosen();
    options.bore = options.bore || states_bore(stream);
    return options;
  }
};

/// @throws InputError where a stream has fewer readings than the surface has parameters
inline void expect_enough_readings(const FitResult& fit) {
  if (fit.status == FitStatus::too_few) throw InputError(fit.source, fit.message + ": probe more");
}

}  // namespace trueaxis::cli

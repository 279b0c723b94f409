// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <map>
#include <string>
#include <vector>

#include "cli/checks.hpp"
#include "cli/stream_options.hpp"
#include "surface/surface.hpp"
#include "trueaxis/fit.hpp"

namespace trueaxis::cli {

/// How a stream is to be associated, the same for every command that fits one.
struct AssociationOptions {
  FitOptions fit;
  std::string surface = "cone", loss = "plain";
  double noise_um = -1.0;

  CLI::Option* add_to(CLI::App& command) {
    std::vector<std::string> surfaces;
    for (const SurfaceInfo& info : surface_catalogue()) surfaces.emplace_back(info.id);
    CLI::Option* option = command.add_option("--surface", surface, "reference surface")
                              ->check(CLI::IsMember(surfaces));
    command.add_option("--loss", loss, "plain (default), huber or tukey")
        ->check(CLI::IsMember({"plain", "huber", "tukey"}));
    command.add_flag("--bore", fit.bore, "probed from inside");
    command
        .add_option("--ball-radius", fit.ball_radius_mm,
                    "X_M is the centre of a ball of this radius, mm")
        ->check(a_length());
    command.add_option("--noise", noise_um, "standard deviation of one reading if known, µm")
        ->check(a_length());
    command.add_option("--coverage-factor", fit.coverage_factor, "k of U = k u (2)")
        ->check(number_in(0.0, true, 100.0, "a number above 0, up to 100"));
    return option;
  }

  FitOptions chosen() const {
    static const std::map<std::string, Loss> losses{
        {"plain", Loss::plain}, {"huber", Loss::huber}, {"tukey", Loss::tukey}};
    FitOptions options = fit;
    options.surface = surface_from_id(surface);
    options.loss = losses.at(loss);
    if (noise_um >= 0.0) options.noise_mm = noise_um * mm_per_um;
    return options;
  }
};

}  // namespace trueaxis::cli

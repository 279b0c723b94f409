// SPDX-License-Identifier: Apache-2.0
#include "trueaxis/fit/fit.hpp"

#include <iostream>
#include <map>
#include <memory>

#include "cli/checks.hpp"
#include "cli/commands.hpp"
#include "cli/stream_options.hpp"
#include "trueaxis/base/error.hpp"
#include "trueaxis/io/file.hpp"
#include "trueaxis/io/fit_json.hpp"
#include "trueaxis/io/fit_text.hpp"
#include "trueaxis/io/residuals_csv.hpp"
#include "trueaxis/surface/surface.hpp"

namespace trueaxis::cli {
namespace {

const std::map<std::string, Loss> losses{
    {"plain", Loss::plain}, {"huber", Loss::huber}, {"tukey", Loss::tukey}};

struct Options {
  StreamOptions stream;
  FitOptions fit;
  std::string loss = "plain", json, residuals;
  double noise_um = -1.0;
};

int execute(const Options& options) {
  const ProbeStream stream = options.stream.read();
  FitOptions fit_options = options.fit;
  fit_options.loss = losses.at(options.loss);
  if (options.noise_um >= 0.0) fit_options.noise_mm = options.noise_um * mm_per_um;
  const FitResult result = fit(stream, fit_options);
  if (result.status == FitStatus::too_few)
    throw InputError(stream.source, result.message + ": probe more");
  const std::string json = options.json.empty() ? "" : fit_json(result);
  const std::string residuals = options.residuals.empty() ? "" : residuals_csv(stream, result);
  std::vector<FileContent> files;
  if (!options.json.empty()) files.push_back({options.json, json});
  if (!options.residuals.empty()) files.push_back({options.residuals, residuals});
  write_files(files);
  if (options.json != "-" && options.residuals != "-") std::cout << fit_text(result);
  if (result.status != FitStatus::converged) {
    std::cerr << stream.source << ": " << to_string(result.status) << ": " << result.message
              << '\n';
    return numerical;
  }
  return done;
}

}  // namespace

void add_fit(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand("fit", "associate a surface with a probe stream");
  auto options = std::make_shared<Options>();
  options->stream.add_to(*command);
  std::vector<std::string> surfaces;
  for (const SurfaceInfo& info : surface_catalogue()) surfaces.emplace_back(info.id);
  command->add_option("--surface", options->fit.surface, "reference surface")
      ->required()
      ->check(CLI::IsMember(surfaces));
  command->add_option("--loss", options->loss, "plain (default), huber or tukey")
      ->check(CLI::IsMember({"plain", "huber", "tukey"}));
  command->add_flag("--bore", options->fit.bore, "probed from inside");
  command
      ->add_option("--ball-radius", options->fit.ball_radius_mm,
                   "X_M is the centre of a ball of this radius, mm")
      ->check(a_length());
  command
      ->add_option("--noise", options->noise_um, "standard deviation of one reading if known, µm")
      ->check(a_length());
  command->add_option("--coverage-factor", options->fit.coverage_factor, "k of U = k u (2)")
      ->check(number_in(0.0, true, 100.0, "a number above 0, up to 100"));
  command->add_option("--json", options->json, "write the result here, '-' prints it");
  command->add_option("--residuals", options->residuals,
                      "write every reading with its residual here (CSV)");
  command->callback([options, &exit_code] {
    if (!options->json.empty() && options->json == options->residuals)
      throw CLI::ValidationError("--residuals", "cannot go where --json goes");
    exit_code = execute(*options);
  });
}

}  // namespace trueaxis::cli

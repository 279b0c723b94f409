// SPDX-License-Identifier: Apache-2.0
#include "trueaxis/fit/fit.hpp"

#include <iostream>
#include <map>
#include <memory>

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

struct Options {
  StreamOptions stream;
  FitOptions fit;
  std::string json, residuals;
  double noise_um = -1.0;
};

int execute(const Options& options) {
  const ProbeStream stream = options.stream.read();
  FitOptions fit_options = options.fit;
  if (options.noise_um >= 0.0) fit_options.noise_mm = options.noise_um * mm_per_um;
  const FitResult result = fit(stream, fit_options);
  if (result.status == FitStatus::too_few) throw InputError(stream.source, result.message + ": probe more");
  if (!options.json.empty()) write_file(options.json, fit_json(result));
  if (!options.residuals.empty()) write_file(options.residuals, residuals_csv(stream, result));
  if (options.json != "-" && options.residuals != "-") std::cout << fit_text(result);
  if (result.status != FitStatus::converged) {
    std::cerr << stream.source << ": " << to_string(result.status) << ": " << result.message << '\n';
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
  command->add_option("--surface", options->fit.surface, "reference surface")->required()->check(CLI::IsMember(surfaces));
  static const std::map<std::string, Loss> losses{{"plain", Loss::plain}, {"huber", Loss::huber}, {"tukey", Loss::tukey}};
  command->add_option("--loss", options->fit.loss, "plain (default), huber or tukey")->transform(CLI::CheckedTransformer(losses));
  command->add_flag("--bore", options->fit.bore, "probed from inside");
  command->add_option("--ball-radius", options->fit.ball_radius_mm, "X_M is the centre of a ball of this radius, mm")
      ->check(CLI::NonNegativeNumber);
  command->add_option("--noise", options->noise_um, "standard deviation of one reading if known, µm")
      ->check(CLI::NonNegativeNumber);
  command->add_option("--coverage-factor", options->fit.coverage_factor, "k of U = k u (2)")->check(CLI::PositiveNumber);
  command->add_option("--json", options->json, "write the result here, '-' prints it");
  command->add_option("--residuals", options->residuals, "write every reading with its residual here (CSV)");
  command->callback([options, &exit_code] { exit_code = execute(*options); });
}

}  // namespace trueaxis::cli

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "cli/results.hpp"
#include "cli/stream_options.hpp"

namespace trueaxis::cli {

/// `fit --criterion`: the readings as points, associated by another criterion than along the probe
/// line.
struct FitCriterion {
  std::string name = "probe";

  /// With the certificate among the results of the command.
  void add_to(CLI::App& command, Results& results);
  bool along_probe() const { return name == "probe"; }

  /// @throws CLI::ValidationError for what does not go with it
  void expect_fitting(const AssociationOptions& association, const Results& results,
                      const CLI::App& command) const;

  int execute(const StreamOptions& stream, const AssociationOptions& association,
              Results& results) const;
};

}  // namespace trueaxis::cli

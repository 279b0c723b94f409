// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "cli/results.hpp"
#include "cli/stream_options.hpp"

namespace trueaxis::cli {

/// `fit --points`: a geometrical element through Cartesian points.
struct FitPoints {
  std::string path, element, material, unit, array;
  int threads = 0;

  /// With the files that only points have among the results of the command.
  void add_to(CLI::App& command, Results& results);

  /// `stream` is the file by its place, which holds points if an element is named.
  bool asked() const { return !path.empty() || !element.empty(); }

  /// @throws CLI::ValidationError for what does not go with points, or needs them
  void expect_fitting(const CLI::App& command, const std::string& criterion) const;

  int execute(const std::string& criterion, const Results& results, bool check) const;
};

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

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "cli/results.hpp"
#include "cli/stream_options.hpp"

namespace trueaxis::cli {

struct RunArguments {
  StreamOptions stream;  ///< `path` is the job's, or a stream's
  AssociationOptions association;
  CLI::Option* surface = nullptr;
  std::string folder;
  std::string previous;  ///< result.json of the part before; empty: none
  Results results;
  bool force = false, verbose = false, check = false;
};

/// The command of this name, with its screen and files; what it ends with.
int run(const RunArguments& options);

}  // namespace trueaxis::cli

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

/// The names that commands and options had before 0.1.0. They work for one release.
namespace trueaxis::cli {

struct NewNames {
  std::vector<std::string> words;  ///< the command line in today's names, without "trueaxis"
  std::string notes;               ///< a line for each old name, empty: no old name
};

NewNames with_new_names(std::vector<std::string> words);

}  // namespace trueaxis::cli

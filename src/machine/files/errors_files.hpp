// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "machine/files/machine_toml.hpp"

namespace trueaxis {

/// What is to be said of errors files that do not say it.
struct ErrorsFiles {
  std::optional<ErrorSign> foreign_sign{};  ///< of component errors in ISG and Etalon files
  bool large_errors = false;  ///< they are larger than machines have (error_sizes.hpp), and meant
};

/// Whether a file is `trueaxis.errors/1`: by its name, `.toml`, or by what it says of itself.
bool is_errors_toml(const std::string& path);

struct ErrorsOfFiles {
  ErrorModel errors;
  std::vector<std::string> hashes;   ///< of each file, of the bytes that were read
  std::vector<std::string> remarks;  ///< what the files do not say, such as their machine
};

/// The errors of all files together, and those of a D-H machine's own parameters: entries of one
/// name add, and so do covariances, each file's being independent of the others'. is_errors_toml()
/// is `trueaxis.errors/1`, `.csv` the ISG table, any other name the Etalon exchange format; the
/// last two do not say their sign, `said` does.
/// @throws InputError with every diagnostic of every file; where component errors come from two.
ErrorsOfFiles read_errors_files(std::span<const std::string> paths, const MachineFile& machine,
                                const ErrorsFiles& said = {});

/// The errors alone.
ErrorModel read_errors(std::span<const std::string> paths, const MachineFile& machine,
                       const ErrorsFiles& said = {});

}  // namespace trueaxis

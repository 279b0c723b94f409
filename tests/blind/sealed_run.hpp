// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "blind/blind_case.hpp"

namespace trueaxis::blind {

/// What the command said of a stream, as far as it is judged.
struct Answer {
  int exit_code = -1;
  std::string text;                                ///< of a crash
  std::vector<std::vector<std::string>> classes;   ///< of the causes, the named one first
  std::vector<std::vector<double>> probabilities;  ///< of the members of the classes
  std::vector<std::string> separators;   ///< of each class: its separate_with.plan, or empty
  std::vector<std::string> unexplained;  ///< "3 UPR, constant along Z"
  std::map<std::string, std::string> not_observable;  ///< id → measurement that would show it
  double threshold = 0.0;  ///< of a statistic with two degrees of freedom
  double seconds = 0.0;    ///< of the process

  bool broken() const { return exit_code != 0; }
};

Answer read_answer(const nlohmann::json& json);

/// The truth as it was sealed before the command ran.
struct Sealed {
  Kind kind = Kind::null;
  std::vector<Effect> effects;
  double sigma_mm = 0.0;
};

/// Writes FOLDER/stream.csv for the command and FOLDER.truth.json, which it is not told of.
void write_sealed(const BlindCase& blind_case, const std::filesystem::path& folder);
Sealed open_truth(const std::filesystem::path& folder);

/// Runs `command diagnose FOLDER/stream.csv --surface …` as a process of its own; without a command
/// the same diagnosis here, which saves the form and the start of a process.
Answer run_command(const std::string& command, const std::filesystem::path& folder,
                   SurfaceId surface);

}  // namespace trueaxis::blind

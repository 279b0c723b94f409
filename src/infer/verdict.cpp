// SPDX-License-Identifier: Apache-2.0
#include "trueaxis/inference.hpp"

namespace trueaxis {

std::vector<std::string> NamedFinding::members_beside(std::string_view name) const {
  std::vector<std::string> ids{std::string(name)};
  for (const Rival& rival : rivals) ids.push_back(rival.effect);
  return ids;
}

DiagnosisVerdict verdict_of(bool found, bool unexplained) {
  return unexplained ? DiagnosisVerdict::unexplained
         : found     ? DiagnosisVerdict::effects
                     : DiagnosisVerdict::ideal;
}

const char* to_string(DiagnosisVerdict verdict) {
  static constexpr const char* words[] = {"ideal", "effects", "unexplained"};
  return words[static_cast<std::size_t>(verdict)];
}

}  // namespace trueaxis

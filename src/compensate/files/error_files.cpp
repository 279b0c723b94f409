// SPDX-License-Identifier: Apache-2.0
#include "compensate/files/error_files.hpp"

#include <algorithm>
#include <utility>

#include "machine/files/errors_toml.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis {
namespace {

bool has_component(const ErrorModel& errors) {
  return std::ranges::any_of(errors.terms,
                             [](const ErrorTerm& term) { return term.name.component; });
}

}  // namespace

ErrorModel read_errors(const std::vector<std::string>& paths, const MachineFile& machine) {
  ErrorModel sum = machine.parameter_errors;
  std::string of_components;
  std::vector<Diagnostic> wrong;
  for (const std::string& path : paths) {
    ErrorModel errors;
    try {
      errors = read_errors_toml(path, machine.machine);
    } catch (const InputError& error) {
      wrong.insert(wrong.end(), error.diagnostics().begin(), error.diagnostics().end());
      continue;
    }
    if (has_component(errors)) {
      if (!of_components.empty())
        wrong.push_back({path, 0, 0,
                         "has component errors, and so has " + of_components +
                             ": put them into one file, whose sign and pivots they share"});
      of_components = path;
      sum.sign = errors.sign;
      sum.reference_mm = errors.reference_mm;
    }
    std::ranges::move(errors.terms, std::back_inserter(sum.terms));
  }
  if (!wrong.empty()) throw InputError(std::move(wrong));
  return sum;
}

}  // namespace trueaxis

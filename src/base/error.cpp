// SPDX-License-Identifier: Apache-2.0
#include "trueaxis/error.hpp"

#include <utility>

namespace trueaxis {
namespace {

std::string join(const std::vector<Diagnostic>& diagnostics) {
  std::string text;
  for (const Diagnostic& diagnostic : diagnostics) {
    if (!text.empty()) text += '\n';
    text += to_string(diagnostic);
  }
  return text;
}

}  // namespace

std::string to_string(const Diagnostic& diagnostic) {
  std::string text = diagnostic.file;
  if (diagnostic.line != 0) text += ':' + std::to_string(diagnostic.line);
  if (diagnostic.line != 0 && diagnostic.column != 0)
    text += ':' + std::to_string(diagnostic.column);
  return text + (text.empty() ? "" : ": ") + diagnostic.message;
}

InputError::InputError(std::vector<Diagnostic> diagnostics)
    : std::runtime_error(join(diagnostics)), diagnostics_(std::move(diagnostics)) {}

InputError::InputError(std::string file, std::string message)
    : InputError(std::vector<Diagnostic>{{std::move(file), 0, 0, std::move(message)}}) {}

void expects(bool condition, const char* contract, const char* function) {
  if (!condition) {
    throw ContractViolation(std::string(function) + ": expects " + contract);
  }
}

}  // namespace trueaxis

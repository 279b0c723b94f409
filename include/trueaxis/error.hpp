// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>
#include <vector>

namespace trueaxis {

/// One thing that is wrong with an input, where it is, and what to do about it.
struct Diagnostic {
  std::string file;        ///< empty: what was given is in no file
  std::size_t line = 0;    ///< 1-based; 0: the file as a whole
  std::size_t column = 0;  ///< 1-based character; 0: the line as a whole
  std::string message;
};

/// "file:line:column: message", without the parts that are 0.
std::string to_string(const Diagnostic& diagnostic);

/// Bad input, thrown once after all diagnostics of the input are collected.
class InputError : public std::runtime_error {
 public:
  explicit InputError(std::vector<Diagnostic> diagnostics);
  InputError(std::string file, std::string message);
  const std::vector<Diagnostic>& diagnostics() const { return diagnostics_; }

 private:
  std::vector<Diagnostic> diagnostics_;
};

/// A job that is understood but must not be carried out (an actuator that cannot follow).
class Refusal : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A caller broke the contract of a function: a bug.
class ContractViolation : public std::logic_error {
 public:
  using std::logic_error::logic_error;
};

/// Throws ContractViolation in every build unless `condition` holds. (The builtin is
/// std::source_location without its header, which clang 14's tools cannot read.)
void expects(bool condition, const char* contract, const char* function = __builtin_FUNCTION());

}  // namespace trueaxis

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <regex>
#include <string>

namespace trueaxis::testing {

/// A program without its comments: in ( ), and after a semicolon.
inline std::string without_comments(const std::string& program) {
  return std::regex_replace(program, std::regex(R"(\([^)\n]*\)|;[^\n]*)"), "");
}

}  // namespace trueaxis::testing

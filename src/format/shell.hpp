// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace trueaxis {

/// A word of a command line as a POSIX shell reads it: in single quotes if it has blanks or
/// anything else that a shell does not read literally.
std::string shell_quoted(std::string_view word);

/// The words with blanks between them, each quoted where need be.
std::string shell_line(const std::vector<std::string>& words);

}  // namespace trueaxis

// SPDX-License-Identifier: Apache-2.0
#include "format/path_text.hpp"

#include <algorithm>

namespace trueaxis {

namespace fs = std::filesystem;

std::string path_text(const fs::path& path) {
  std::string text = path.string();
  constexpr auto separator = static_cast<char>(fs::path::preferred_separator);
  std::ranges::replace(text, separator, '/');
  return text;
}

std::string path_next_to(const std::string& file, const std::string& name) {
  const fs::path path = fs::path(file).parent_path() / name;
  const std::string shortest = path_text(path.lexically_normal());
  // A path of the network begins with two, of which lexically_normal leaves one.
  const bool of_network = path_text(path).starts_with("//") && !shortest.starts_with("//");
  return of_network ? '/' + shortest : shortest;
}

}  // namespace trueaxis

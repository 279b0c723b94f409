// SPDX-License-Identifier: Apache-2.0
#include "format/toml_header.hpp"

namespace trueaxis {

std::vector<std::pair<std::string, std::string>> read_header(TomlTable root) {
  constexpr std::pair<const char*, const char*> known[] = {
      {"part", "Part"},       {"serial", "Serial number"}, {"operator", "Operator"},
      {"machine", "Machine"}, {"probe", "Probe"},          {"date", "Date"}};
  std::vector<std::pair<std::string, std::string>> header;
  auto table = root.maybe_table("header");
  if (!table) return header;
  for (const auto& [key, label] : known)
    if (std::string text = table->text(key); !text.empty())
      header.emplace_back(label, std::move(text));
  return header;
}

}  // namespace trueaxis

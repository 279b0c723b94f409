// SPDX-License-Identifier: Apache-2.0
#include "format/toml_header.hpp"

#include <algorithm>

namespace trueaxis {
namespace {

constexpr std::pair<const char*, const char*> known[] = {
    {"part", "Part"},       {"serial", "Serial number"}, {"operator", "Operator"},
    {"machine", "Machine"}, {"probe", "Probe"},          {"date", "Date"}};

}  // namespace

std::vector<std::pair<std::string, std::string>> read_header(TomlTable root) {
  std::vector<std::pair<std::string, std::string>> header;
  auto table = root.maybe_table("header");
  if (!table) return header;
  for (const auto& [key, label] : known) {
    std::string text =
        std::string_view(key) == "date" ? table->text_or_date(key) : table->text(key);
    if (!text.empty()) header.emplace_back(label, std::move(text));
  }
  return header;
}

Json header_object(const std::vector<std::pair<std::string, std::string>>& header) {
  Json object = Json::object();
  for (const auto& [label, text] : header) {
    const auto* const place = std::ranges::find(
        known, label, [](const auto& one) { return std::string_view(one.second); });
    object[place == std::end(known) ? label : place->first] = text;
  }
  return object;
}

}  // namespace trueaxis

// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include "base/text.hpp"
#include "format/outputs.hpp"

namespace trueaxis {
namespace {

constexpr std::string_view ours = "trueaxis.";

/// The name in front of the version, such as trueaxis.fit/1; empty: there is none.
std::string_view schema_at(std::string_view text) {
  const std::size_t end = text.find_first_not_of("abcdefghijklmnopqrstuvwxyz_", ours.size());
  const bool named = text.starts_with(ours) && end != text.npos && end > ours.size();
  return named && text[end] == '/' ? text.substr(0, end) : "";
}

std::string_view schema_of_json(std::string_view text) {
  for (const std::string_view word : {"{", "\"schema\"", ":", "\""}) {
    text = trimmed(text, blanks_of_text);
    if (!take_word(text, word)) return "";
  }
  return schema_at(text);
}

/// Of the last of the comments in front of a table that says one.
std::string_view schema_of_table(std::string_view text) {
  std::string_view found;
  while (text.starts_with('#')) {
    std::string_view line = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(line.size() + 1, text.size()));
    while (take_word(line, "#")) continue;
    const std::string_view said = take_word(line, " schema: ") ? schema_at(line) : "";
    if (!said.empty()) found = said;
  }
  return found;
}

std::string_view schema_of_page(std::string_view text) {
  constexpr std::string_view says = "<meta name=\"generator\" content=\"";
  std::size_t at = text.starts_with("<!doctype html>") ? text.rfind(says) : text.npos;
  for (; at != text.npos && at > 0; at = text.rfind(says, at - 1)) {
    const std::string_view found = schema_at(text.substr(at + says.size()));
    if (!found.empty()) return found;
  }
  return "";
}

}  // namespace

std::string schema_in(std::string_view head) {
  if (head.starts_with("PK\x03\x04") && head.find("main.xml") == 30)  // a packed X3P
    head = head.substr(std::min(head.find("<?xml"), head.size()));
  if (head.starts_with("<?xml")) head = head.substr(std::min(head.find('\n'), head.size() - 1) + 1);
  // FANUC's programs begin with a % and their number, HEIDENHAIN's with their name.
  for (const char* first : {"%\n", "O", "0 BEGIN PGM "})
    if (head.starts_with(first)) head = head.substr(std::min(head.find('\n'), head.size() - 1) + 1);
  for (const auto of : {schema_of_json, schema_of_table, schema_of_page})
    if (const std::string_view found = of(head); !found.empty()) return std::string(found);
  for (const char* comment :
       {"// schema: ", "<!-- schema: ", "; schema: ", "1 ; schema: ", "( schema: "})
    if (take_word(head, comment)) return std::string(schema_at(head));
  return "";
}

std::string schema_of_file(const std::string& path) {
  std::ifstream in(std::filesystem::path(path), std::ios::binary);
  std::array<char, 512> head{};
  in.read(head.data(), head.size());
  return schema_in({head.data(), static_cast<std::size_t>(in.gcount())});
}

}  // namespace trueaxis

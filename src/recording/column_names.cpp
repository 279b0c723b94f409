// SPDX-License-Identifier: Apache-2.0
#include "recording/column_names.hpp"

#include <algorithm>
#include <cctype>
#include <span>

#include "measure/files/stream_csv_number.hpp"

namespace trueaxis {
namespace {

struct Name {
  std::string_view folded;
  NamedRole is;
};

constexpr Name names[] = {
    {"xm", {RecordedRole::x}},
    {"x", {RecordedRole::x}},
    {"xpos", {RecordedRole::x}},
    {"xposition", {RecordedRole::x}},
    {"xachse", {RecordedRole::x}},
    {"xaxis", {RecordedRole::x}},
    {"xist", {RecordedRole::x}},
    {"xact", {RecordedRole::x}},
    {"xactual", {RecordedRole::x}},
    {"xactpos", {RecordedRole::x}},
    {"radius", {RecordedRole::x, false}},
    {"r", {RecordedRole::x, false}},
    {"xradius", {RecordedRole::x, false}},
    {"diameter", {RecordedRole::x, true}},
    {"durchmesser", {RecordedRole::x, true}},
    {"dia", {RecordedRole::x, true}},
    {"diam", {RecordedRole::x, true}},
    {"ø", {RecordedRole::x, true}},
    {"⌀", {RecordedRole::x, true}},
    {"xdiameter", {RecordedRole::x, true}},
    {"xdia", {RecordedRole::x, true}},
    {"indicator", {RecordedRole::x, false, true}},
    {"gauge", {RecordedRole::x, false, true}},
    {"messuhr", {RecordedRole::x, false, true}},
    {"runout", {RecordedRole::x, false, true}},
    {"zm", {RecordedRole::face}},
    {"c", {RecordedRole::c}},
    {"cpos", {RecordedRole::c}},
    {"cposition", {RecordedRole::c}},
    {"cachse", {RecordedRole::c}},
    {"caxis", {RecordedRole::c}},
    {"cist", {RecordedRole::c}},
    {"cact", {RecordedRole::c}},
    {"cactual", {RecordedRole::c}},
    {"cactpos", {RecordedRole::c}},
    {"angle", {RecordedRole::c}},
    {"winkel", {RecordedRole::c}},
    {"spindleangle", {RecordedRole::c}},
    {"spindelwinkel", {RecordedRole::c}},
    {"theta", {RecordedRole::c}},
    {"z", {RecordedRole::z}},
    {"zpos", {RecordedRole::z}},
    {"zposition", {RecordedRole::z}},
    {"zachse", {RecordedRole::z}},
    {"zaxis", {RecordedRole::z}},
    {"zist", {RecordedRole::z}},
    {"zact", {RecordedRole::z}},
    {"zactual", {RecordedRole::z}},
    {"zactpos", {RecordedRole::z}},
    {"y", {RecordedRole::y}},
    {"ypos", {RecordedRole::y}},
    {"yachse", {RecordedRole::y}},
    {"yaxis", {RecordedRole::y}},
    {"t", {RecordedRole::t}},
    {"time", {RecordedRole::t}},
    {"zeit", {RecordedRole::t}},
    {"timestamp", {RecordedRole::t}},
    {"elapsed", {RecordedRole::t}},
    {"pass", {RecordedRole::pass}},
    {"durchgang", {RecordedRole::pass}},
    {"setup", {RecordedRole::setup}},
    {"aufspannung", {RecordedRole::setup}},
};

/// Small letters without blanks, '_' and '-'.
std::string folded(std::string_view name) {
  std::string out;
  for (const char c : name)
    if (c != ' ' && c != '_' && c != '-')
      out += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  // The one capital of the list that is not ASCII.
  if (const auto at = out.find("Ø"); at != std::string::npos) out.replace(at, 2, "ø");
  return out;
}

CsvQuantity quantity_of(RecordedRole role) {
  return role == RecordedRole::c                                     ? CsvQuantity::angle
         : role == RecordedRole::t                                   ? CsvQuantity::time
         : role == RecordedRole::pass || role == RecordedRole::setup ? CsvQuantity::count
                                                                     : CsvQuantity::length;
}

}  // namespace

std::optional<NamedRole> role_of_name(std::string_view name) {
  const auto look_up = [](std::string_view text) -> std::optional<NamedRole> {
    const std::string key = folded(text);
    const auto* found = std::ranges::find(names, key, &Name::folded);
    return found == std::end(names) ? std::nullopt : std::optional(found->is);
  };
  if (const auto whole = look_up(name)) return whole;
  const std::size_t part = name.find_last_of(":.");
  return part == std::string_view::npos ? std::nullopt : look_up(name.substr(part + 1));
}

std::optional<RecordedRole> role_of_word(std::string_view word) {
  constexpr std::pair<std::string_view, RecordedRole> words[] = {
      {"x", RecordedRole::x}, {"xm", RecordedRole::x},      {"zm", RecordedRole::face},
      {"c", RecordedRole::c}, {"z", RecordedRole::z},       {"y", RecordedRole::y},
      {"t", RecordedRole::t}, {"pass", RecordedRole::pass}, {"setup", RecordedRole::setup}};
  const std::string key = folded(word);
  for (const auto& [name, role] : words)
    if (name == key) return role;
  return {};
}

const char* word_of(RecordedRole role) {
  constexpr const char* words[] = {"X", "Z_M", "C", "Z", "Y", "t", "pass", "setup"};
  return words[static_cast<std::size_t>(role)];
}

std::optional<std::string> stream_unit(RecordedRole role, std::string_view unit) {
  const CsvQuantity quantity = quantity_of(role);
  std::string text(csv_trimmed(unit));
  std::string dia;
  for (const std::string_view word : {" dia", " diameter", " Ø"}) {
    if (quantity != CsvQuantity::length || !text.ends_with(word)) continue;
    text.erase(text.size() - word.size());
    dia = " dia";
  }
  constexpr std::pair<std::string_view, std::string_view> others[] = {
      {"°", "deg"},     {"degree", "deg"}, {"degrees", "deg"}, {"º", "deg"}, {"turns", "rev"},
      {"MM", "mm"},     {"\"", "in"},      {"inches", "in"},   {"sec", "s"}, {"msec", "ms"},
      {"micron", "um"}, {"microns", "um"}, {"µm", "um"},       {"μm", "um"}, {"Deg", "deg"}};
  for (const auto& [from, to] : others)
    if (text == from) text = to;
  if (quantity == CsvQuantity::count) return text.empty() ? std::optional(text) : std::nullopt;
  return csv_find_unit(quantity, text) ? std::optional(text + dia) : std::nullopt;
}

const char* default_unit(RecordedRole role) {
  constexpr const char* units[] = {"mm", "deg", "s", ""};
  return units[static_cast<std::size_t>(quantity_of(role))];
}

}  // namespace trueaxis

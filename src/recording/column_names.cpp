// SPDX-License-Identifier: Apache-2.0
#include "recording/column_names.hpp"

#include "format/folded.hpp"
#include "format/units.hpp"
#include "recording/header_words.hpp"

namespace trueaxis {
namespace {

/// What the words of a name make of a column; nothing where they do not say which.
std::optional<NamedRole> role_of(const HeaderName& name) {
  using enum HeaderMeaning;
  static constexpr struct {
    HeaderMeaning meaning;
    char axis;  ///< that the name may have as well
    RecordedRole role;
    std::optional<bool> diameter{};
    bool gauge = false;
  } known[] = {{radius, 'x', RecordedRole::x, false},
               {diameter, 'x', RecordedRole::x, true},
               {HeaderMeaning::gauge, 'x', RecordedRole::x, false, true},
               {angle, 'c', RecordedRole::c},
               {face, 'z', RecordedRole::face},
               {time, 0, RecordedRole::t},
               {pass, 0, RecordedRole::pass},
               {setup, 0, RecordedRole::setup}};
  if (!name.meaning) {
    if (name.axis == 0 && !name.position) return {};
    NamedRole role{name.axis == 'x'   ? RecordedRole::x
                   : name.axis == 'c' ? RecordedRole::c
                   : name.axis == 'y' ? RecordedRole::y
                                      : RecordedRole::z};
    role.vague = name.axis == 0;
    role.language = name.language;
    return role;
  }
  for (const auto& one : known)
    if (one.meaning == *name.meaning && (name.axis == 0 || name.axis == one.axis))
      return NamedRole{one.role, one.diameter, one.gauge, false, name.language};
  return {};
}

UnitKind quantity_of(RecordedRole role) {
  return role == RecordedRole::c                                     ? UnitKind::angle
         : role == RecordedRole::t                                   ? UnitKind::time
         : role == RecordedRole::pass || role == RecordedRole::setup ? UnitKind::count
                                                                     : UnitKind::length;
}

}  // namespace

std::optional<NamedRole> role_of_name(std::string_view name) {
  const auto look_up = [](std::string_view text) -> std::optional<NamedRole> {
    if (trimmed(text) == "T") return {};  // a tool of a control, a temperature of a logger
    const auto words = read_header_name(text);
    return words ? role_of(*words) : std::nullopt;
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
  std::string key = folded(word);
  std::erase_if(key, [](char c) { return c == ' ' || c == '_' || c == '-'; });
  for (const auto& [name, role] : words)
    if (name == key) return role;
  return {};
}

const char* word_of(RecordedRole role) {
  constexpr const char* words[] = {"X", "Z_M", "C", "Z", "Y", "t", "pass", "setup"};
  return words[static_cast<std::size_t>(role)];
}

std::optional<std::string> stream_unit(RecordedRole role, std::string_view unit,
                                       std::string_view language) {
  const UnitKind quantity = quantity_of(role);
  std::string_view text = trimmed(unit);
  if (quantity == UnitKind::count)
    return text.empty() ? std::optional(std::string()) : std::nullopt;
  std::string dia;
  if (const std::size_t blank = text.rfind(' '); blank != std::string_view::npos) {
    const auto last = read_header_name(text.substr(blank + 1));
    if (quantity == UnitKind::length && last && last->meaning == HeaderMeaning::diameter) {
      text = text.substr(0, blank);
      dia = " dia";
    }
  }
  const auto known = unit_of_word(text, language);
  return known && find_unit(quantity, *known) ? std::optional(*known + dia) : std::nullopt;
}

const char* default_unit(RecordedRole role) {
  constexpr const char* units[] = {"mm", "deg", "s", ""};
  return units[static_cast<std::size_t>(quantity_of(role))];
}

}  // namespace trueaxis

// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "base/edit_distance.hpp"
#include "effect/entries.hpp"
#include "trueaxis/effect.hpp"

namespace trueaxis {
namespace {

constexpr Separator separator_list[] = {
    {"RV", "the same pass with the spindle reversed"},
    {"RZ", "a return pass in -Z"},
    {"2W", "the same pass at a second spindle speed, best in an irrational ratio"},
    {"DW", "a dwell: turns at constant Z"},
    {"ST", "a capture with the spindle standing still"},
    {"RC", "the part re-indexed against the spindle and probed again"},
    {"RE", "probing from the rear side"},
    {"MS", "a master cylinder or ball of known size"},
    {"OZ", "the part shifted along Z and probed again"},
    {"RM", "re-clamped with less force and probed again"},
    {"XJ", "a known jog of the X axis"},
};

std::string_view after_family(std::string_view id) { return id.substr(id.find('.') + 1); }

// The name alone counts too: the family is often not remembered.
std::size_t unlikeness(std::string_view asked, std::string_view id) {
  return std::min(edit_distance(asked, id),
                  edit_distance(after_family(asked), after_family(id)) + 1);
}

}  // namespace

std::span<const Effect> effect_catalogue() {
  static const std::vector<Effect> all = [] {
    std::vector<Effect> list;
    for (const auto family : {entries::part_roundness, entries::part_profile, entries::spindle,
                              entries::slide, entries::probe_geometry, entries::probe_response,
                              entries::encoder_and_time, entries::checks}) {
      for (Effect& effect : family()) list.push_back(std::move(effect));
    }
    return list;
  }();
  return all;
}

const Effect* find_effect(std::string_view id) {
  for (const Effect& effect : effect_catalogue()) {
    if (effect.id == id) return &effect;
  }
  return nullptr;
}

std::vector<std::string_view> nearest_effects(std::string_view id, std::size_t count) {
  std::vector<std::string_view> ids;
  for (const Effect& effect : effect_catalogue()) ids.push_back(effect.id);
  std::stable_sort(ids.begin(), ids.end(), [&](std::string_view a, std::string_view b) {
    return unlikeness(id, a) < unlikeness(id, b);
  });
  ids.resize(std::min(count, ids.size()));
  return ids;
}

std::span<const Separator> separators() { return separator_list; }

std::string_view to_string(Slot slot) {
  switch (slot) {
    case Slot::arguments:
      return "A";
    case Slot::probe_line:
      return "B";
    case Slot::part:
      return "C";
    case Slot::machine:
      return "D";
    case Slot::sensor:
      return "E";
    case Slot::noise:
      break;
  }
  return "noise";
}

std::string_view to_string(Frame frame) {
  switch (frame) {
    case Frame::part:
      return "part";
    case Frame::chuck:
      return "chuck";
    case Frame::spindle:
      return "spindle";
    case Frame::machine:
      return "machine";
    case Frame::probe:
      return "probe";
    case Frame::time:
      break;
  }
  return "time";
}

}  // namespace trueaxis

// SPDX-License-Identifier: Apache-2.0
#include "format/toml_units.hpp"

#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

struct UnitKind {
  std::string_view inside;
  std::vector<KeySpelling> spellings;  // the usual one first
};

// Longer suffixes first: "_mm_per_s" also ends in "_s".
const std::vector<UnitKind>& unit_kinds() {
  static const std::vector<UnitKind> kinds{
      {"_mm_per_rev",
       {{"_mm_per_rev", 1.0}, {"_um_per_rev", mm_per_um}, {"_in_per_rev", mm_per_inch}}},
      {"_mm_per_s",
       {{"_mm_per_s", 1.0},
        {"_um_per_s", mm_per_um},
        {"_mm_per_min", 1.0 / 60.0},
        {"_um_per_min", mm_per_um / 60.0}}},
      {"_mm", {{"_mm", 1.0}, {"_um", mm_per_um}, {"_in", mm_per_inch}, {"_m", mm_per_m}}},
      {"_rad",
       {{"_deg", rad_per_deg},
        {"_rad", 1.0},
        {"_mrad", 1e-3},
        {"_urad", 1e-6},
        {"_arcsec", rad_per_deg / 3600.0}}},
      {"_hz", {{"_hz", 1.0}, {"_khz", 1e3}}},
      {"_s", {{"_s", 1.0}, {"_ms", 1e-3}, {"_us", 1e-6}, {"_min", 60.0}}},
  };
  return kinds;
}

}  // namespace

std::vector<KeySpelling> key_spellings(std::string_view key) {
  for (const UnitKind& kind : unit_kinds()) {
    if (!key.ends_with(kind.inside)) continue;
    const std::string stem(key.substr(0, key.size() - kind.inside.size()));
    std::vector<KeySpelling> spellings = kind.spellings;
    for (KeySpelling& spelling : spellings) spelling.key.insert(0, stem);
    return spellings;
  }
  return {{std::string(key), 1.0}};
}

KeyParts parts_of_key(std::string_view key) {
  std::string_view unit;
  for (const UnitKind& kind : unit_kinds())
    for (const KeySpelling& spelling : kind.spellings)
      if (key.ends_with(spelling.key) && spelling.key.size() > unit.size())
        unit = key.substr(key.size() - spelling.key.size());
  return {key.substr(0, key.size() - unit.size()), unit};
}

}  // namespace trueaxis

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <numbers>
#include <optional>
#include <string_view>

#include "trueaxis/units.hpp"

namespace trueaxis {

/// What a column measures; `count` has no unit.
enum class CsvQuantity { length, angle, time, count };

/// A unit at the edge: value inside = value outside × factor (mm, rad, s); `turn` is one turn in an
/// angle's unit.
struct CsvUnit {
  std::string_view name;
  CsvQuantity quantity;
  double factor;
  double turn = 0.0;
};

/// Micro is U+00B5 or U+03BC in UTF-8, or the byte B5 of a Latin-1 file.
inline constexpr CsvUnit csv_units[] = {
    {"mm", CsvQuantity::length, 1.0},
    {"um", CsvQuantity::length, mm_per_um},
    {"\xC2\xB5m", CsvQuantity::length, mm_per_um},
    {"\xCE\xBCm", CsvQuantity::length, mm_per_um},
    {"\xB5m", CsvQuantity::length, mm_per_um},
    {"m", CsvQuantity::length, mm_per_m},
    {"in", CsvQuantity::length, mm_per_inch},
    {"inch", CsvQuantity::length, mm_per_inch},
    {"deg", CsvQuantity::angle, rad_per_deg, 360.0},
    {"rad", CsvQuantity::angle, 1.0, two_pi},
    {"rev", CsvQuantity::angle, two_pi, 1.0},
    {"s", CsvQuantity::time, 1.0},
    {"ms", CsvQuantity::time, 1e-3},
};

inline std::optional<CsvUnit> csv_find_unit(CsvQuantity quantity, std::string_view name) {
  for (const CsvUnit& unit : csv_units) {
    if (unit.quantity == quantity && unit.name == name) return unit;
  }
  return std::nullopt;
}

/// The known units of a quantity, for a diagnostic.
inline const char* csv_known_units(CsvQuantity quantity) {
  switch (quantity) {
    case CsvQuantity::length:
      return "mm, um, µm, m or in";
    case CsvQuantity::angle:
      return "deg, rad or rev";
    case CsvQuantity::time:
      return "s or ms";
    case CsvQuantity::count:
      break;
  }
  return "no unit";
}

}  // namespace trueaxis

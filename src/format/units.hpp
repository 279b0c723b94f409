// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace trueaxis {

/// What a column or a key measures; `count` has no unit.
enum class UnitKind { length, angle, time, count, frequency, speed, feed };

/// A unit at the edge: value inside = value outside × factor (mm, rad, s, Hz).
struct Unit {
  std::string_view name;  ///< as a key of TOML ends in it: "mm_per_min"
  UnitKind kind;
  double factor;
  double turn = 0.0;      ///< one turn in an angle's unit
  bool of_column = true;  ///< may be in the header of a column
  bool of_key = true;     ///< may end a key of TOML
};

/// The unit of a column that is called so.
std::optional<Unit> find_unit(UnitKind kind, std::string_view name);

/// A unit as one of a choice of words: {"um", 1e-3}.
std::pair<std::string_view, double> unit_choice(std::string_view name);

/// The usual units of a column, for a diagnostic.
const char* known_units(UnitKind kind);

/// A finite number and what follows it.
struct NumberWithUnit {
  double value = 0.0;
  std::string_view unit;
};
std::optional<NumberWithUnit> number_with_unit(std::string_view text);

/// The largest number that is stated of readings, in the unit inside. Beyond it a double does not
/// hold a tenth of a unit, and later not even the square of the number.
inline constexpr double most_stated = 1e15;

/// The same of a quantity inside (mm, rad), up to `most_stated`; nothing without a unit of it.
std::optional<double> quantity_in(std::string_view text, UnitKind kind);

/// "X [mm]" cut apart; all of it is the name if no unit is in brackets at its end.
struct NameWithUnit {
  std::string_view name;
  std::optional<std::string_view> unit;
};
NameWithUnit name_with_unit(std::string_view text);

/// A unit as a stream writes it ("mm", "deg", "s"), for "Zoll", "µm", "°", "secondes". `language`
/// is that of the header: "Grad" is a degree in German alone. Nothing for any other word.
std::optional<std::string> unit_of_word(std::string_view word, std::string_view language = "");

/// Whether a word is a unit in any language.
bool is_unit_word(std::string_view word);

/// A spelling of a key in a file and the factor from its unit to the unit inside.
struct KeySpelling {
  std::string key;
  double factor = 1.0;
};

/// Every spelling of a key whose suffix is a unit inside ("x0_mm": x0_mm, x0_um, x0_in, x0_m), the
/// usual one first; the key itself when it has no such suffix.
std::vector<KeySpelling> key_spellings(std::string_view key);

/// A key cut before its unit: "x0", "_um"; the unit is empty where the key has none.
struct KeyParts {
  std::string_view stem, unit;
};
KeyParts parts_of_key(std::string_view key);

}  // namespace trueaxis

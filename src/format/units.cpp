// SPDX-License-Identifier: Apache-2.0
#include "format/units.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "base/number.hpp"
#include "format/csv_text.hpp"
#include "format/folded.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

// Of a kind the usual unit of a key first. Micro is U+00B5 or U+03BC in UTF-8, or the byte B5 of a
// Latin-1 file.
constexpr bool not_of_column = false, not_of_key = false;
constexpr Unit units[] = {
    {"mm", UnitKind::length, 1.0},
    {"um", UnitKind::length, mm_per_um},
    {"in", UnitKind::length, mm_per_inch},
    {"m", UnitKind::length, mm_per_m},
    {"\xC2\xB5m", UnitKind::length, mm_per_um, 0.0, true, not_of_key},
    {"\xCE\xBCm", UnitKind::length, mm_per_um, 0.0, true, not_of_key},
    {"\xB5m", UnitKind::length, mm_per_um, 0.0, true, not_of_key},
    {"inch", UnitKind::length, mm_per_inch, 0.0, true, not_of_key},
    {"deg", UnitKind::angle, rad_per_deg, 360.0},
    {"rad", UnitKind::angle, 1.0, two_pi},
    {"mrad", UnitKind::angle, 1e-3, 1e3 * two_pi},
    {"urad", UnitKind::angle, 1e-6, 1e6 * two_pi},
    {"arcsec", UnitKind::angle, rad_per_deg / 3600.0, 360.0 * 3600.0},
    {"rev", UnitKind::angle, two_pi, 1.0, true, not_of_key},
    {"s", UnitKind::time, 1.0},
    {"ms", UnitKind::time, 1e-3},
    {"us", UnitKind::time, 1e-6, 0.0, not_of_column},
    {"min", UnitKind::time, 60.0, 0.0, not_of_column},
    {"hz", UnitKind::frequency, 1.0, 0.0, not_of_column},
    {"khz", UnitKind::frequency, 1e3, 0.0, not_of_column},
    {"mm_per_s", UnitKind::speed, 1.0, 0.0, not_of_column},
    {"um_per_s", UnitKind::speed, mm_per_um, 0.0, not_of_column},
    {"mm_per_min", UnitKind::speed, 1.0 / 60.0, 0.0, not_of_column},
    {"um_per_min", UnitKind::speed, mm_per_um / 60.0, 0.0, not_of_column},
    {"mm_per_rev", UnitKind::feed, 1.0, 0.0, not_of_column},
    {"um_per_rev", UnitKind::feed, mm_per_um, 0.0, not_of_column},
    {"in_per_rev", UnitKind::feed, mm_per_inch, 0.0, not_of_column},
};

// The units inside, as keys of TOML end in them. Longer ones first: "_mm_per_s" also ends in "_s".
constexpr std::pair<std::string_view, UnitKind> units_inside[] = {
    {"_mm_per_rev", UnitKind::feed}, {"_mm_per_s", UnitKind::speed}, {"_mm", UnitKind::length},
    {"_rad", UnitKind::angle},       {"_hz", UnitKind::frequency},   {"_s", UnitKind::time}};

struct UnitWords {
  std::string_view language;  ///< the words count in headers of this language alone; empty: in all
  std::string_view unit;      ///< as a stream writes it
  std::string_view words;
};

/// What units are called. To add a language, add its words.
constexpr UnitWords unit_words[] = {
    {"", "mm",
     "mm millimeter millimeters millimetre millimetres millimètre millimètres millimetro "
     "millimetri milímetro milímetros milimetr milimetry ミリ"},
    {"", "um",
     "um µm μm micron microns micrometer micrometers micrometre micrometres mikrometer "
     "micromètre micromètres micrometro micrometri micrómetro micrómetros"},
    {"", "m", "m meter metre mètre metro metros metri"},
    {"", "in",
     "in inch inches \" zoll pouce pouces pollice pollici pulgada pulgadas polegada "
     "polegadas palec palce インチ"},
    {"", "deg",
     "° º deg degree degrees degré degrés grado gradi grados grau graus stopień stopnie "
     "stopni stupeň stupně 度"},
    {"de", "deg", "grad winkelgrad altgrad"},
    {"", "rad", "rad radian radians radiant radiante radianti radián radianes radiano radianos"},
    {"", "mrad", "mrad milliradian milliradians"},
    {"", "urad", "urad µrad microradian microradians"},
    {"", "arcsec",
     "arcsec arcsecond arcseconds bogensekunde bogensekunden winkelsekunde winkelsekunden"},
    {"", "rev", "rev turn turns umdrehung umdrehungen tour tours giri vueltas"},
    {"", "s",
     "s sec secs sek second seconds sekunde sekunden seconde secondes secondo secondi "
     "segundo segundos sekunda sekundy 秒"},
    {"", "ms", "ms msec millisecond milliseconds millisekunde millisekunden ミリ秒"},
};

}  // namespace

std::optional<Unit> find_unit(UnitKind kind, std::string_view name) {
  for (const Unit& unit : units)
    if (unit.of_column && unit.kind == kind && unit.name == name) return unit;
  return std::nullopt;
}

std::pair<std::string_view, double> unit_choice(std::string_view name) {
  return {name, std::ranges::find(units, name, &Unit::name)->factor};
}

const char* known_units(UnitKind kind) {
  static constexpr const char* names[] = {"mm, um, µm, m or in", "deg, rad or rev", "s or ms",
                                          "no unit"};
  return names[static_cast<std::size_t>(kind)];
}

std::optional<NumberWithUnit> number_with_unit(std::string_view text) {
  const auto value = take_number<double>(text);
  if (!value || !std::isfinite(*value)) return {};
  return NumberWithUnit{*value, trimmed(text)};
}

std::optional<double> quantity_in(std::string_view text, UnitKind kind) {
  const auto number = number_with_unit(text);
  if (!number) return {};
  const auto unit = find_unit(kind, number->unit);
  if (kind == UnitKind::count ? !number->unit.empty() : !unit) return {};
  const double value = kind == UnitKind::count ? number->value : number->value * unit->factor;
  return std::abs(value) <= most_stated ? std::optional(value) : std::nullopt;
}

NameWithUnit name_with_unit(std::string_view text) {
  const std::size_t open = text.find('[');
  if (open == std::string_view::npos || !text.ends_with(']')) return {text, std::nullopt};
  return {trimmed(text.substr(0, open)), trimmed(text.substr(open + 1, text.size() - open - 2))};
}

std::optional<std::string> unit_of_word(std::string_view word, std::string_view language) {
  word = trimmed(word);
  if (word.size() > 2 && word.ends_with('.')) word.remove_suffix(1);
  const std::string key = folded(word);
  if (word.size() == 1 && key != word) return {};  // "M" and "S" are not units
  static const auto known = [] {
    std::map<std::string, UnitWords, std::less<>> map;
    std::vector<std::string_view> words;
    for (const UnitWords& line : unit_words) {
      csv_split(line.words, ' ', words);
      for (const std::string_view one : words) map.try_emplace(folded(one), line);
    }
    return map;
  }();
  const auto found = known.find(key);
  if (found == known.end()) return {};
  const UnitWords& line = found->second;
  if (!line.language.empty() && language != "*" && language != line.language) return {};
  return std::string(line.unit);
}

bool is_unit_word(std::string_view word) { return unit_of_word(word, "*").has_value(); }

std::vector<KeySpelling> key_spellings(std::string_view key) {
  for (const auto& [inside, kind] : units_inside) {
    if (!key.ends_with(inside)) continue;
    const std::string stem(key.substr(0, key.size() - inside.size()));
    std::vector<KeySpelling> spellings;
    for (const Unit& unit : units)
      if (unit.of_key && unit.kind == kind)
        spellings.push_back({stem + "_" + std::string(unit.name), unit.factor});
    return spellings;
  }
  return {{std::string(key), 1.0}};
}

KeyParts parts_of_key(std::string_view key) {
  std::string_view unit;
  for (const Unit& one : units) {
    const std::string_view tail =
        key.substr(key.size() - std::min(key.size(), one.name.size() + 1));
    if (one.of_key && tail.size() > unit.size() && tail.starts_with('_') &&
        tail.substr(1) == one.name)
      unit = tail;
  }
  return {key.substr(0, key.size() - unit.size()), unit};
}

}  // namespace trueaxis

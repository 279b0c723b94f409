// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <charconv>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>

#include "measure/files/stream_csv_text.hpp"
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
  static constexpr const char* units[] = {"mm, um, µm, m or in", "deg, rad or rev", "s or ms",
                                          "no unit"};
  return units[static_cast<std::size_t>(quantity)];
}

/// Reads the number at `p`; returns where it ends, or `p` where none starts. The value is the
/// double nearest to the text. `error` is result_out_of_range as in std::from_chars.
///
/// Plain decimals of at most 18 digits whose digits stay below 2^53, with at most 22 of them behind
/// the point, are the quotient of two exact doubles, so one rounding (Clinger 1990). All else goes
/// to std::from_chars, from the start.
inline const char* csv_number(const char* p, const char* end, double& value, std::errc& error) {
  static constexpr double powers_of_ten[] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,
                                             1e7,  1e8,  1e9,  1e10, 1e11, 1e12, 1e13,
                                             1e14, 1e15, 1e16, 1e17, 1e18};
  constexpr std::uint64_t exact_below = std::uint64_t{1} << 53U;
  constexpr std::ptrdiff_t most_digits = 18;
  const char* start = p;
  const char* at = p;
  const bool plus = at < end && *at == '+';
  const bool minus = at < end && *at == '-';
  if (plus || minus) ++at;
  std::uint64_t digits = 0;
  const auto digit = [&] { return at < end ? static_cast<unsigned>(*at) - unsigned{'0'} : 10U; };
  const char* first = at;
  for (unsigned d = digit(); d < 10U; ++at, d = digit()) digits = 10U * digits + d;
  std::ptrdiff_t count = at - first, behind = 0;
  if (at < end && *at == '.') {
    first = ++at;
    for (unsigned d = digit(); d < 10U; ++at, d = digit()) digits = 10U * digits + d;
    behind = at - first;
    count += behind;
  }
  const bool exponent = at < end && (*at == 'e' || *at == 'E');
  if (count > 0 && count <= most_digits && digits < exact_below && !exponent) {
    const double magnitude = static_cast<double>(digits) / powers_of_ten[behind];
    value = minus ? -magnitude : magnitude;
    error = {};
    return at;
  }
  if (plus && (++start == end || *start == '-')) return p;
  const auto [stop, why] = std::from_chars(start, end, value);
  error = why;
  return stop == start ? p : stop;
}

/// A finite number and what follows it.
struct CsvNumberWithUnit {
  double value = 0.0;
  std::string_view unit;
};
inline std::optional<CsvNumberWithUnit> csv_number_with_unit(std::string_view text) {
  CsvNumberWithUnit out;
  std::errc error{};
  const char* end = text.data() + text.size();
  const char* stop = csv_number(text.data(), end, out.value, error);
  if (stop == text.data() || error != std::errc{} || !std::isfinite(out.value)) return {};
  out.unit = csv_trimmed({stop, static_cast<std::size_t>(end - stop)});
  return out;
}

/// The same of a quantity inside (mm, rad); nothing without a unit of it.
inline std::optional<double> csv_quantity(std::string_view text, CsvQuantity quantity) {
  const auto number = csv_number_with_unit(text);
  if (!number) return {};
  if (quantity == CsvQuantity::count)
    return number->unit.empty() ? std::optional(number->value) : std::nullopt;
  const auto unit = csv_find_unit(quantity, number->unit);
  return unit ? std::optional(number->value * unit->factor) : std::nullopt;
}

/// Whether a number starts `text`: its sign, its point, a digit.
inline bool csv_starts_number(std::string_view text) {
  if (!text.empty() && (text.front() == '-' || text.front() == '+')) text.remove_prefix(1);
  if (!text.empty() && text.front() == '.') text.remove_prefix(1);
  return !text.empty() && text.front() >= '0' && text.front() <= '9';
}

/// The shortest text that reads back as the same number, appended.
template <class Number>
void csv_append(std::string& text, Number value) {
  char digits[32];
  text.append(digits, std::to_chars(digits, digits + sizeof digits, value).ptr);
}

inline std::string csv_text(double value) {
  std::string text;
  csv_append(text, value);
  return text;
}

}  // namespace trueaxis

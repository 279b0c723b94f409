// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <type_traits>
#include <utility>

namespace trueaxis {

/// Reads the number at `p`, in any locale; returns where it ends, or `p` where none starts. The
/// value is the double nearest to the text. `error` is result_out_of_range as in std::from_chars.
///
/// Plain decimals of at most 18 digits whose digits stay below 2^53, with at most 22 of them after
/// the point, are the quotient of two exact doubles. There is therefore one rounding (Clinger
/// 1990). All else goes to std::from_chars, from the start.
inline const char* read_number(const char* p, const char* end, double& value, std::errc& error) {
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

/// The number at the front of `text`, removed from it; nothing if none starts there, or it is
/// beyond `Number`. A plus does not belong to a whole number.
template <class Number>
std::optional<Number> take_number(std::string_view& text) {
  Number value{};
  std::errc error{};
  const char *begin = text.data(), *end = begin + text.size(), *stop = begin;
  if constexpr (std::is_same_v<Number, double>) {
    stop = read_number(begin, end, value, error);
  } else {
    const auto [there, why] = std::from_chars(begin, end, value);
    stop = there, error = why;
  }
  if (stop == begin || error != std::errc{}) return {};
  text.remove_prefix(static_cast<std::size_t>(stop - begin));
  return value;
}

/// The same of a number as a control writes it: a sign, digits, a point, and no exponent.
inline std::optional<double> take_plain_number(std::string_view& text) {
  const auto sign = static_cast<std::size_t>(text.starts_with('-') || text.starts_with('+'));
  std::size_t end = std::min(text.find_first_not_of("0123456789", sign), text.size());
  if (end < text.size() && text[end] == '.')
    end = std::min(text.find_first_not_of("0123456789", end + 1), text.size());
  std::string_view plain = text.substr(0, end);
  const auto value = take_number<double>(plain);
  if (value) text.remove_prefix(end);
  return value;
}

/// Whether all of `text` is a finite number, which becomes `value`.
inline bool parse_number(std::string_view text, double& value) {
  const auto all = take_number<double>(text);
  if (!all || !text.empty() || !std::isfinite(*all)) return false;
  value = *all;
  return true;
}

/// Whether a number starts `text`: its sign, its point, a digit.
inline bool starts_number(std::string_view text) {
  if (text.starts_with('-') || text.starts_with('+')) text.remove_prefix(1);
  if (text.starts_with('.')) text.remove_prefix(1);
  return !text.empty() && text.front() >= '0' && text.front() <= '9';
}

/// The whole number that is all of `text`; nothing if it is not a number, or beyond `Whole`.
template <class Whole>
std::optional<Whole> whole_number(std::string_view text) {
  const auto value = take_number<Whole>(text);
  return text.empty() ? value : std::nullopt;
}

/// What one in the n-th significant digit of a value above 0 is worth: of 1234 the second 100.
inline double digit_worth(double value, int n) {
  return std::pow(10.0, std::floor(std::log10(value)) + (1 - n));
}

/// What a reader sees of a formatted number: 1803 instead of 1.8e+03.
inline std::string without_exponent(std::string text, double value) {
  return text.find("e+") == std::string::npos ? text : fmt::format("{:.0f}", value);
}

/// So many significant digits, and all before the point.
inline std::string significant(double value, int digits) {
  return without_exponent(fmt::format("{:.{}g}", value, digits), value);
}

/// The shortest text that reads back as the same number, appended.
template <class Number>
void append_exact(std::string& text, Number value) {
  char digits[32];
  text.append(digits, std::to_chars(digits, digits + sizeof digits, value).ptr);
}

inline std::string exact_text(double value) {
  std::string text;
  append_exact(text, value);
  return text;
}

/// Appends what fmt makes of it.
template <class... T>
void put(std::string& text, fmt::format_string<T...> form, T&&... values) {
  fmt::format_to(std::back_inserter(text), form, std::forward<T>(values)...);
}

/// Fixed, never "-0.000".
inline std::string fixed(double value, int decimals) {
  const std::string text = fmt::format("{:.{}f}", value, decimals);
  const bool zero = text[0] == '-' && text.find_first_of("123456789") == std::string::npos;
  return zero ? text.substr(1) : text;
}

/// A place in mm for messages: to a hundredth, never −0.
inline double hundredths(double mm) { return std::round(100.0 * mm) / 100.0 + 0.0; }

}  // namespace trueaxis

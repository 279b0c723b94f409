// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>

#include <cstddef>
#include <string>
#include <string_view>

#include "trueaxis/units.hpp"

namespace trueaxis::layout {

inline constexpr std::size_t columns = 100;

/// Characters that a terminal shows of UTF-8.
std::size_t width(std::string_view text);

/// `text` with blanks after it up to `to` characters.
std::string padded(std::string_view text, std::size_t to);

/// `head` and then `text`, broken at blanks to `to` columns; further lines start below the text.
std::string wrapped(const std::string& head, std::string_view text, std::size_t to = columns);

/// A length: "99.2 µm", from 1 mm on "2.89 mm"; "not determined".
std::string um(double length_mm);

/// Two digits of a bound, rounded to the safe side: 23.35 is at most 24 (`up`), at least 23.
std::string bound(double value, bool up = true);

/// "value ± U unit" of `scale` × the estimate, or its value and why there is no U.
std::string plus_minus(const Estimate& estimate, double coverage_factor, double scale,
                       const std::string& unit);

/// "0.98", "< 0.001", "> 0.999", "not determined".
std::string probability(double value);

/// The same for a reader, "98 %", "< 0.1 %", "> 99.9 %".
inline std::string percent_of(double probability) {
  if (probability < 0.001) return "< 0.1 %";
  if (probability > 0.999 && probability < 1.0) return "> 99.9 %";
  return fmt::format("{:.{}g} %", 100.0 * probability, probability > 0.99 ? 3 : 2);
}

/// "below 4.1 µm (95 % confidence)", rounded up.
std::string below(double value, const std::string& unit);

/// `plus_minus` for what is never below 0: "below 4.1 µm (95 % confidence)" if it is within its U,
/// of k = 2 at least.
std::string size_plus_minus(const Estimate& estimate, double coverage_factor, double scale,
                            const std::string& unit);

}  // namespace trueaxis::layout

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <utility>

namespace trueaxis {

/// Whether a size is beyond what any part, machine or measurement has, so that its number would
/// only say "never": a metre of an error's length, half a turn, a thousand seconds, 10 000 turns a
/// minute of a lathe's spindle, 1000 of what has no unit (unit "1"); any infinity. Other units:
/// only infinity.
inline bool is_never(double size, std::string_view unit) {
  const double largest = unit == "mm"    ? 1000.0
                         : unit == "rad" ? 3.14
                         : unit == "s"   ? 1000.0
                         : unit == "rpm" ? 1e4
                         : unit == "1"   ? 1000.0
                                         : 1e300;
  return !(size < largest && size > -largest);
}

/// `number`, or `words` where the size is one that never occurs.
inline std::string or_never(double size, std::string_view unit, std::string number,
                            std::string words) {
  return is_never(size, unit) ? std::move(words) : std::move(number);
}

}  // namespace trueaxis

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <cmath>
#include <string>

namespace trueaxis::cli {

/// A finite number from `low` (itself not allowed when `open`) to `high`.
inline CLI::Validator number_in(double low, bool open, double high, const std::string& meaning) {
  return {[=](const std::string& text) {
            double value = 0.0;
            const bool number = CLI::detail::lexical_cast(text, value) && std::isfinite(value);
            const bool inside = number && value <= high && (open ? value > low : value >= low);
            return inside ? std::string() : text + " is not " + meaning;
          },
          "", "number"};
}

inline CLI::Validator more_than_0() {
  return {[](const std::string& text) -> std::string {
            double value = 0.0;
            if (!CLI::detail::lexical_cast(text, value) || !std::isfinite(value))
              return text + " is no finite number";
            return value > 0.0 ? "" : text + " must be more than 0";
          },
          "", "number"};
}

inline CLI::Validator a_length() { return number_in(0.0, false, 1e6, "a length of 0 to 1e6"); }
inline CLI::Validator positive_length() {
  return number_in(0.0, true, 1e6, "a length above 0, up to 1e6");
}

inline CLI::Validator false_alarm_level() {
  return number_in(0.0, true, 0.5, "a probability above 0, up to 0.5");
}

}  // namespace trueaxis::cli

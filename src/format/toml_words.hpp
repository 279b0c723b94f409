// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <toml++/toml.h>

#include <string>
#include <string_view>

#include "format/toml_reader.hpp"

namespace trueaxis {

/// A number as a diagnostic prints it: up to 12 digits.
std::string number_text(double value);

/// "at least 0", "in [0, 90)": the range in the unit of the file, `factor` of which makes the unit
/// inside.
std::string range_text(const Range& range, double factor);

bool contains(const Range& range, double value);

/// "an integer", "a string"
std::string type_text(const toml::node& node);

/// How a path of Windows is written in TOML.
inline constexpr const char* backslash_advice =
    "in double quotes a backslash begins an escape: write the path in single quotes, 'a\\b.csv', "
    "or "
    "with '/'";

/// Of line `number` (1-based) of a text that is not valid TOML: ": " and that advice where the line
/// has a backslash in double quotes.
std::string backslash_hint(std::string_view content, std::size_t number);

bool holds_control_character(std::string_view text);

}  // namespace trueaxis

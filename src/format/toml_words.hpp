// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <toml++/toml.h>

#include <string>

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

}  // namespace trueaxis

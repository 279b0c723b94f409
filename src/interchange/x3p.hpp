// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace trueaxis {

inline constexpr const char* x3p_namespace = "http://www.opengps.eu/2008/ISO5436_2";

/// As md5sum prints it: 32 hexadecimal digits.
std::string md5_of(std::string_view bytes);

}  // namespace trueaxis

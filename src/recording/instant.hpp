// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string_view>

namespace trueaxis {

/// Seconds of "13:55:48.325" since midnight, of "2022-02-22 13:55:48.325" since 1970 as if in UTC;
/// the seconds may have a decimal comma. Nothing for other text.
std::optional<double> instant_s(std::string_view text);

}  // namespace trueaxis

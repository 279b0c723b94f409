// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace trueaxis {

/// `text` with & < > " ' as HTML entities.
std::string escape_html(std::string_view text);

}  // namespace trueaxis

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace trueaxis {

/// "1 reading", "5 readings": the one place where a number and its noun agree.
std::string counted(std::size_t count, std::string_view one, std::string_view several);

/// The same of nouns that take an s.
std::string counted(std::size_t count, std::string_view noun);

/// "5, 9-11, 40": numbers in rising order, neighbours as a range; `most` of them, then " …".
std::string ranges_text(const std::vector<std::size_t>& numbers, std::size_t most = 12);

}  // namespace trueaxis

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "study/sweep/block.hpp"

namespace trueaxis::study {

/// A result as bytes of this machine, and back. @throws InputError for bytes that are none.
std::string encode(const BlockResult& result);
BlockResult decode(std::string_view bytes);

}  // namespace trueaxis::study

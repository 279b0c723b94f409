// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace trueaxis {

/// The catalogue as docs/effects.md: the measuring chain, an index, a section an effect.
std::string effects_markdown();

}  // namespace trueaxis

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "trueaxis/effect.hpp"

namespace trueaxis {

/// How many linear_parameters a term has, without their names.
std::size_t linear_count(const EffectTerm& term, const TermShape& shape);

}  // namespace trueaxis

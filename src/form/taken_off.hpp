// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "form/uncertainty.hpp"

namespace trueaxis::form {

/// The values after one u of an amplitude more.
using Changed = std::function<std::vector<NamedValue>(const TakenOff& one, std::size_t column)>;

/// Adds to u the uncertainty of the amplitudes that were subtracted; Eq. 291.
/// @param values without any change
void add_taken_off(std::span<const TakenOff> taken_off, const std::vector<NamedValue>& values,
                   std::vector<Spread>& spread, const Changed& changed);

/// Readings with one u more of an amplitude.
std::vector<double> added(std::span<const double> reading_mm, const TakenOff& one,
                          std::size_t column);

}  // namespace trueaxis::form

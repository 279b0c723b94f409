// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "trueaxis/machine.hpp"

namespace trueaxis {

/// Reads, of what a file holds, the Etalon exchange format, variant "Vendor": `//` comments, a
/// block `[NAME]` with `VALUE = v` or `Gridpoints = {` rows `argument value` `}`; mm and rad,
/// arguments of rotary axes in degrees. It does not say its sign: `sign` does, and of pivots it
/// knows nothing (0). Refused are numbers that are no sizes of errors in mm and rad, unless
/// `large_errors`.
/// @throws InputError with every diagnostic.
ErrorModel read_etalon(std::string_view content, const std::string& path, const Machine& machine,
                       ErrorSign sign, bool large_errors = false);

/// The same written, component errors as tables of `points` positions where they are none yet.
std::string etalon_text(const ErrorModel& errors, const Machine& machine, ErrorSign sign,
                        int points);

}  // namespace trueaxis

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "trueaxis/machine.hpp"

namespace trueaxis {

/// Reads, of what a file holds, the ISG table of a control's volumetric compensation: `//`
/// comments, blocks parted by a line `#`, each a header of an axis and its errors (`X EXX EYX …`)
/// or of location errors with one row; separated by blanks or tabs; mm and rad, arguments of rotary
/// axes in degrees. Errors as functions of several axes are refused, and so are numbers that are no
/// sizes of errors in mm and rad, unless `large_errors`. It does not say its sign: `sign` does.
/// @throws InputError with every diagnostic.
ErrorModel read_isg_csv(std::string_view content, const std::string& path, const Machine& machine,
                        ErrorSign sign, bool large_errors = false);

/// The same written, component errors at `points` positions where they are no tables yet.
std::string isg_csv_text(const ErrorModel& errors, const Machine& machine, ErrorSign sign,
                         int points);

}  // namespace trueaxis

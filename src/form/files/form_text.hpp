// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "trueaxis/form.hpp"

namespace trueaxis {

/// The screen of a form: values with U, filter, circles, lobes, on 15 to 20 lines. `verbose`: every
/// section and its harmonics.
std::string form_text(const FormResult& result, bool verbose);

/// "3 lobes of 4.97 ± 0.15 µm (78 % pass 5 UPR)", of all that a cut-off takes part of.
std::string swallowed_words(const FormResult& result);

}  // namespace trueaxis

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "trueaxis/form.hpp"

namespace trueaxis {

/// The screen of a form: values with U, filter, circles, lobes, on 15 to 20 lines. `verbose`: every
/// section and its harmonics.
std::string form_text(const FormResult& result, bool verbose);

}  // namespace trueaxis

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "form/sections.hpp"

namespace trueaxis::form {

/// @throws InputError with every invalid option
void expect_options(const FormOptions& options);

/// That the values are of one surface.
std::string note_of_surface(const SurfaceReadings& readings);

/// What a user should know of the numbers.
void add_notes(const ProbeStream& stream, const Sections& sections, FormResult& result);

}  // namespace trueaxis::form

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trueaxis/probe_stream.hpp"

namespace trueaxis::form {

/// @throws InputError with everything that makes a lateral stream no measurement of sections
void expect_sections(const ProbeStream& stream);

/// @throws InputError likewise for a face
void expect_face(const ProbeStream& stream);

}  // namespace trueaxis::form

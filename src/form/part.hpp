// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "form/sections.hpp"
#include "form/uncertainty.hpp"

namespace trueaxis::form {

/// A part as one surface where its readings carry the cut-off together, else section by section.
struct Part {
  PartModel model;
  Sections sections;
};

/// @throws InputError with every section that the readings do not carry
Part part_of(const ProbeStream& stream, const FormOptions& options);

}  // namespace trueaxis::form

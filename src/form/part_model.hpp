// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "form/section_model.hpp"
#include "form/surface_model.hpp"

namespace trueaxis::form {

/// A part, or its datum: sections, each by itself or read off one surface.
struct PartModel {
  std::vector<SectionModel> sections;
  std::optional<SurfaceModel> surface{};
};

}  // namespace trueaxis::form

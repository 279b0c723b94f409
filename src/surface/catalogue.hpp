// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "surface/surface.hpp"

namespace trueaxis {

/// A catalogue line and the maker of the surface: one pair per file of this folder.
struct CatalogueEntry {
  SurfaceInfo info;
  std::unique_ptr<Surface> (*make)(const SurfaceFrame& frame);
};

CatalogueEntry cone_entry();
CatalogueEntry cylinder_entry();
CatalogueEntry plane_entry();
CatalogueEntry section_entry();

}  // namespace trueaxis

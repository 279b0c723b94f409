// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>

#include "surface/surface.hpp"

namespace trueaxis {

/// A catalogue line and the maker of the surface: one pair per file of this folder.
struct CatalogueEntry {
  SurfaceInfo info;
  std::function<std::unique_ptr<Surface>(const SurfaceFrame& frame)> make;
};

/// The line of a kind other than `own`.
const CatalogueEntry& catalogue_entry(SurfaceKind kind);

}  // namespace trueaxis

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <utility>

#include "surface/surface.hpp"

namespace trueaxis {

/// A catalogue line and the maker of the surface.
struct CatalogueEntry {
  SurfaceInfo info;
  std::function<std::unique_ptr<Surface>(const SurfaceFrame& frame)> make;
};

template <class Made>
CatalogueEntry entry_of(SurfaceInfo info) {
  return {std::move(info), [](const SurfaceFrame& frame) -> std::unique_ptr<Surface> {
            return std::make_unique<Made>(frame);
          }};
}

CatalogueEntry cone_entry();
CatalogueEntry cylinder_entry();
CatalogueEntry section_entry();
CatalogueEntry plane_entry();
CatalogueEntry sphere_entry();
CatalogueEntry torus_entry();

/// The line of a kind other than `own`.
const CatalogueEntry& catalogue_entry(SurfaceKind kind);

}  // namespace trueaxis

// SPDX-License-Identifier: Apache-2.0
#include "surface/catalogue.hpp"

#include <algorithm>
#include <array>

#include "trueaxis/error.hpp"

namespace trueaxis {
namespace {

// A list that is read, not objects that register themselves: a static library drops those.
const std::array<CatalogueEntry, 4>& entries() {
  static const std::array<CatalogueEntry, 4> list{cone_entry(), cylinder_entry(), plane_entry(),
                                                  section_entry()};
  return list;
}

const CatalogueEntry& entry(std::string_view id) {
  const auto found =
      std::ranges::find(entries(), id, [](const CatalogueEntry& e) { return e.info.id; });
  if (found != entries().end()) return *found;
  std::string known;
  for (const CatalogueEntry& e : entries())
    known += (known.empty() ? "" : ", ") + std::string(e.info.id);
  throw InputError("surface", "unknown surface '" + std::string(id) + "': use one of " + known);
}

}  // namespace

std::span<const SurfaceInfo> surface_catalogue() {
  static const auto infos = [] {
    std::vector<SurfaceInfo> list;
    for (const CatalogueEntry& e : entries()) list.push_back(e.info);
    return list;
  }();
  return infos;
}

const SurfaceInfo& surface_info(std::string_view id) { return entry(id).info; }

std::unique_ptr<Surface> make_surface(std::string_view id, const SurfaceFrame& frame) {
  return entry(id).make(frame);
}

}  // namespace trueaxis

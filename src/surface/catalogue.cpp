// SPDX-License-Identifier: Apache-2.0
#include "surface/catalogue.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "trueaxis/error.hpp"

namespace trueaxis {
namespace {

// A list that is read, not objects that register themselves: a static library drops those.
const std::array<CatalogueEntry, 6>& entries() {
  static const std::array<CatalogueEntry, 6> list{cone_entry(),    cylinder_entry(), plane_entry(),
                                                  section_entry(), sphere_entry(),   torus_entry()};
  return list;
}

}  // namespace

const CatalogueEntry& catalogue_entry(SurfaceKind kind) {
  const auto found =
      std::ranges::find(entries(), kind, [](const CatalogueEntry& e) { return e.info.kind; });
  expects(found != entries().end(), "a surface of the catalogue");
  return *found;
}

std::span<const SurfaceInfo> surface_catalogue() {
  static const auto infos = [] {
    std::vector<SurfaceInfo> list;
    for (const CatalogueEntry& e : entries()) list.push_back(e.info);
    return list;
  }();
  return infos;
}

const SurfaceInfo& surface_info(SurfaceKind kind) { return catalogue_entry(kind).info; }

std::vector<double> reported_jacobian(SurfaceKind kind, const Revolved& shape, double z_mm) {
  SurfaceFrame frame;
  frame.position_ref_mm = z_mm;
  const std::unique_ptr<Surface> surface = make_surface(kind, frame);
  const Axis& axis = shape.axis;
  const auto [x, y] = axis.at(z_mm);
  const double s_mm = (z_mm - axis.z_ref_mm) * std::hypot(1.0, axis.slope_x, axis.slope_y);
  const double radius_mm = shape.radius_mm + shape.tan_half_angle * s_mm;
  const bool plane = kind == SurfaceKind::plane;  // its working slopes are those of Z over x, y
  const double all[6] = {
      x, y, axis.slope_x, axis.slope_y, plane ? axis.z_ref_mm : radius_mm, shape.tan_half_angle};
  constexpr std::size_t section[] = {0, 1, 4}, face[] = {4, 2, 3}, tilted[] = {0, 1, 2, 3, 4, 5};
  const std::span<const std::size_t> column =
      kind == SurfaceKind::section ? std::span<const std::size_t>(section)
      : plane                      ? std::span<const std::size_t>(face)
              : std::span<const std::size_t>(tilted).first(surface->parameter_count());
  const auto sign = [plane](std::size_t c) { return plane && c != 4 ? -1.0 : 1.0; };
  std::vector<double> working;
  for (const std::size_t c : column) working.push_back(sign(c) * all[c]);
  const Surface::Reported reported = surface->report(working);
  std::vector<double> jacobian(6 * reported.value.size(), 0.0);
  for (std::size_t i = 0; i < reported.value.size(); ++i)
    for (std::size_t j = 0; j < column.size(); ++j)
      jacobian[6 * i + column[j]] = sign(column[j]) * reported.jacobian[i * column.size() + j];
  return jacobian;
}

std::unique_ptr<Surface> make_surface(SurfaceKind kind, const SurfaceFrame& frame) {
  return catalogue_entry(kind).make(frame);
}

bool is_diagnosed(SurfaceKind kind) {
  return kind != SurfaceKind::sphere && kind != SurfaceKind::torus && kind != SurfaceKind::own;
}

const char* to_string(SurfaceKind kind) {
  return kind == SurfaceKind::own ? "own" : surface_info(kind).id;
}

SurfaceKind surface_from_id(std::string_view id) {
  std::string known;
  for (const SurfaceInfo& info : surface_catalogue()) {
    if (info.id == id) return info.kind;
    known += (known.empty() ? "" : ", ") + std::string(info.id);
  }
  throw InputError("surface", "unknown surface '" + std::string(id) + "': use one of " + known);
}

}  // namespace trueaxis

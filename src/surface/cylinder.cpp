// SPDX-License-Identifier: Apache-2.0
#include "surface/cylinder.hpp"

#include "surface/revolved_surface.hpp"

namespace trueaxis {
namespace {

/// Cylinder: axis point (x0, y0, 0), cosines l, m, radius.
class Cylinder final : public RevolvedSurface {
 public:
  explicit Cylinder(const SurfaceFrame& frame) : RevolvedSurface(frame, true, false) {}

  Reported report(std::span<const double> working) const override {
    return differentiate<5>(working, 5, [this](const auto* w, auto* out) {
      const auto full = expand(w);
      report_line(full, out);
      out[4] =
          relative()
              ? w[4]
              : full.radius;  // of a relative gauge: its indication at zero eccentricity − radius
    });
  }
};

}  // namespace

CatalogueEntry cylinder_entry() {
  return {{SurfaceKind::cylinder,
           "cylinder",
           "cylinder",
           StreamKind::lateral,
           true,
           {"x0", "y0", "l", "m", "radius"},
           {"mm", "mm", "1", "1", "mm"}},
          [](const SurfaceFrame& frame) -> std::unique_ptr<Surface> {
            return std::make_unique<Cylinder>(frame);
          }};
}

}  // namespace trueaxis

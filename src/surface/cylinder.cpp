// SPDX-License-Identifier: Apache-2.0
#include "surface/catalogue.hpp"
#include "surface/revolved_surface.hpp"

namespace trueaxis {
namespace {

/// Cylinder: axis point (x0, y0, 0), cosines l, m, radius.
class Cylinder final : public RevolvedSurface {
 public:
  explicit Cylinder(const SurfaceFrame& frame) : RevolvedSurface(frame, true, false) {}

  Reported report(std::span<const double> working) const override {
    return differentiate<5>(working, 5, [this](const auto* w, auto* out) {
      using std::sqrt;
      const auto full = expand(w);
      const auto n = 1.0 / sqrt(1.0 + full.slope_x * full.slope_x + full.slope_y * full.slope_y);
      const double z = frame_.position_ref_mm;
      out[0] = full.x - full.slope_x * z;
      out[1] = full.y - full.slope_y * z;
      out[2] = full.slope_x * n;
      out[3] = full.slope_y * n;
      out[4] =
          relative()
              ? w[4]
              : full.radius;  // of a relative gauge: its indication at zero eccentricity − radius
    });
  }
};

}  // namespace

CatalogueEntry cylinder_entry() {
  return {{"cylinder",
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

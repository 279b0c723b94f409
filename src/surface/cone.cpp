// SPDX-License-Identifier: Apache-2.0
#include "surface/catalogue.hpp"
#include "surface/revolved_surface.hpp"
#include "trueaxis/base/units.hpp"

namespace trueaxis {
namespace {

/// Cone of Constantin et al., Eqs. 1-11: axis point (x0, y0, 0), cosines l, m, apex at k along the
/// axis from that point (Eq. 3, either side: sign(k − s) tells which way it opens), half angle α/2.
class Cone final : public RevolvedSurface {
 public:
  explicit Cone(const SurfaceFrame& frame) : RevolvedSurface(frame, true, true) {}

  Reported report(std::span<const double> working) const override {
    return differentiate<6>(working, 6, [this](const auto* w, auto* out) {
      using std::abs, std::atan, std::sqrt;
      const auto full = expand(w);
      const auto n = 1.0 / sqrt(1.0 + full.slope_x * full.slope_x + full.slope_y * full.slope_y);
      const double z = frame_.position_ref_mm;
      out[0] = full.x - full.slope_x * z;
      out[1] = full.y - full.slope_y * z;
      out[2] = full.slope_x * n;
      out[3] = full.slope_y * n;
      out[4] = z / n - full.radius / full.tan;
      out[5] = atan(abs(full.tan)) / rad_per_deg;
    });
  }
};

}  // namespace

CatalogueEntry cone_entry() {
  return {{"cone",
           "cone, apex at k along its axis",
           StreamKind::lateral,
           true,
           {"x0", "y0", "l", "m", "k", "half_angle"},
           {"mm", "mm", "1", "1", "mm", "deg"}},
          [](const SurfaceFrame& frame) -> std::unique_ptr<Surface> {
            return std::make_unique<Cone>(frame);
          }};
}

}  // namespace trueaxis

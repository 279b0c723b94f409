// SPDX-License-Identifier: Apache-2.0
#include "surface/cone.hpp"

#include "surface/revolved_surface.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

/// Cone of Constantin et al., Eqs. 1-11: axis point (x0, y0, 0), cosines l, m, apex at k along the
/// axis from that point (Eq. 3, either side: sign(k − s) tells which way it opens), half angle α/2.
class Cone final : public RevolvedSurface {
 public:
  explicit Cone(const SurfaceFrame& frame) : RevolvedSurface(frame, true, true) {}

  Reported report(std::span<const double> working) const override {
    return differentiate<6>(working, 6, [this](const auto* w, auto* out) {
      using std::abs, std::atan;
      const auto full = expand(w);
      const auto n = report_line(full, out);
      out[4] = frame_.position_ref_mm / n - full.radius / full.tan;
      out[5] = atan(abs(full.tan)) / rad_per_deg;
    });
  }
};

}  // namespace

CatalogueEntry cone_entry() {
  return {{SurfaceKind::cone,
           "cone",
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

// SPDX-License-Identifier: Apache-2.0
#include "surface/catalogue.hpp"
#include "surface/revolved_surface.hpp"

namespace trueaxis {
namespace {

/// One section without Z: a circle off-centre, exact (its second harmonic e²/4R is no ovality).
class Section final : public RevolvedSurface {
 public:
  explicit Section(const SurfaceFrame& frame) : RevolvedSurface(frame, false, false) {}

  Reported report(std::span<const double> working) const override {
    return differentiate<3>(working, 3, [this](const auto* w, auto* out) {
      const auto full = expand(w);
      out[0] = full.x;
      out[1] = full.y;
      out[2] = relative() ? w[2] : full.radius;
    });
  }
};

}  // namespace

CatalogueEntry section_entry() {
  return {{"section", "circle off-centre, one section", StreamKind::lateral, false,
           {"x0", "y0", "radius"}, {"mm", "mm", "mm"}},
          [](const SurfaceFrame& frame) -> std::unique_ptr<Surface> { return std::make_unique<Section>(frame); }};
}

}  // namespace trueaxis

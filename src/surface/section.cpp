// SPDX-License-Identifier: Apache-2.0
#include "surface/section.hpp"

#include "surface/revolved_surface.hpp"

namespace trueaxis {
namespace {

/// One section without Z: a circle off-centre, exact (its second harmonic e²/4R is no ovality).
class Section final : public RevolvedSurface {
 public:
  explicit Section(const SurfaceFrame& frame) : RevolvedSurface(frame, false, false) {}

  Reported report(std::span<const double> working) const override {
    return differentiate<3>(working, 3, [this](const auto* w, auto* out) {
      out[0] = w[0];
      out[1] = w[1];
      out[2] = relative() ? w[2] : w[2] - frame_.ball_mm;
    });
  }
};

}  // namespace

CatalogueEntry section_entry() {
  return {{SurfaceKind::section,
           "section",
           "circle off-centre, one section",
           StreamKind::lateral,
           false,
           {"x0", "y0", "radius"},
           {"mm", "mm", "mm"}},
          [](const SurfaceFrame& frame) -> std::unique_ptr<Surface> {
            return std::make_unique<Section>(frame);
          }};
}

}  // namespace trueaxis

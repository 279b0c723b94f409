// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "surface/catalogue.hpp"
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
      out[5] = atan(abs(full.tan));
    });
  }
};

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

/// One section without Z: a circle off-centre, exact (its second harmonic e²/4R is not an ovality).
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

CatalogueEntry cone_entry() {
  return entry_of<Cone>({SurfaceKind::cone,
                         "cone",
                         "cone, apex at k along its axis",
                         StreamKind::lateral,
                         true,
                         {"x0", "y0", "l", "m", "k", "half_angle"},
                         {"mm", "mm", "1", "1", "mm", "rad"}});
}

CatalogueEntry cylinder_entry() {
  return entry_of<Cylinder>({SurfaceKind::cylinder,
                             "cylinder",
                             "cylinder",
                             StreamKind::lateral,
                             true,
                             {"x0", "y0", "l", "m", "radius"},
                             {"mm", "mm", "1", "1", "mm"}});
}

CatalogueEntry section_entry() {
  return entry_of<Section>({SurfaceKind::section,
                            "section",
                            "circle off-centre, one section",
                            StreamKind::lateral,
                            false,
                            {"x0", "y0", "radius"},
                            {"mm", "mm", "mm"}});
}

}  // namespace trueaxis

// SPDX-License-Identifier: Apache-2.0
#include "diagnose/files/pattern_text.hpp"

#include <fmt/format.h>

#include "trueaxis/units.hpp"

namespace trueaxis {

std::string harmonic_text(const Pattern& p) {
  return p.kind == Pattern::Kind::bump ? "local form" : fmt::format("{:.4g} UPR", p.order);
}

std::string dependence_text(const Pattern& p) {
  const char* along = p.in_time ? "time" : "Z";
  if (p.kind == Pattern::Kind::bump) {
    const std::string around =
        fmt::format("at {:.1f}° (± {:.1f}°)", p.angle_rad / rad_per_deg, p.width_rad / rad_per_deg);
    if (!(p.length_mm > 0.0)) return around;
    return around + fmt::format(", Z {:.2f} mm (± {:.2f} mm)", p.position_mm, p.length_mm);
  }
  if (p.kind == Pattern::Kind::line) {
    return p.in_time ? fmt::format("turning with {:.4g} Hz", p.frequency)
                     : fmt::format("turning along Z, {:.4g} per mm", p.frequency);
  }
  if (p.degree == 0) return fmt::format("constant along {}", along);
  return p.degree == 1 ? fmt::format("linear in {}", along)
                       : fmt::format("P{} in {}", p.degree, along);
}

}  // namespace trueaxis

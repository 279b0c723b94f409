// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "associate/files/association_files.hpp"
#include "associate/nearest_surface.hpp"
#include "base/number.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

std::string three(const Point3& v) {
  return fmt::format("{:.17g} {:.17g} {:.17g}", v[0], v[1], v[2]);
}

void append_element(std::string& text, const AssociatedFeature& of) {
  const Feature& f = of.feature;
  put(text, "# point: {} mm\n", three(f.point_mm));
  if (of.element != Element::sphere) put(text, "# direction: {}\n", three(f.direction));
  if (std::isfinite(f.radius_mm)) put(text, "# radius: {:.17g} mm\n", f.radius_mm);
  if (std::isfinite(f.half_angle_rad))
    put(text, "# half_angle: {:.17g} deg\n", f.half_angle_rad / rad_per_deg);
  if (std::isfinite(f.minor_radius_mm))
    put(text, "# minor_radius: {:.17g} mm\n", f.minor_radius_mm);
  put(text, "# rms: {:.17g} mm\n# zone: {:.17g} mm\n", of.rms_mm, of.zone_mm);
}

/// Which of the sums must be 0 (Eq. 253), in words and figures.
void append_balance(std::string& text, const AssociatedFeature& of, const Balance& balance) {
  put(text, "# sum of lambda s n: {}\n", three(balance.force));
  put(text, "# sum of lambda s (arm x n): {} mm\n", three(balance.moment_mm));
  const bool constrained = of.criterion == Criterion::constrained;
  if (constrained)
    text += "# (in addition, each has d / n of every one of the n points, Eq. 254)\n";
  const bool zone = of.criterion == Criterion::minimum_zone || constrained;
  const bool flat = of.element == Element::line || of.element == Element::plane;
  const bool tube = !of.in_plane && of.element == Element::circle;
  if (zone && !tube && !(of.element == Element::line && !of.in_plane))
    put(text, "# sum of lambda s: {:.17g}\n", balance.size);
  if (!flat && (of.element == Element::cone || of.element == Element::torus || (tube && zone)))
    put(text, "# sum of lambda s {}: {:.17g}\n", of.element == Element::cone ? "b" : "n.r",
        balance.second_size);
}

constexpr const char* how =
    "# How to check it by hand. n is the unit normal of the element at a point, arm goes from the\n"
    "# point of the element above to it, s is +1 outside and -1 inside, lambda the multiplier.\n"
    "# 1. Every distance follows from the numbers of the element. No point of the file is further\n"
    "#    out (s = +1) or in (s = -1) than those listed.\n"
    "# 2. No lambda is negative, and they add up to 1 (not for a constrained element).\n"
    "# 3. The sums above are 0 to rounding: the points press on the element like forces in\n"
    "#    equilibrium, so that a motion that lowers the distance of one raises that of another.\n"
    "#    (b: along the generatrix, of a cone; n.r: part of n away from the axis, of a tube. In a\n"
    "#    plane problem what is out of the plane, of a circle in space seen along its axis the\n"
    "#    force along the axis and the moments do not count.)\n";

}  // namespace

std::string association_certificate(const AssociatedFeature& of, const PointText& points) {
  const AssociationCertificate& certificate = of.certificate;
  std::string text = "# schema: trueaxis.certificate/1\n";
  put(text, "# version: {}\n# input: {} ({})\n", TRUEAXIS_VERSION, points.source, points.hash);
  put(text, "# element: {}\n# criterion: {}\n# status: {}\n# points: {}\n",
      element_names[static_cast<std::size_t>(of.element)],
      criterion_names[static_cast<std::size_t>(of.criterion)],
      association_status_names[static_cast<std::size_t>(of.status)], of.points);
  append_element(text, of);
  put(text, "# stationarity: {:.3g}\n# gap: {:.3g} mm\n", certificate.stationarity,
      certificate.gap_mm);
  put(text, "# optimum: {}\n",
      certificate.global        ? std::string("global")
      : certificate.starts == 1 ? std::string("local, from the algebraic or the Gaussian element")
                                : fmt::format("the best from {} starts", certificate.starts));
  if (of.criterion == Criterion::gaussian)
    return text +
           "# How to check it by hand: the sum of d grad d over all points is 0, d the distance;\n"
           "# stationarity is its size a point, gap how far the element is from where it is 0.\n";
  if (of.criterion == Criterion::constrained)
    text += "# All points are on the side of the material; those below touch the element.\n";
  append_balance(text, of, balance_of(of, points.points_mm));
  text += how;
  text += "line,x[mm],y[mm],z[mm],s,distance[mm],lambda,nx,ny,nz\n";
  for (const AssociationCertificate::Contact& contact : certificate.contacts) {
    const Point3& p = points.points_mm[contact.point];
    const NearestSurface at = nearest_surface(of, p);
    put(text, "{},{:.17g},{:.17g},{:.17g},{},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g}\n",
        points.lines[contact.point], p[0], p[1], p[2], contact.sign, at.distance_mm,
        contact.multiplier, at.normal[0], at.normal[1], at.normal[2]);
  }
  return text;
}

}  // namespace trueaxis

// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>

#include "associate/files/association_files.hpp"
#include "format/text_layout.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

constexpr double k = 2.0;  // coverage factor

std::string row(const std::string& name, double value, double u, const char* unit,
                double factor = 1.0) {
  const double U = k * u * factor;
  if (!std::isfinite(U)) return fmt::format("  {:<14} {:>18.9f} {}\n", name, value * factor, unit);
  const int decimals = decimals_of(U, 6);
  return fmt::format("  {:<14} {:>18.{}f} ± {:.{}f} {}\n", name, value * factor, decimals, U,
                     decimals, unit);
}

std::string rows(const std::string& name, const Point3& value, const Point3& u, const char* unit) {
  std::string text;
  for (std::size_t i = 0; i < 3; ++i) text += row(name + " " + "xyz"[i], value[i], u[i], unit);
  return text;
}

/// What proves the optimum, in a sentence.
std::string proof(const AssociatedFeature& of) {
  const AssociationCertificate& certificate = of.certificate;
  if (of.criterion == Criterion::gaussian)
    return certificate.global ? std::string("by principal axes: the least of all")
           : certificate.starts == 1
               ? std::string("the minimum that the algebraic element leads to")
               : fmt::format("the least minimum from {} starts", certificate.starts);
  if (of.criterion == Criterion::constrained)
    return fmt::format(
        "{} points touch it and balance the pull of all, to {:.1e} mm; the minimum that the "
        "Gaussian element leads to",
        certificate.contacts.size(), certificate.gap_mm);
  if (certificate.contacts.empty())
    return fmt::format("all points lie on it to {:.1e} mm, so the zone cannot be narrower",
                       certificate.gap_mm);
  return fmt::format(
      "{} points hold it, no motion improves it by more than {:.1e} mm to first "
      "order; {}",
      certificate.contacts.size(), certificate.gap_mm,
      certificate.global ? std::string("the criterion is convex: there is no better one")
                         : fmt::format("the best from {} starts", certificate.starts));
}

}  // namespace

std::string association_text(const AssociatedFeature& of) {
  const Feature &f = of.feature, &u = of.u;
  std::string text = fmt::format("{} by {} through {} points{}\n",
                                 element_names[static_cast<std::size_t>(of.element)],
                                 criterion_names[static_cast<std::size_t>(of.criterion)], of.points,
                                 of.in_plane ? ", in the plane z = 0" : "");
  text += rows("point", f.point_mm, u.point_mm, "mm");
  if (of.element != Element::sphere) text += rows("direction", f.direction, u.direction, "");
  if (std::isfinite(f.radius_mm)) text += row("radius", f.radius_mm, u.radius_mm, "mm");
  if (std::isfinite(f.half_angle_rad))
    text += row("half angle", f.half_angle_rad, u.half_angle_rad, "deg", 1.0 / rad_per_deg);
  if (std::isfinite(f.minor_radius_mm))
    text += row("minor radius", f.minor_radius_mm, u.minor_radius_mm, "mm");
  text += fmt::format("  {:<14} {:>18.6f} µm\n", "rms", of.rms_mm / mm_per_um);
  text += fmt::format("  {:<14} {:>18.6f} µm\n", "zone", of.zone_mm / mm_per_um);
  text += layout::wrapped("  proof          ", proof(of));
  if (!of.why_no_u.empty())
    text += layout::wrapped("  no U           ", of.why_no_u);
  else
    text +=
        layout::wrapped("  U              ", "k = 2, from the residuals, treated as independent");
  return text;
}

std::string association_distances(const AssociatedFeature& of, const PointText& points) {
  std::string text = fmt::format(
      "# schema: trueaxis.distances/1\n# version: {}\n# input: {} ({})\n# element: {}\n"
      "# criterion: {}\nline,x[mm],y[mm],z[mm],distance[mm]\n",
      TRUEAXIS_VERSION, points.source, points.hash,
      element_names[static_cast<std::size_t>(of.element)],
      criterion_names[static_cast<std::size_t>(of.criterion)]);
  const std::vector<double> distances = distances_mm(points.points_mm, of);
  for (std::size_t i = 0; i < distances.size(); ++i) {
    const Point3& p = points.points_mm[i];
    text += fmt::format("{},{},{},{},{}\n", points.lines[i], p[0], p[1], p[2], distances[i]);
  }
  return text;
}

}  // namespace trueaxis

// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "associate/files/association_files.hpp"
#include "format/json.hpp"

namespace trueaxis {
namespace {

Json estimate(double value, double u, const char* unit, const std::string& why_no_u,
              double factor = 1.0) {
  return to_json(Estimate{.value = value * factor,
                          .u = u * factor,
                          .unit = unit,
                          .why_not = std::isfinite(u) ? "" : why_no_u});
}

Json vector(const Point3& value, const Point3& u, const char* unit, const std::string& why) {
  Json json;
  for (std::size_t i = 0; i < 3; ++i)
    json[std::string(1, "xyz"[i])] = estimate(value[i], u[i], unit, why);
  return json;
}

Json certificate_json(const AssociatedFeature& of, const PointText& points) {
  const AssociationCertificate& certificate = of.certificate;
  const auto contact = [&](const AssociationCertificate::Contact& one) -> Json {
    return {{"point", one.point + 1},
            {"line", points.lines[one.point]},
            {"side", one.sign > 0 ? "outer" : "inner"},
            {"distance", mm_json(one.distance_mm)},
            {"multiplier", one.multiplier}};
  };
  return {{"contacts", list_of(certificate.contacts, contact)},
          {"stationarity", number(certificate.stationarity)},
          {"gap", with_unit(certificate.gap_mm, "mm")},
          {"global", certificate.global},
          {"starts", certificate.starts}};
}

}  // namespace

std::string association_json(const AssociatedFeature& of, const PointText& points) {
  const Feature &f = of.feature, &u = of.u;
  const std::string why = of.why.empty() ? of.why_no_u : of.why;
  Json json{{"schema", "trueaxis.association/1"},
            {"version", TRUEAXIS_VERSION},
            {"input", {{"file", points.source}, {"hash", points.hash}}},
            {"element", element_names[static_cast<std::size_t>(of.element)]},
            {"criterion", criterion_names[static_cast<std::size_t>(of.criterion)]},
            {"status", association_status_names[static_cast<std::size_t>(of.status)]}};
  if (!of.why.empty()) json["message"] = of.why;
  json["in_plane"] = of.in_plane;
  json["points"] = of.points;
  json["point"] = vector(f.point_mm, u.point_mm, "mm", why);
  if (of.element != Element::sphere) json["direction"] = vector(f.direction, u.direction, "1", why);
  const bool sized = of.element != Element::line && of.element != Element::plane;
  if (sized) json["radius"] = estimate(f.radius_mm, u.radius_mm, "mm", why);
  if (of.element == Element::cone)
    json["half_angle"] =
        estimate(f.half_angle_rad, u.half_angle_rad, "deg", why, 1.0 / rad_per_deg);
  if (of.element == Element::torus)
    json["minor_radius"] = estimate(f.minor_radius_mm, u.minor_radius_mm, "mm", why);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::string no_u = "it describes these points and is not an estimate";
  json["rms"] = estimate(of.rms_mm, nan, "mm", no_u);
  json["zone"] = estimate(of.zone_mm, nan, "mm", no_u);
  json["iterations"] = of.iterations;
  json["certificate"] = certificate_json(of, points);
  return json_text(json);
}

}  // namespace trueaxis

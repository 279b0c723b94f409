// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "interchange/qif_parts.hpp"

namespace trueaxis {
namespace {

/// What QIF calls the point and the direction of a feature; both are in an Axis, or not.
struct FeatureNames {
  const char *kind, *point, *direction;
  bool axis = false;
};
constexpr std::array<FeatureNames, 7> feature_names{{{"Line", "Location", "Direction"},
                                                     {"Circle", "Location", "Normal"},
                                                     {"Plane", "Location", "Normal"},
                                                     {"Sphere", "Location", ""},
                                                     {"Cylinder", "AxisPoint", "Direction", true},
                                                     {"Cone", "AxisPoint", "Direction", true},
                                                     {"Torus", "Location", "AxisVector"}}};

void add_vector(pugi::xml_node parent, const char* name, const QifVector& vector) {
  std::string text;
  for (const double one : vector.value) text += (text.empty() ? "" : " ") + qif_decimal(one);
  pugi::xml_node node = qif_child(parent, name, text);
  if (!vector.has_z) node.append_attribute("zValidity") = "MOOT";
  if (!std::ranges::all_of(vector.u, [](double u) { return std::isfinite(u); })) return;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::string axis(1, "xyz"[i]);
    node.append_attribute((axis + "CombinedUncertainty").c_str()) =
        qif_decimal(vector.u[i]).c_str();
    node.append_attribute((axis + "MeanError").c_str()) = "0";
  }
}

/// In words if it is not one of QIF's own names, which are of capitals.
void add_algorithm(pugi::xml_node node, const std::string& algorithm) {
  if (algorithm.empty()) return;
  const bool named = algorithm.find_first_not_of("ABCDEFGHIJKLMNOPQRSTUVWXYZ") == algorithm.npos;
  qif_child(node.append_child("SubstituteFeatureAlgorithm"),
            named ? "SubstituteFeatureAlgorithmEnum" : "OtherSubstituteFeatureAlgorithm",
            algorithm);
}

void add_place(pugi::xml_node node, const FeatureNames& names, const QifFeature& feature) {
  if (!feature.point_mm) return;
  if (names.axis) {
    if (!feature.direction) return;  // an Axis has both
    node = node.append_child("Axis");
  }
  add_vector(node, names.point, *feature.point_mm);
  if (feature.direction) add_vector(node, names.direction, *feature.direction);
}

}  // namespace

std::vector<unsigned> add_measured_features(pugi::xml_node results, QifIds& ids,
                                            const std::vector<QifFeature>& features) {
  std::vector<unsigned> given;
  if (features.empty()) return given;
  pugi::xml_node list = qif_list(results, "MeasuredFeatures", features.size());
  for (const QifFeature& feature : features) {
    const FeatureNames& names = feature_names[static_cast<std::size_t>(feature.kind)];
    pugi::xml_node node =
        list.append_child((std::string(names.kind) + "FeatureMeasurement").c_str());
    given.push_back(ids.give(node));
    qif_child(node, "FeatureName", feature.name);
    add_algorithm(node, feature.algorithm);
    add_place(node, names, feature);
    const auto add = [&](const char* name, const std::optional<QifValue>& value) {
      if (value) qif_child(node, name, *value);
    };
    add("MinorDiameter", feature.minor_diameter_mm);
    add(feature.kind == QifFeatureKind::torus ? "MajorDiameter" : "Diameter", feature.diameter_mm);
    add("HalfAngle", feature.half_angle_deg);
    add("Length", feature.length_mm);
    add("Form", feature.form_mm);
  }
  return given;
}

}  // namespace trueaxis

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <pugixml.hpp>
#include <set>
#include <string>
#include <vector>

/// A QIF 3.0 results document read again, and what its XSDs ask of one, written down by hand from
/// them: order of the elements, counts, ids and what they refer to, decimals.
namespace trueaxis::testing {

/// Elements of each parent that TrueAxis writes, in the order of the XSDs; `*` is any beginning.
inline const std::vector<std::pair<std::string, std::vector<std::string>>> qif_order{
    {"QIFDocument",
     {"QPId", "Header", "StandardsDefinitions", "FileUnits", "Characteristics", "Results"}},
    {"Header", {"Application", "Description", "Scope"}},
    {"Application", {"Name"}},
    {"Standard", {"Organization", "Designator"}},
    {"PrimaryUnits", {"AngularUnit", "LinearUnit"}},
    {"AngularUnit", {"SIUnitName", "UnitName", "UnitConversion"}},
    {"LinearUnit", {"SIUnitName", "UnitName", "UnitConversion"}},
    {"Characteristics",
     {"FormalStandardId", "CharacteristicDefinitions", "CharacteristicNominals",
      "CharacteristicItems"}},
    {"*CharacteristicDefinition", {"Name", "ToleranceValue", "MaterialCondition", "ZoneShape"}},
    {"*CharacteristicNominal", {"CharacteristicDefinitionId", "Name"}},
    {"*CharacteristicItem", {"Name", "CharacteristicNominalId"}},
    {"*CharacteristicMeasurement",
     {"Status", "CharacteristicItemId", "FeatureMeasurementIds", "Value"}},
    {"MeasurementResults", {"MeasuredFeatures", "MeasuredCharacteristics", "InspectionStatus"}},
    {"CircleFeatureMeasurement",
     {"FeatureName", "SubstituteFeatureAlgorithm", "Location", "Normal", "Diameter", "Form"}},
    {"LineFeatureMeasurement",
     {"FeatureName", "SubstituteFeatureAlgorithm", "Location", "Direction", "Length", "Form"}},
    {"PlaneFeatureMeasurement",
     {"FeatureName", "SubstituteFeatureAlgorithm", "Location", "Normal", "Form"}},
    {"SphereFeatureMeasurement",
     {"FeatureName", "SubstituteFeatureAlgorithm", "Location", "Diameter", "Form"}},
    {"CylinderFeatureMeasurement",
     {"FeatureName", "SubstituteFeatureAlgorithm", "Axis", "Diameter", "Length", "Form"}},
    {"ConeFeatureMeasurement",
     {"FeatureName", "SubstituteFeatureAlgorithm", "Axis", "Diameter", "HalfAngle", "Form"}},
    {"TorusFeatureMeasurement",
     {"FeatureName", "SubstituteFeatureAlgorithm", "Location", "AxisVector", "MinorDiameter",
      "MajorDiameter", "Form"}},
    {"Axis", {"AxisPoint", "Direction"}}};

class QifReader {
 public:
  explicit QifReader(const std::string& text) {
    const pugi::xml_parse_result read = xml_.load_string(text.c_str());
    EXPECT_TRUE(read) << read.description();
    root_ = xml_.child("QIFDocument");
    collect(root_);
  }

  pugi::xml_node root() const { return root_; }
  pugi::xml_node measured() const {
    return root_.child("Results").child("MeasurementResultsSet").child("MeasurementResults");
  }
  std::vector<pugi::xml_node> features() const { return of(measured().child("MeasuredFeatures")); }
  std::vector<pugi::xml_node> characteristics() const {
    return of(measured().child("MeasuredCharacteristics").child("CharacteristicMeasurements"));
  }
  pugi::xml_node with_id(const std::string& id) const {
    const auto at = ids_.find(id);
    return at == ids_.end() ? pugi::xml_node() : at->second;
  }

  /// All that is asked of every document.
  void expect_structure() const {
    EXPECT_STREQ(root_.attribute("xmlns").value(), "http://qifstandards.org/xsd/qif3");
    EXPECT_STREQ(root_.attribute("versionQIF").value(), "3.0.0");
    unsigned largest = 0;
    for (const auto& [id, node] : ids_) largest = std::max(largest, node.attribute("id").as_uint());
    EXPECT_EQ(root_.attribute("idMax").as_uint(), largest);
    expect_structure(root_);
  }

 private:
  static std::vector<pugi::xml_node> of(pugi::xml_node list) { return {list.begin(), list.end()}; }
  void collect(pugi::xml_node node) {
    if (const std::string id = node.attribute("id").value(); !id.empty()) {
      EXPECT_TRUE(id.find_first_not_of("0123456789") == id.npos && id.front() != '0') << id;
      EXPECT_TRUE(ids_.emplace(id, node).second) << "id " << id << " twice";
    }
    for (pugi::xml_node child : node.children()) collect(child);
  }
  static bool is_element(pugi::xml_node node) { return node.type() == pugi::node_element; }

  void expect_structure(pugi::xml_node node) const {
    const std::string name = node.name();
    if (node.attribute("n")) {
      EXPECT_EQ(node.attribute("n").as_uint(), std::count_if(node.begin(), node.end(), is_element))
          << name;
    }
    for (const auto& [parent, order] : qif_order)
      if (parent == name || (parent.front() == '*' && name.ends_with(parent.substr(1))))
        expect_order(node, order);
    expect_reference(node);
    for (pugi::xml_attribute one : node.attributes())
      if (std::string(one.name()).ends_with("Uncertainty")) expect_decimal(one.value(), name);
    if (name == "Value" || name == "Form" || name == "Diameter" || name == "ToleranceValue")
      expect_decimal(node.text().get(), name);
    for (pugi::xml_node child : node.children())
      if (is_element(child)) expect_structure(child);
  }
  static void expect_order(pugi::xml_node node, const std::vector<std::string>& order) {
    std::size_t last = 0;
    for (pugi::xml_node child : node.children()) {
      const auto at = std::ranges::find(order, child.name());
      ASSERT_NE(at, order.end()) << child.name() << " in " << node.name();
      const auto place = static_cast<std::size_t>(at - order.begin()) + 1;
      EXPECT_GT(place, last) << child.name() << " in " << node.name();
      last = place;
    }
  }
  /// Each kind of reference is to an element of its kind: "Circularity…Nominal" to "…Definition".
  void expect_reference(pugi::xml_node node) const {
    const std::string name = node.name();
    const std::string from = node.parent().name();
    const std::string kind = from.substr(0, from.find("Characteristic"));
    std::string to;
    if (name == "CharacteristicDefinitionId") to = kind + "CharacteristicDefinition";
    if (name == "CharacteristicNominalId") to = kind + "CharacteristicNominal";
    if (name == "CharacteristicItemId") to = kind + "CharacteristicItem";
    if (name == "FormalStandardId") to = "Standard";
    if (!to.empty()) {
      EXPECT_EQ(with_id(node.text().get()).name(), to);
    }
    if (from == "FeatureMeasurementIds") {
      EXPECT_STREQ(with_id(node.text().get()).parent().name(), "MeasuredFeatures");
    }
  }
  static void expect_decimal(const std::string& text, const std::string& of) {
    EXPECT_TRUE(!text.empty() && text.find_first_not_of("-.0123456789") == text.npos)
        << of << ": " << text;
    const auto digits = std::ranges::count_if(text, [](char c) { return c >= '0' && c <= '9'; });
    EXPECT_LE(digits - (text.starts_with("0.") || text.starts_with("-0.") ? 1 : 0), 18)
        << of << ": " << text;
  }

  pugi::xml_document xml_;
  pugi::xml_node root_;
  std::map<std::string, pugi::xml_node> ids_;
};

}  // namespace trueaxis::testing

// SPDX-License-Identifier: Apache-2.0
#include "interchange/qif.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <pugixml.hpp>
#include <sstream>

#include "interchange/x3p.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis {

std::string qif_decimal(double value) {
  expects(std::isfinite(value), "a decimal is finite");
  // What every processor must take of an xs:decimal (XML Schema part 2, 3.2.3).
  constexpr std::size_t most_digits = 18;
  const auto fixed = [value](auto... decimals) {
    std::array<char, 512> text{};  // 1e±308 needs 330
    const auto end = std::to_chars(text.data(), text.data() + text.size(), value + 0.0,
                                   std::chars_format::fixed, decimals...);  // −0 + 0 is 0
    return std::string(text.data(), end.ptr);
  };
  std::string text = fixed();
  const std::size_t point = text.find('.');
  if (point == std::string::npos) return text;
  const std::size_t whole = std::abs(value) < 1.0 ? 0 : point - (value < 0.0 ? 1 : 0);
  if (whole + text.size() - point - 1 <= most_digits) return text;
  text = fixed(static_cast<int>(most_digits - whole));  // of 2^53 or more there is no fraction
  text.erase(text.find_last_not_of('0') + 1);
  if (text.ends_with('.')) text.pop_back();
  return text == "-0" ? "0" : text;
}

namespace {

/// Gives every element that asks for one its QIF id: 1, 2, 3 …
class QifIds {
 public:
  unsigned give(pugi::xml_node node) {
    node.append_attribute("id") = ++last_;
    return last_;
  }
  unsigned last() const { return last_; }

 private:
  unsigned last_ = 0;
};

pugi::xml_node qif_child(pugi::xml_node parent, const std::string& name, const std::string& text) {
  pugi::xml_node node = parent.append_child(name.c_str());
  node.text() = text.c_str();
  return node;
}

pugi::xml_node qif_child(pugi::xml_node parent, const std::string& name, const QifValue& value) {
  pugi::xml_node node = qif_child(parent, name, qif_decimal(value.value));
  if (std::isfinite(value.u)) {
    node.append_attribute("combinedUncertainty") = qif_decimal(value.u).c_str();
    node.append_attribute("meanError") = qif_decimal(std::max(0.0, value.mean_error)).c_str();
  }
  return node;
}

/// A list of `count` elements, which QIF writes into its attribute n.
pugi::xml_node qif_list(pugi::xml_node parent, const std::string& name, std::size_t count) {
  pugi::xml_node node = parent.append_child(name.c_str());
  node.append_attribute("n") = static_cast<unsigned>(count);
  return node;
}

/// UUID of version 3: MD5 of the bytes of the namespace of URLs (RFC 9562) and of `name`.
std::string uuid_of(const std::string& name) {
  constexpr unsigned char of_urls[] = {0x6b, 0xa7, 0xb8, 0x11, 0x9d, 0xad, 0x11, 0xd1,
                                       0x80, 0xb4, 0x00, 0xc0, 0x4f, 0xd4, 0x30, 0xc8};
  std::string digits = md5_of(std::string(std::begin(of_urls), std::end(of_urls)) + name);
  digits[12] = '3';
  const std::string hexadecimal = "0123456789abcdef";
  digits[16] = "89ab"[hexadecimal.find(digits[16]) % 4];
  for (const std::size_t at : {20U, 16U, 12U, 8U}) digits.insert(at, 1, '-');
  return digits;
}

void add_header(pugi::xml_node document, const QifResults& results, const std::string& version) {
  pugi::xml_node header = document.append_child("Header");
  qif_child(header.append_child("Application"), "Name", "TrueAxis " + version);
  qif_child(header, "Description", results.description);
  qif_child(header, "Scope", "Results");
}

/// ISO 1101, to which the characteristics are. Its id.
unsigned add_standard(pugi::xml_node document, QifIds& ids) {
  pugi::xml_node standard = qif_list(document, "StandardsDefinitions", 1).append_child("Standard");
  const unsigned id = ids.give(standard);
  qif_child(standard.append_child("Organization"), "StandardsOrganizationEnum", "ISO");
  qif_child(standard, "Designator", "1101");
  return id;
}

void add_units(pugi::xml_node document) {
  pugi::xml_node primary = document.append_child("FileUnits").append_child("PrimaryUnits");
  const auto add = [&](const char* kind, const char* si, const char* name, const char* factor) {
    pugi::xml_node unit = primary.append_child(kind);
    qif_child(unit, "SIUnitName", si);
    qif_child(unit, "UnitName", name);
    qif_child(unit.append_child("UnitConversion"), "Factor", factor);
  };
  add("AngularUnit", "radian", "degree", "0.017453292519943295");
  add("LinearUnit", "meter", "mm", "0.001");
}

/// Of everything that has a tolerance.
const char* inspection_status(const std::vector<QifCharacteristic>& characteristics) {
  const auto any = [&](QifStatus status) {
    return std::ranges::any_of(characteristics, [&](const QifCharacteristic& one) {
      return std::ranges::any_of(one.measurements,
                                 [&](const auto& measured) { return measured.status == status; });
    });
  };
  if (any(QifStatus::fail)) return "FAIL";
  if (any(QifStatus::indeterminate)) return "UNKNOWN";
  return any(QifStatus::pass) ? "PASS" : "NOT_CALCULATED";
}

std::string text_of(const pugi::xml_document& xml) {
  std::ostringstream text;
  xml.save(text, "  ");
  return text.str();
}

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

/// MeasuredFeatures, where there are any. Their ids, in the order of `features`.
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

constexpr std::array<const char*, 3> status_names{"PASS", "FAIL", "INDETERMINATE"};

/// The tolerance, and the shape of its zone where the kind has one.
void add_tolerance(pugi::xml_node definition, const QifCharacteristic& one) {
  qif_child(definition, "ToleranceValue", qif_decimal(one.tolerance_mm));
  if (one.kind == "Parallelism") qif_child(definition, "MaterialCondition", "NONE");
  if (!one.zone.empty()) definition.append_child("ZoneShape").append_child(one.zone.c_str());
}

/// Characteristics: a definition with the tolerance, a nominal and an item each. Ids of the items.
std::vector<unsigned> add_characteristics(pugi::xml_node document, QifIds& ids, unsigned standard,
                                          const std::vector<QifCharacteristic>& characteristics) {
  std::vector<unsigned> definitions, nominals, items;
  if (characteristics.empty()) return items;
  pugi::xml_node all = document.append_child("Characteristics");
  qif_child(all, "FormalStandardId", std::to_string(standard));
  /// One element of every characteristic: Circularity + Characteristic + Definition …
  const auto add = [&](const std::string& aspect, std::vector<unsigned>& given, auto&& fill) {
    pugi::xml_node list = qif_list(all, "Characteristic" + aspect + "s", characteristics.size());
    for (const QifCharacteristic& one : characteristics) {
      pugi::xml_node node = list.append_child((one.kind + "Characteristic" + aspect).c_str());
      const std::size_t at = given.size();
      given.push_back(ids.give(node));
      fill(node, one, at);
    }
  };
  add("Definition", definitions,
      [](pugi::xml_node node, const QifCharacteristic& one, std::size_t) {
        qif_child(node, "Name", one.name);
        add_tolerance(node, one);
      });
  add("Nominal", nominals, [&](pugi::xml_node node, const QifCharacteristic& one, std::size_t at) {
    qif_child(node, "CharacteristicDefinitionId", std::to_string(definitions[at]));
    qif_child(node, "Name", one.name);
  });
  add("Item", items, [&](pugi::xml_node node, const QifCharacteristic& one, std::size_t at) {
    qif_child(node, "Name", one.name);
    qif_child(node, "CharacteristicNominalId", std::to_string(nominals[at]));
  });
  return items;
}

/// MeasuredCharacteristics, where there are any, of these items and features.
void add_measured_characteristics(pugi::xml_node results, QifIds& ids,
                                  const std::vector<QifCharacteristic>& characteristics,
                                  const std::vector<unsigned>& items,
                                  const std::vector<unsigned>& features) {
  std::size_t count = 0;
  for (const QifCharacteristic& one : characteristics) count += one.measurements.size();
  if (count == 0) return;
  pugi::xml_node list = qif_list(results.append_child("MeasuredCharacteristics"),
                                 "CharacteristicMeasurements", count);
  for (std::size_t at = 0; at < characteristics.size(); ++at)
    for (const QifCharacteristic::Measurement& measured : characteristics[at].measurements) {
      pugi::xml_node node =
          list.append_child((characteristics[at].kind + "CharacteristicMeasurement").c_str());
      ids.give(node);
      qif_child(node.append_child("Status"), "CharacteristicStatusEnum",
                status_names[static_cast<std::size_t>(measured.status)]);
      qif_child(node, "CharacteristicItemId", std::to_string(items[at]));
      if (measured.feature)
        qif_child(qif_list(node, "FeatureMeasurementIds", 1), "Id",
                  std::to_string(features.at(*measured.feature)));
      qif_child(node, "Value", measured.value_mm);
    }
}

}  // namespace

std::string qif_document(const QifResults& results, const std::string& version) {
  pugi::xml_document xml;
  pugi::xml_node declaration = xml.append_child(pugi::node_declaration);
  declaration.append_attribute("version") = "1.0";
  declaration.append_attribute("encoding") = "UTF-8";
  xml.append_child(pugi::node_comment)
      .set_value((" schema: trueaxis.qif/1, TrueAxis " + version + " ").c_str());
  pugi::xml_node document = xml.append_child("QIFDocument");
  document.append_attribute("xmlns") = "http://qifstandards.org/xsd/qif3";
  pugi::xml_attribute largest_id = document.append_attribute("idMax");
  document.append_attribute("versionQIF") = "3.0.0";
  pugi::xml_node own_id = document.append_child("QPId");

  QifIds ids;
  const auto& characteristics = results.characteristics;
  add_header(document, results, version);
  const unsigned standard = characteristics.empty() ? 0 : add_standard(document, ids);
  add_units(document);
  const auto items = add_characteristics(document, ids, standard, characteristics);
  pugi::xml_node measured = qif_list(document.append_child("Results"), "MeasurementResultsSet", 1)
                                .append_child("MeasurementResults");
  ids.give(measured);
  const auto features = add_measured_features(measured, ids, results.features);
  add_measured_characteristics(measured, ids, characteristics, items, features);
  qif_child(measured.append_child("InspectionStatus"), "InspectionStatusEnum",
            inspection_status(characteristics));
  largest_id = ids.last();
  own_id.text() = uuid_of(text_of(xml)).c_str();
  return text_of(xml);
}

}  // namespace trueaxis

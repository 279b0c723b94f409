// SPDX-License-Identifier: Apache-2.0
#include "interchange/qif.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <sstream>

#include "interchange/qif_parts.hpp"
#include "interchange/x3p.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis {
namespace {

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

}  // namespace

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

pugi::xml_node qif_list(pugi::xml_node parent, const std::string& name, std::size_t count) {
  pugi::xml_node node = parent.append_child(name.c_str());
  node.append_attribute("n") = static_cast<unsigned>(count);
  return node;
}

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

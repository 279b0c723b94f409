// SPDX-License-Identifier: Apache-2.0
#include "interchange/qif_parts.hpp"

namespace trueaxis {
namespace {

constexpr std::array<const char*, 3> status_names{"PASS", "FAIL", "INDETERMINATE"};

/// The tolerance, and the shape of its zone where the kind has one.
void add_tolerance(pugi::xml_node definition, const QifCharacteristic& one) {
  qif_child(definition, "ToleranceValue", qif_decimal(one.tolerance_mm));
  if (one.kind == "Parallelism") qif_child(definition, "MaterialCondition", "NONE");
  if (!one.zone.empty()) definition.append_child("ZoneShape").append_child(one.zone.c_str());
}

}  // namespace

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

}  // namespace trueaxis

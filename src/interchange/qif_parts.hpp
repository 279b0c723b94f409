// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <pugixml.hpp>

#include "interchange/qif.hpp"

/// The parts of a QIF document, each in the order that its schema asks for.
namespace trueaxis {

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

/// xs:decimal, which has no exponent: the fewest digits that are read as the same number. They are
/// not more than the 18 that every XML Schema processor must take (a length in mm then to 1e-18
/// mm).
std::string qif_decimal(double value);

pugi::xml_node qif_child(pugi::xml_node parent, const std::string& name, const std::string& text);
pugi::xml_node qif_child(pugi::xml_node parent, const std::string& name, const QifValue& value);
/// A list of `count` elements, which QIF writes into its attribute n.
pugi::xml_node qif_list(pugi::xml_node parent, const std::string& name, std::size_t count);

/// MeasuredFeatures, where there are any. Their ids, in the order of `features`.
std::vector<unsigned> add_measured_features(pugi::xml_node results, QifIds& ids,
                                            const std::vector<QifFeature>& features);

/// Characteristics: a definition with the tolerance, a nominal and an item each. Ids of the items.
std::vector<unsigned> add_characteristics(pugi::xml_node document, QifIds& ids, unsigned standard,
                                          const std::vector<QifCharacteristic>& characteristics);

/// MeasuredCharacteristics, where there are any, of these items and features.
void add_measured_characteristics(pugi::xml_node results, QifIds& ids,
                                  const std::vector<QifCharacteristic>& characteristics,
                                  const std::vector<unsigned>& items,
                                  const std::vector<unsigned>& features);

}  // namespace trueaxis

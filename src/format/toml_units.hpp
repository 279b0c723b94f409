// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace trueaxis {

/// A spelling of a key in a file and the factor from its unit to the unit inside.
struct KeySpelling {
  std::string key;
  double factor = 1.0;
};

/// Every spelling of a key whose suffix is a unit inside ("x0_mm": x0_mm, x0_um, x0_in, x0_m), the
/// usual one first; the key itself when it has no such suffix.
std::vector<KeySpelling> key_spellings(std::string_view key);

/// A key cut before its unit: "x0", "_um"; the unit is empty where the key has none.
struct KeyParts {
  std::string_view stem, unit;
};
KeyParts parts_of_key(std::string_view key);

}  // namespace trueaxis

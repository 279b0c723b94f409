// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <string>

#include "trueaxis/effect.hpp"

namespace trueaxis {

/// What an effect is called in its family, for the mark of a chart: "radial synchronous".
inline std::string short_name(const Effect& effect) {
  std::string name(effect.id.substr(effect.id.rfind('.') + 1));
  std::ranges::replace(name, '_', ' ');
  return name;
}

/// What it is called in a sentence: "probe latency".
inline std::string plain_name(const Effect& effect) {
  std::string name(effect.id);
  std::ranges::replace(name, '.', ' ');
  std::ranges::replace(name, '_', ' ');
  return name;
}

}  // namespace trueaxis

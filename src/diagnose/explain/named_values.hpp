// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "trueaxis/effect.hpp"

namespace trueaxis::diagnose_detail {

/// A named value inside (mm, rad, s).
struct NamedValue {
  std::string name, unit;
  double value = 0.0;
};

/// A fitted effect in the catalogue's parameters: those of its linear ones that are free, a pair of
/// cos and sin as amplitude and phase, then its shape. A pair "lobing" gives lobing and
/// lobing_phase, the pair "amplitude" gives amplitude and phase.
std::vector<NamedValue> values_of(const TermValue& term);

}  // namespace trueaxis::diagnose_detail

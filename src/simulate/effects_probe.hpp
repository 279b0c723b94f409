// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "simulate/effects.hpp"

namespace trueaxis::virtual_lathe {

/// Slots B and E: the probe's line and the sensor's response.
std::span<const EffectEntry> probe_effects();

}  // namespace trueaxis::virtual_lathe

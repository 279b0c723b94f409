// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "simulate/effects.hpp"

namespace trueaxis::virtual_lathe {

/// Slot C: what the part's surface is, in the part's own frame.
std::span<const EffectEntry> part_effects();

}  // namespace trueaxis::virtual_lathe

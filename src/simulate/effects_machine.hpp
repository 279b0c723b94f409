// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "simulate/effects.hpp"

namespace trueaxis::virtual_lathe {

/// Slots A and D: where spindle and slides really are against what is recorded, and when. What the
/// encoder says comes first: the errors of the spindle follow its true angle.
std::span<const EffectEntry> machine_effects();

}  // namespace trueaxis::virtual_lathe

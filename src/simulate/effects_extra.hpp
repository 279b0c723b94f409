// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "simulate/effects.hpp"

namespace trueaxis::virtual_lathe {

/// What no catalogue has: forms and motions for tests that must end with "unknown", then patterns
/// without a cause, which play back what a diagnosis leaves unexplained.
std::span<const EffectEntry> extra_effects();

}  // namespace trueaxis::virtual_lathe

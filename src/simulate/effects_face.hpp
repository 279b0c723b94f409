// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "simulate/effects.hpp"

namespace trueaxis::virtual_lathe {

/// What a face shows: its form, axial motion, the X slide.
std::span<const EffectEntry> face_effects();

}  // namespace trueaxis::virtual_lathe

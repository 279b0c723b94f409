// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string_view>

#include "axis/axis_case.hpp"

namespace trueaxis::axis {

/// What a part that is probed by hand is hidden to have.
enum class Hidden {
  none,
  lobes,  ///< one to three orders of 2 to 6
  local,  ///< a dent, or a flat along the part
  both,
};
inline constexpr Hidden all_hidden[] = {Hidden::none, Hidden::lobes, Hidden::local, Hidden::both};
std::string_view name_of(Hidden hidden);

/// A part probed in sections of a few even angles, without a clock.
struct SparseCase : Case {
  Hidden hidden = Hidden::none;
  int angles = 12, sections = 5;
};

/// Draws the case of this seed: 8, 12, 16, 24 or 36 angles in 3 to 6 sections, σ 1 to 5 µm.
SparseCase draw_sparse(Hidden hidden, std::uint64_t seed);

/// Its readings: C and Z, no time, no pass.
ProbeStream probe(const SparseCase& of);

Diagnosis diagnosed(const SparseCase& of);

}  // namespace trueaxis::axis

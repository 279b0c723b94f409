// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>

namespace trueaxis::form {

/// The sizes of an order are weighed so many at a time: columns over them are padded with zeros.
inline constexpr std::size_t sizes_at_once = 8;

/// The evidence of one course along Z, of each size. Eq. 320.
/// @param values λ_j of its coordinates
/// @param squares c_j² σ⁴
/// @param gain τ²/σ² of each size, padded
/// @param log_evidence ln B of each, 0 where `gain` is
void weigh_sizes(std::span<const double> values, std::span<const double> squares,
                 std::span<const double> gain, double variance, double* log_evidence);

}  // namespace trueaxis::form

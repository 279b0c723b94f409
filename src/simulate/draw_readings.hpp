// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>

#include "simulate/clean_stream.hpp"

namespace trueaxis::virtual_lathe {

/// The readings that noise of `seed` makes of a clean stream: as simulate() draws them, with faster
/// generators of its own. The errors of one seed are the same bits on every platform, but for those
/// of an `autoregression`, whose variates are Boost's, as simulate()'s are.
void draw_readings(const CleanStream& clean, const Noise& noise, std::uint64_t seed,
                   std::span<double> reading_mm);

}  // namespace trueaxis::virtual_lathe

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "trueaxis/effect.hpp"

/// What the kinds of term share; each has names of the linear and of the shape parameters, columns.
namespace trueaxis::kind {

/// Readings that a `fill` is given at most: its buffers lie on the stack, in the first cache.
inline constexpr std::size_t chunk_size = 256;

using Columns = std::span<double* const>;
using Linear = std::vector<LinearParameter>;
using Names = std::vector<std::string>;

/// The factors cos, sin of a value that moves `port`.
inline std::string unit_of(Port port) { return port == Port::c ? "rad" : "mm"; }

}  // namespace trueaxis::kind

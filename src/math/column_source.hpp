// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <span>

namespace trueaxis {

/// Columns that are not kept but made where they are asked for: fills entries `begin` to
/// `begin` + `size` of every one of them. May be asked by several threads.
using ColumnSource =
    std::function<void(std::size_t begin, std::size_t size, std::span<double* const> columns)>;

}  // namespace trueaxis

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace trueaxis::nc {

/// The axes of a program, in the order in which their words are written.
inline constexpr std::string_view axis_letters = "XYZABC";
inline constexpr std::size_t axis_count = 6;

/// A number for each axis: mm of X Y Z, rad of A B C.
using AxisValues = std::array<double, axis_count>;
/// A set of axes: bit k is axis k.
using AxisSet = std::uint8_t;
inline constexpr AxisSet linear_axes = 0b000111, all_axes = 0b111111;

inline constexpr bool is_rotary(std::size_t axis) { return axis >= 3; }
inline constexpr bool has(AxisSet set, std::size_t axis) { return (set >> axis & 1U) != 0; }
inline constexpr AxisSet only(std::size_t axis) { return static_cast<AxisSet>(1U << axis); }

/// Index of an axis letter (upper case); axis_count for any other.
inline constexpr std::size_t axis_of(char letter) {
  const std::size_t at = axis_letters.find(letter);
  return at == std::string_view::npos ? axis_count : at;
}

}  // namespace trueaxis::nc

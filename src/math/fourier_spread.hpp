// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace trueaxis {

/// φ(x) = exp(β(√(1 − x²) − 1)), |x| ≤ 1, over `spread_width` points of a grid.
inline constexpr std::size_t spread_width = 12;
/// 2.3 times the width for a grid twice as fine as needed (Barnett, Magland, af Klinteberg 2019).
inline constexpr double spread_beta = 2.3 * spread_width;

/// φ at the grid points as polynomials of the distance d of the first of them, in v = 2 (d +
/// width/2) − 1, to 1e-12: coefficient of v^k at grid point l.
inline constexpr std::size_t spread_degree = 15;
using SpreadPolynomials = std::array<std::array<double, spread_width>, spread_degree + 1>;
const SpreadPolynomials& spread_polynomials();

/// What abscissae are placed by: a turn of t is `size` points of the grid and one of the kernel's.
struct SpreadGrid {
  double middle;                    ///< of t: it is counted from there
  long double turns, middle_turns;  ///< a unit of t, of a step of the orders and of their middle
  double size;                      ///< points of a turn of a step
};
/// Places abscissae: columns of one length, those of SpreadPoints and the angle (rad, −π … π) of
/// the phase factor.
void place(const SpreadGrid& grid, std::span<const double> t, std::span<std::uint32_t> first,
           std::span<double> distance, std::span<double> angle_rad);

/// Values to spread: each has its first grid point, the distance of that point from the abscissa,
/// −width/2 … 1 − width/2 in steps of the grid, and a phase factor.
struct SpreadPoints {
  std::span<const std::uint32_t> first;
  std::span<const double> distance, cosine, sine;
};

/// Values at the points, and the grids they go to, `spread_width` longer than the largest `first`.
struct SpreadColumn {
  const double* value;
  double *real, *imaginary;
};

/// Adds value × (cosine, sine) × φ to the grids of every column; φ is computed once for all.
void spread(const SpreadPoints& points, std::span<const SpreadColumn> columns);

}  // namespace trueaxis

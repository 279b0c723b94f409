// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "diagnose/geometry/linearisation_point.hpp"
#include "trueaxis/effect.hpp"

namespace trueaxis::diagnose_detail {

/// A pattern of no cause: cos, sin of (order θ − 2π ν s) × Legendre polynomial, or a local bump.
struct Pattern {
  enum class Kind { cell, line, bump } kind = Kind::cell;
  double order = 0.0;    ///< of the angle
  bool spindle = false;  ///< angle C instead of the part's θ
  int degree = 0;        ///< Legendre, along s or time
  bool in_time = false;
  double frequency = 0.0;  ///< ν: cycles per mm along s, or per second
  double angle_rad = 0.0, position_mm = 0.0, width_rad = 0.0, length_mm = 0.0;  ///< of a bump
};

/// A cause of the catalogue with its shape, or a pattern: a few columns beside the surface's own.
struct Hypothesis {
  const Effect* effect = nullptr;  ///< nullptr: a pattern
  TermShape shape;
  std::vector<std::size_t> free;  ///< which linear parameters of the term are free; empty: all
  Pattern pattern;
  bool with_radial = false;  ///< beside a tilt motion the radial one of its order: a lever anywhere
  double tests = 1.0;        ///< how many hypotheses of its kind were tried: what its choice costs

  std::size_t columns() const;
  std::string id() const { return effect ? std::string(effect->id) : "unexplained"; }
};

/// ∂X/∂(linear parameter) over readings [begin, end) of one set-up.
void fill(const Hypothesis& hypothesis, const LinearisationPoint& point, std::size_t begin,
          std::size_t end, std::span<double* const> columns);

/// The columns of a cell of a Legendre degree along s from those of its degree 0.
void raise_degree(const Hypothesis& cell, const LinearisationPoint& point, std::size_t begin,
                  std::size_t end, std::span<const double* const> constant,
                  std::span<double* const> columns);

/// A hypothesis of an effect by id. @throws ContractViolation for an unknown id.
Hypothesis of_effect(const char* id, TermShape shape, std::vector<std::size_t> free = {},
                     double tests = 1.0);

std::size_t columns_of(std::span<const Hypothesis> list);

}  // namespace trueaxis::diagnose_detail

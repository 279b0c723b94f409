// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "diagnose/geometry/linearisation_point.hpp"
#include "trueaxis/effect.hpp"

namespace trueaxis::diagnose_detail {

/// A term that may be taken: how many of its kind were tried is what its choice costs.
struct Hypothesis : TermValue {
  double tests = 1.0;
  /// The range of a pattern's typical sizes, mm; 0: none is known.
  double smallest_mm = 0.0, largest_mm = 0.0;
};

/// Whether two hypotheses are one: effect, shape, free parameters, pattern and tests.
bool same(const Hypothesis& a, const Hypothesis& b);
bool same(std::span<const Hypothesis> a, std::span<const Hypothesis> b);

/// ∂X/∂(linear parameter) over a part of the point, of one set-up.
void fill(const Hypothesis& hypothesis, const LinearisationPoint& point, const PointPart& part,
          std::span<double* const> columns);

/// The columns of a Fourier-Legendre function of a degree along s from those of its degree 0.
void raise_degree(const Hypothesis& function, const LinearisationPoint& point,
                  const PointPart& part, std::span<const double* const> constant,
                  std::span<double* const> columns);

Hypothesis of_effect(const Effect& effect, TermShape shape, std::vector<std::size_t> free = {},
                     double tests = 1.0);

/// The same by id. @throws ContractViolation for an unknown one.
Hypothesis of_effect(const char* id, TermShape shape, std::vector<std::size_t> free = {},
                     double tests = 1.0);

std::size_t columns_of(std::span<const Hypothesis> list);

/// Whether it has a place of linearisation that is its own size (Refinement::linearises).
bool is_linearised_at_its_size(const Hypothesis& h);

/// What terms do to X, one entry a reading, mm. @param linear of all terms, term after term
std::vector<double> contribution(const LinearisationPoint& point, std::span<const Hypothesis> terms,
                                 std::span<const double> linear, int threads = 1);

}  // namespace trueaxis::diagnose_detail

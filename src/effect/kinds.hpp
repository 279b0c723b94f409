// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "trueaxis/effect.hpp"

/// The kinds of term, a file each: names of the linear and of the shape parameters, columns.
namespace trueaxis::kind {

/// Readings that a `fill` is given at most: its buffers lie on the stack, in the first cache.
inline constexpr std::size_t chunk_size = 256;

using Columns = std::span<double* const>;
using Linear = std::vector<LinearParameter>;
using Names = std::vector<std::string>;

Linear linear(const Harmonic& term, const TermShape& shape);
Linear linear(const PolynomialInZ& term, const TermShape& shape);
Linear linear(const PeriodicInZ& term, const TermShape& shape);
Linear linear(const PeriodicInTime& term, const TermShape& shape);
Linear linear(const GrowthInTime& term, const TermShape& shape);
Linear linear(const PartStep& term, const TermShape& shape);
Linear linear(const ArgumentShift& term, const TermShape& shape);
Linear linear(const ProbeLine& term, const TermShape& shape);
Linear linear(const Response& term, const TermShape& shape);

Names shapes(const Harmonic& term);
Names shapes(const PolynomialInZ& term);
Names shapes(const PeriodicInZ& term);
Names shapes(const PeriodicInTime& term);
Names shapes(const GrowthInTime& term);
Names shapes(const PartStep& term);
Names shapes(const ArgumentShift& term);
Names shapes(const ProbeLine& term);
Names shapes(const Response& term);

void fill(const Harmonic& term, const TermContext& at, const TermShape& shape, Columns out);
void fill(const PolynomialInZ& term, const TermContext& at, const TermShape& shape, Columns out);
void fill(const PeriodicInZ& term, const TermContext& at, const TermShape& shape, Columns out);
void fill(const PeriodicInTime& term, const TermContext& at, const TermShape& shape, Columns out);
void fill(const GrowthInTime& term, const TermContext& at, const TermShape& shape, Columns out);
void fill(const PartStep& term, const TermContext& at, const TermShape& shape, Columns out);
void fill(const ArgumentShift& term, const TermContext& at, const TermShape& shape, Columns out);
void fill(const ProbeLine& term, const TermContext& at, const TermShape& shape, Columns out);
void fill(const Response& term, const TermContext& at, const TermShape& shape, Columns out);

/// The factors cos, sin of a value that moves `port`.
inline std::string unit_of(Port port) { return port == Port::c ? "rad" : "mm"; }

}  // namespace trueaxis::kind

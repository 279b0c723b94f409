// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "effect/kinds.hpp"

/// Terms that are functions of angle, Z and time.
namespace trueaxis::kind {

Linear linear(const Harmonic& term, const TermShape& shape);
Names shapes(const Harmonic& term);
void fill(const Harmonic& term, const TermContext& at, const TermShape& shape, Columns out);

Linear linear(const PolynomialInZ& term, const TermShape& shape);
Names shapes(const PolynomialInZ& term);
void fill(const PolynomialInZ& term, const TermContext& at, const TermShape& shape, Columns out);

Linear linear(const PeriodicInZ& term, const TermShape& shape);
Names shapes(const PeriodicInZ& term);
void fill(const PeriodicInZ& term, const TermContext& at, const TermShape& shape, Columns out);

Linear linear(const PeriodicInTime& term, const TermShape& shape);
Names shapes(const PeriodicInTime& term);
void fill(const PeriodicInTime& term, const TermContext& at, const TermShape& shape, Columns out);

Linear linear(const GrowthInTime& term, const TermShape& shape);
Names shapes(const GrowthInTime& term);
void fill(const GrowthInTime& term, const TermContext& at, const TermShape& shape, Columns out);

}  // namespace trueaxis::kind

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "diagnose/regression/normal_equations.hpp"
#include "infer/size_prior.hpp"

namespace trueaxis::diagnose_detail {

/// Whether a term is a function of the reading alone, other than a gain: it makes several orders of
/// an eccentricity, and moves the axis.
bool bends_reading(const EffectTerm& term);

/// Over the sizes that the catalogue calls typical (Eq. 79).
SizePrior size_prior(const Hypothesis& hypothesis);

/// The same where what is stated of a size is right.
SizePrior stated_prior(const Hypothesis& hypothesis);

/// Data and prior of a hypothesis whose columns are `own`, after what the projection took out.
/// @param count rows of the equations
Weighed weigh(const Hypothesis& hypothesis, const Projection& projection, const Columns& own,
              std::size_t count);

}  // namespace trueaxis::diagnose_detail

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "blind/families.hpp"

namespace trueaxis::blind {

/// λ = ‖(I − P) μ‖²/σ², μ the effect's change of the clean readings with `others`, P the
/// surface's parameters and, when `protect_others`, all that the causes of `others` can do at their
/// shapes.
double lambda(const Bench& bench, const Effect& effect, const std::vector<Effect>& others,
              double sigma_mm, bool protect_others);

/// The effect with the sizes at which λ (alone, of the surface) is the wanted one within 0.5 %.
/// λ is nearly quadratic in the size: a few steps. Sizes that do nothing stay as they are.
Effect sized_for(const Bench& bench, Effect effect, double sigma_mm, double wanted);

}  // namespace trueaxis::blind

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "blind/families.hpp"

namespace trueaxis::blind {

/// An effect that is in the data, and what else is in them.
struct TrueEffect {
  Effect effect;
  std::vector<Effect> others;
  double sigma_mm = 0.0;
};

/// What the judge needs to search the shape of a rival cause: the part of the truth's change that
/// the surface and the other true effects leave.
struct Residue {
  Subspace taken;
  Eigen::VectorXd left;
};

Residue residue(const Bench& bench, const TrueEffect& truth);

/// Shapes at which the rival cause can mimic the residual, likely ones first: lines of the spectrum
/// over C, t, Z, X; orders by their power; grids of bearings, decays, instants and time constants.
std::vector<Effect> mimics(const Bench& bench, const std::string& rival, const Residue& of);

/// Smallest distance d, in σ, of the truth's prediction from what the rival cause can do: d² = ‖(I
/// − P) μ‖²/σ², P of the surface, the other true effects and the rival cause with free amplitudes
/// and phases; its shape is searched and refined, down to `enough`.
double distance(const Bench& bench, const TrueEffect& truth, const std::string& rival,
                double enough = 0.0);

}  // namespace trueaxis::blind

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "infer/size_prior.hpp"

namespace trueaxis::infer {

inline constexpr double catalogue_first =
    4.0;  ///< 2 ln of the odds that a pattern is not a new cause

/// What data and prior say of a term of a model after what a projection took out; its choice among
/// many is in the criterion.
using WeighTerm = std::function<Weighed(std::size_t term, const Projection& beside)>;

inline constexpr std::size_t none = static_cast<std::size_t>(-1);
/// Columns of a base and of all terms but one.
Columns besides(Columns base, std::span<const Columns> terms, std::size_t but = none);

/// ln p of the F test of columns after others (Eq. 69). @param count rows of the equations
double log_p_of(const Projection& beside, const Columns& own, std::size_t count);

/// A model as columns of one Gram matrix, which outlives it: what is always fitted, and its terms.
struct Fitted {
  const Eigen::MatrixXd& gram;
  Columns base;
  std::vector<Columns> terms;
  std::size_t count = 0;  ///< rows of the equations

  /// All columns but those of one term; of all terms where none is named.
  Columns besides(std::size_t but = none) const { return infer::besides(base, terms, but); }
  Projection beside(std::size_t term) const { return {gram, besides(term)}; }
  /// ln p of a term after all others.
  double log_p(std::size_t term) const { return log_p_of(beside(term), terms[term], count); }
  /// Coefficients of a term, fitted with all others.
  Eigen::VectorXd of(std::size_t term) const;

  /// ν ln RSS, and what prior and choice of each term cost: what two models with the same noise are
  /// compared by (Eq. 81).
  /// @param one_width if terms share their columns, use the width of all together, not the sum of
  /// what each has after the others (Eq. 82a)
  double criterion(const WeighTerm& weigh_term, bool one_width = false) const;
};

/// The terms that remain after the weakest were dropped, one by one, until all pass (Eq. 69).
/// @param level ln of the p-value that each has to be below
std::vector<std::size_t> remaining(Fitted model, std::vector<double> level);

}  // namespace trueaxis::infer

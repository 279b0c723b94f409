// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "diagnose/regression/normal_equations.hpp"
#include "diagnose/regression/problem.hpp"

namespace trueaxis::diagnose_detail {

/// All hypotheses that are tried one by one in every step, and their Gram matrix, which one pass
/// over the readings makes and every step of a search uses again. Variants of one effect share its
/// columns, and causes that are functions of the Fourier-Legendre basis those of the basis.
struct Dictionary {
  std::vector<double> phi;
  NormalEquations equations;
  std::vector<Hypothesis> presets, basis;
  std::vector<Columns> preset_places, basis_places;
  std::size_t columns = 0;  ///< of the equations, without what a step appends for a while
};

std::unique_ptr<Dictionary> make_dictionary(const Problem& problem, const std::vector<double>& phi);

}  // namespace trueaxis::diagnose_detail

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "diagnose/geometry/hypothesis.hpp"
#include "diagnose/geometry/observation_mask.hpp"
#include "diagnose/regression/normal_equations.hpp"

namespace trueaxis::diagnose_detail {
/// Fourier × Legendre basis of the part's angle, order 0 from degree 0 on. Of several set-ups also
/// of the spindle's angle; of several passes also × Legendre in time.
std::vector<Hypothesis> fourier_legendre_basis(const LinearisationPoint& point,
                                               const Resolution& resolution);

/// The few of its functions that tell the noise from what is not: all orders, degrees 0 and 1, and
/// order 0 up to degree 5; at most a third as many columns as readings.
std::vector<Hypothesis> small_fourier_legendre_basis(const LinearisationPoint& point,
                                                     const Resolution& resolution);

/// All hypotheses that are tried one by one in every step, and their Gram matrix, which one pass
/// over the readings makes and every step of a search uses again. Variants of one effect share its
/// columns, and causes that are functions of the Fourier-Legendre basis those of the basis.
struct Dictionary {
  std::vector<double> phi;
  NormalEquations equations;
  std::vector<Hypothesis> presets, basis;
  std::vector<Columns> preset_places, basis_places;
  std::size_t columns = 0;     ///< of the equations, without what a step appends for a while
  double noise_freedom = 0.0;  ///< readings beyond the columns after which the noise was estimated
};

std::unique_ptr<Dictionary> make_dictionary(const Problem& problem, const std::vector<double>& phi);

}  // namespace trueaxis::diagnose_detail

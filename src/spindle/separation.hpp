// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Dense>
#include <complex>
#include <span>
#include <vector>

#include "spindle/layout.hpp"
#include "spindle/synchronous.hpp"

namespace trueaxis {

/// An angle of a sensor or of a re-indexing that is known with u.
struct AngleInfluence {
  double u_rad = 0.0;
  std::vector<std::size_t> channels;  ///< that it turns
  bool turns_motion = true;           ///< a sensor's angle; a re-indexing turns the form alone
};

/// The unknowns of one order, by generalised least squares (Eq. 144).
struct OrderSolution {
  double condition = 1.0;          ///< of A_n
  double largest_condition = 1.0;  ///< above which it is suppressed (Eq. 146)
  double u_reading_mm = 0.0;       ///< of one sensor's amplitude of this order
  std::vector<bool> determined;    ///< of every unknown
  Eigen::VectorXcd unknowns;       ///< zero where it is not determined
  Eigen::VectorXcd guessed;        ///< the shortest solution where it is not determined
  Eigen::VectorXd u_mm;            ///< from noise, of either component
  /// What one u of every influence moves, unknowns by influences (Eq. 147).
  Eigen::MatrixXcd moved_mm;
  double chi_squared = 0.0, freedom = 0.0;  ///< of what channels contradict (both components)
};

/// Which orders are solved, and how.
struct SeparationTask {
  int order_min = 2, order_max = 100;
  double largest_condition = 100.0, coverage_factor = 2.0;
  double remainder_mm = 0.0;  ///< of one amplitude: what the second order leaves (Eq. 149)
};

/// Solves the orders. @param parts one for every run.
std::vector<OrderSolution> separate(const Layout& layout, std::span<const SynchronousPart> parts,
                                    std::span<const AngleInfluence> influences,
                                    const SeparationTask& task);

}  // namespace trueaxis

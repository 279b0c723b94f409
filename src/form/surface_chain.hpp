// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "form/surface_sums.hpp"

namespace trueaxis::form {

struct ChainOptions {
  int draws = 300;
  std::uint64_t seed = 12181;
  double least_noise_mm = 0.0;  ///< a reading's standard deviation is no less
};

/// Draws from what the readings show of a surface.
struct SurfacePosterior {
  Eigen::MatrixXd coefficients;    ///< a column a draw
  std::vector<double> noise_mm;    ///< of a reading, of each draw
  Eigen::VectorXd order_is_there;  ///< of each order, the share of draws that have any of it
};

/// A Markov chain of the surface's coefficients, of which terms are there at all, how large those
/// are, and of the noise (Eqs. 319, 320). Radius, cone and axis (orders 0 and 1 of degrees 0 and 1)
/// have no prior. Deterministic.
SurfacePosterior sample_surface(const SurfaceTerms& terms, SurfaceSums sums,
                                const ChainOptions& options);

}  // namespace trueaxis::form

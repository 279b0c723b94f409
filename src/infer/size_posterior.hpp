// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "infer/size_prior.hpp"

namespace trueaxis::infer {

/// One normal of the mixture that the posterior of a term's coefficients is: of one scale.
struct SizePart {
  double weight = 0.0;  ///< their sum is 1
  Eigen::VectorXd mean;
  Eigen::MatrixXd covariance;
};

/// The mixture whose mean and covariance weigh() gives.
std::vector<SizePart> size_posterior(const SizePrior& prior, const Projection& projection,
                                     const Columns& own, std::size_t count);

}  // namespace trueaxis::infer

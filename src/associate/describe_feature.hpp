// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "associate/least_squares.hpp"

namespace trueaxis {

/// `placed`, its origin nearest to the centroid, in the terms of the result.
Feature feature_of(const Placed& placed);

/// Standard uncertainty of each number of it from the covariance of the motions (GUM 5.2).
Feature uncertainty_of(const Placed& placed, const PointCloud& cloud,
                       const ParameterMatrix& covariance);

/// Covariance of the motions from the residuals: σ² (JᵀJ)⁻¹, σ² of the distances (Eq. 248).
ParameterMatrix covariance_of(const LeastSquares& fit, const PointCloud& cloud);

/// Least and largest distance and the sum of squares over all points.
struct DistanceRange {
  double least = 0.0, largest = 0.0, sum_of_squares = 0.0;
};
DistanceRange range_of(const Placed& placed, const PointCloud& cloud);

}  // namespace trueaxis

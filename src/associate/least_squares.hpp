// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "associate/placed.hpp"
#include "associate/point_cloud.hpp"

namespace trueaxis {

/// Sums over all points of the products of [J d] at a place (Eq. 245).
struct NormalSums {
  ParameterMatrix jtj;
  Parameters jtd;
  double sum_of_squares = 0.0;
};
NormalSums accumulate(const Placed& placed, const PointCloud& cloud);

/// A minimum of the sum of squares, or where the search for it ended.
struct LeastSquares {
  Placed placed;
  NormalSums normal;
  int iterations = 0;
  bool converged = false;
};

/// Levenberg-Marquardt from `start` in the frame of the element, which moves with it: every step is
/// made where its own derivatives are exact and short (Eq. 246).
LeastSquares least_squares(const Placed& start, const PointCloud& cloud, int max_iterations);

/// What turns a step of each motion into mm at the far end of the points: 1 of a shift or size, the
/// length of the cloud of an angle.
Parameters step_lengths(Shape shape, const PointCloud& cloud);

/// The Gaussian element of points that are not degenerate, and why there is none where `why` is not
/// empty.
struct GaussianElement {
  LeastSquares fit;
  std::string why;
  int starts = 1;
};
GaussianElement gaussian_element(Shape shape, const PointCloud& cloud, int max_iterations);

/// Why the points show no such element at all: on one point, a line, a plane. Empty where they may.
std::string degenerate_points(Shape shape, const PointCloud& cloud);

}  // namespace trueaxis

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "associate/least_squares.hpp"

namespace trueaxis {

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

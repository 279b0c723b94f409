// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "associate/placed.hpp"
#include "associate/point_cloud.hpp"

namespace trueaxis {

/// Which side of the points counts: sign × distance is made least where it is largest.
struct Sides {
  bool outer = true, inner = true;
  /// The last motion of the shape, its size, is not moved: it follows from the largest value.
  bool size_follows = false;
};
Sides sides_of(Shape shape, Criterion criterion);
std::size_t free_motions(Shape shape, const Sides& sides);

/// Where the largest value h of a few points is least, or where the search for it ended.
struct Minimax {
  struct Contact {
    std::size_t point = 0;
    int sign = 1;
    double distance = 0.0, multiplier = 0.0;
  };
  Placed placed;
  double h = 0.0;
  std::vector<Contact> contacts{};
  double stationarity = 0.0;  ///< |Σ λ s ∇d|
  double gap = 0.0;           ///< of the linear program in a box as large as the cloud
  int iterations = 0;
  bool converged = false;
  bool runs_away = false;  ///< the element grows without bound
};

/// Sequential linear programming in a box that follows its success, each step bettered by Newton's
/// on the points that hold it up (Eqs. 249, 250): quadratic convergence with any number of them.
Minimax minimax(const Placed& start, const PointCloud& cloud, const Sides& sides,
                int max_iterations);

}  // namespace trueaxis

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
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

/// The furthest points of every stretch of the cloud, outside and inside.
struct Furthest {
  struct One {
    std::size_t point = 0;
    double value = -1e300;
  };
  std::vector<One> outer, inner;
  double top = -1e300;  ///< of the sides that count
};
Furthest furthest(const Placed& placed, const PointCloud& cloud, const Sides& sides);

/// Some points of a cloud, with their places in it, in that order; all if they are few.
class ChosenPoints {
 public:
  explicit ChosenPoints(const PointCloud& cloud);
  /// The furthest points beyond h, of sides that count. @returns whether there was a new one
  bool add(const Furthest& from, const Sides& sides, double h);
  PointCloud cloud() const { return part_of(cloud_, points_); }
  std::size_t index(std::size_t i) const { return indices_[i]; }
  bool all() const { return indices_.size() == cloud_.points.size(); }

 private:
  void gather();
  const PointCloud& cloud_;
  std::vector<std::size_t> indices_;
  std::vector<Point3> points_;
};

/// The element of a criterion of extremes over all points; `best.contacts` name them by their
/// places in the cloud. `why` is not empty where there is none.
struct ExtremeElement {
  Minimax best;
  std::string why;
  int starts = 1;
  bool global = false;
};

/// From the Gaussian element and, where the criterion is not convex, from places about it. If there
/// are many points, those that may matter are solved for; all are compared, and those beyond are
/// added until there is none (Eq. 251).
ExtremeElement extreme_element(const Placed& gaussian, const PointCloud& cloud, Criterion criterion,
                               int max_iterations);

/// The least sum of squares among the elements outside of the material, all points on its side
/// (Eq. 254): what ISO 5459 takes for a datum that is not a Chebyshev one. Contacts carry the
/// multipliers of the mean square; `h` is the largest distance beyond, 0 but for rounding.
ExtremeElement constrained_element(const Placed& gaussian, const PointCloud& cloud,
                                   bool material_inside, int max_iterations);

}  // namespace trueaxis

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "associate/minimax.hpp"

namespace trueaxis {

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

}  // namespace trueaxis

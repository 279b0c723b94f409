// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <functional>
#include <span>
#include <vector>

#include "associate/placed.hpp"

namespace trueaxis {

/// Points with what every association needs of them, in mm from `base`, one of the points.
struct PointCloud {
  std::span<const Point3> points;
  Point3 base{};
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();
  Eigen::Matrix3d principal =
      Eigen::Matrix3d::Identity();  ///< rows: directions of scatter, the largest first
  Eigen::Vector3d scatter = Eigen::Vector3d::Zero();  ///< standard deviation along them
  double length = 0.0;    ///< root mean square distance from the centroid: the scale of it all
  double rounding = 0.0;  ///< of a coordinate
  bool in_plane = false;  ///< every third coordinate is 0
  int threads = 0;
};
PointCloud cloud_of(std::span<const Point3> points, int threads);

/// A cloud of some of its points, with the numbers of the whole.
PointCloud part_of(const PointCloud& cloud, std::span<const Point3> some);

/// Which of n points is the i-th of a sample: spread by the golden ratio, so that no period of the
/// sampling is met.
std::size_t spread_index(std::size_t i, std::size_t n);

/// So many points of a cloud; all, where there are no more.
std::vector<Point3> sample_of(const PointCloud& cloud, std::size_t most);

/// A point in mm from `base`.
Eigen::Vector3d from_base(const PointCloud& cloud, const Point3& point);

/// `work(first, last, chunk)` for ranges of points that do not depend on the number of threads.
inline constexpr std::size_t points_per_chunk = 8192;
std::size_t chunks_of(std::size_t points);
void for_each_chunk(const PointCloud& cloud,
                    const std::function<void(std::span<const Point3>, std::size_t)>& work);

}  // namespace trueaxis

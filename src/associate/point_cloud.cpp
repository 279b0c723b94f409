// SPDX-License-Identifier: Apache-2.0
#include "associate/point_cloud.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>

#include "base/threads.hpp"
#include "math/golden_section.hpp"

namespace trueaxis {
namespace {

/// Sums over a chunk of points from base: 1, x and x xᵀ.
struct Moments {
  Eigen::Vector3d first = Eigen::Vector3d::Zero();
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();
  double largest = 0.0;
  bool in_plane = true;
};

Moments moments_of(std::span<const Point3> points, const Point3& base) {
  double sum[9] = {}, largest = 0.0, off_plane = 0.0;
  for (const Point3& point : points) {
    const double x = point[0] - base[0], y = point[1] - base[1], z = point[2] - base[2];
    sum[0] += x, sum[1] += y, sum[2] += z;
    sum[3] += x * x, sum[4] += x * y, sum[5] += x * z;
    sum[6] += y * y, sum[7] += y * z, sum[8] += z * z;
    largest = std::max({largest, std::abs(point[0]), std::abs(point[1]), std::abs(point[2])});
    off_plane = std::max(off_plane, std::abs(point[2]));
  }
  Moments out;
  out.first << sum[0], sum[1], sum[2];
  out.second << sum[3], sum[4], sum[5], sum[4], sum[6], sum[7], sum[5], sum[7], sum[8];
  out.largest = largest;
  out.in_plane = off_plane == 0.0;
  return out;
}

}  // namespace

std::size_t chunks_of(std::size_t points) {
  return (points + points_per_chunk - 1) / points_per_chunk;
}

void for_each_chunk(const PointCloud& cloud,
                    const std::function<void(std::span<const Point3>, std::size_t)>& work) {
  const std::size_t chunks = chunks_of(cloud.points.size());
  const int threads = chunks < 6 ? 1 : cloud.threads;  // fewer are done before a thread has begun
  for_each_index(chunks, threads, [&](std::size_t i) {
    const std::size_t first = i * points_per_chunk;
    work(cloud.points.subspan(first, std::min(points_per_chunk, cloud.points.size() - first)), i);
  });
}

PointCloud cloud_of(std::span<const Point3> points, int threads) {
  PointCloud cloud{.points = points, .base = points.front(), .threads = threads};
  std::vector<Moments> parts(chunks_of(points.size()));
  for_each_chunk(cloud, [&](std::span<const Point3> chunk, std::size_t i) {
    parts[i] = moments_of(chunk, cloud.base);
  });
  Moments all;
  for (const Moments& part : parts) {
    all.first += part.first;
    all.second += part.second;
    all.largest = std::max(all.largest, part.largest);
    all.in_plane = all.in_plane && part.in_plane;
  }
  const auto n = static_cast<double>(points.size());
  cloud.centroid = all.first / n;
  const Eigen::Matrix3d covariance = all.second / n - cloud.centroid * cloud.centroid.transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(covariance);
  cloud.principal = eigen.eigenvectors().transpose().colwise().reverse();
  cloud.scatter = eigen.eigenvalues().reverse().cwiseMax(0.0).cwiseSqrt();
  cloud.length = cloud.scatter.norm();
  cloud.rounding = all.largest * std::numeric_limits<double>::epsilon();
  cloud.in_plane = all.in_plane;
  return cloud;
}

PointCloud part_of(const PointCloud& cloud, std::span<const Point3> some) {
  PointCloud part = cloud;
  part.points = some;
  return part;
}

std::size_t spread_index(std::size_t i, std::size_t n) {
  const double at = 0.5 + golden_ratio * static_cast<double>(i);
  return std::min(n - 1, static_cast<std::size_t>((at - std::floor(at)) * static_cast<double>(n)));
}

std::vector<Point3> sample_of(const PointCloud& cloud, std::size_t most) {
  const std::size_t n = cloud.points.size();
  if (n <= most) return {cloud.points.begin(), cloud.points.end()};
  std::vector<Point3> sample;
  for (std::size_t i = 0; i < most; ++i) sample.push_back(cloud.points[spread_index(i, n)]);
  return sample;
}

Eigen::Vector3d from_base(const PointCloud& cloud, const Point3& point) {
  return {point[0] - cloud.base[0], point[1] - cloud.base[1], point[2] - cloud.base[2]};
}

}  // namespace trueaxis

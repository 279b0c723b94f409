// SPDX-License-Identifier: Apache-2.0
#include "associate/gaussian.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "associate/distance_kernel.hpp"
#include "associate/starts.hpp"
#include "math/linear_algebra.hpp"

namespace trueaxis {
namespace {

constexpr std::size_t sample_size = 512;

/// Largest distance of a point from the line or plane of largest scatter.
double thickness(Shape flat, const PointCloud& cloud) {
  Placed placed{.shape = flat, .base = cloud.base, .offset = cloud.centroid};
  placed.axes = axes_about(cloud.principal.row(flat == Shape::plane ? 2 : 0));
  double largest = 0.0, distance[block_size];
  for (std::size_t at = 0; at < cloud.points.size(); at += block_size) {
    const std::size_t count = std::min(block_size, cloud.points.size() - at);
    evaluate_only_distances(placed, cloud.points.subspan(at, count), distance);
    for (std::size_t i = 0; i < count; ++i) largest = std::max(largest, std::abs(distance[i]));
  }
  return largest;
}

/// Two places of one element that are not the same surface.
bool apart(const Placed& a, const Placed& b, double length) {
  const double tilt = (a.shape == Shape::sphere || a.shape == Shape::circle_2d)
                          ? 0.0
                          : a.axes.row(2).cross(b.axes.row(2)).norm();
  return tilt > 1e-6 || (a.offset - b.offset).norm() > 1e-6 * length ||
         std::abs(std::abs(a.size) - std::abs(b.size)) > 1e-6 * length;
}

/// The least eigenvalue of JᵀJ / n in mm of motion a mm of step, of 1 where all shows equally.
double least_curvature(const LeastSquares& fit, const PointCloud& cloud) {
  const Parameters per = step_lengths(fit.placed.shape, cloud).cwiseInverse();
  const ParameterMatrix h = per.asDiagonal() * fit.normal.jtj * per.asDiagonal();
  const Eigen::VectorXd values = linear::eigenvalues(h);
  return values.minCoeff() / values.maxCoeff();
}

std::string not_determined(const LeastSquares& fit, const PointCloud& cloud) {
  const bool line = fit.placed.shape == Shape::line_2d || fit.placed.shape == Shape::line_3d;
  const auto equal = [&](Eigen::Index i, Eigen::Index j) {
    return cloud.scatter[i] - cloud.scatter[j] <= 1e-10 * cloud.length;
  };
  if ((line && equal(0, 1)) || (fit.placed.shape == Shape::plane && equal(1, 2)))
    return "The points scatter equally in two directions, so they do not show a direction";
  constexpr double far = 1e7;  // beyond, the bow of the surface is lost in the rounding of points
  if (std::abs(fit.placed.size) > far * cloud.length ||
      fit.placed.offset.norm() > far * cloud.length)
    return "The points do not show where the element ends: it grows without bound";
  const bool inside_out =
      fit.placed.size < 0.0 || (fit.placed.shape == Shape::torus && fit.placed.second_size < 0.0);
  if (inside_out) return "The least sum of squares is that of an element turned inside out";
  if (least_curvature(fit, cloud) < 1e-13)
    return "The points lie so that more than one such element passes them equally well";
  return {};
}

}  // namespace

std::string degenerate_points(Shape shape, const PointCloud& cloud) {
  const double least = 1e-12 * cloud.length + 4.0 * cloud.rounding;
  if (cloud.length <= least) return "All points are one point";
  const bool flat_will_do = shape == Shape::line_2d || shape == Shape::line_3d;
  if (flat_will_do) return {};
  if (cloud.scatter[1] < 1e-6 * cloud.length && thickness(Shape::line_3d, cloud) <= least)
    return "The points lie on one straight line";
  const bool needs_space = shape == Shape::sphere || shape == Shape::cylinder ||
                           shape == Shape::cone || shape == Shape::torus;
  if (needs_space && cloud.scatter[2] < 1e-6 * cloud.length &&
      thickness(Shape::plane, cloud) <= least)
    return "The points lie in one plane";
  return {};
}

GaussianElement gaussian_element(Shape shape, const PointCloud& cloud, int max_iterations) {
  GaussianElement out;
  const std::vector<Point3> some = sample_of(cloud, sample_size);
  const PointCloud sample = part_of(cloud, some);
  const bool all = some.size() == cloud.points.size();
  const std::size_t most = cloud.points.size() < 50 ? 40 : 8;
  std::vector<LeastSquares> minima;
  for (const Placed& start : starts_of(shape, sample, most))
    minima.push_back(least_squares(start, sample, max_iterations));
  out.starts = static_cast<int>(minima.size());
  std::ranges::stable_sort(minima, [](const LeastSquares& a, const LeastSquares& b) {
    return a.normal.sum_of_squares < b.normal.sum_of_squares;
  });
  out.fit = all ? minima.front() : least_squares(minima.front().placed, cloud, max_iterations);
  out.why = not_determined(out.fit, cloud);
  if (!out.why.empty() || !all) return out;
  const double best = minima.front().normal.sum_of_squares;
  const double rounding = static_cast<double>(cloud.points.size()) *
                          std::pow(1e-12 * cloud.length + 4.0 * cloud.rounding, 2);
  for (const LeastSquares& other : minima)
    if (other.converged && other.normal.sum_of_squares <= best * (1.0 + 1e-9) + rounding &&
        apart(other.placed, minima.front().placed, cloud.length) &&
        not_determined(other, cloud).empty())
      out.why = "Two elements in different places pass the points equally well";
  return out;
}

}  // namespace trueaxis

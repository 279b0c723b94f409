// SPDX-License-Identifier: Apache-2.0
#include <Eigen/Dense>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "associate/distance_kernel.hpp"
#include "associate/least_squares.hpp"
#include "associate/placed.hpp"
#include "associate/point_cloud.hpp"
#include "math/linear_algebra.hpp"

namespace trueaxis {
namespace {

/// Coordinates of the points in a frame about the centroid, in units of the cloud's length.
Eigen::Matrix3Xd local_points(const PointCloud& cloud, const Eigen::Matrix3d& axes) {
  Eigen::Matrix3Xd out(3, static_cast<Eigen::Index>(cloud.points.size()));
  for (Eigen::Index i = 0; i < out.cols(); ++i)
    out.col(i) = axes *
                 (from_base(cloud, cloud.points[static_cast<std::size_t>(i)]) - cloud.centroid) /
                 cloud.length;
  return out;
}

/// Least squares of q·x = |q₁|² + |q₂|² (+ |q₃|² for a sphere) over columns 2q₁, 2q₂ (, 2q₃), 1
/// and, for a cone, q₃, q₃².
Eigen::VectorXd algebraic(const Eigen::Matrix3Xd& q, Shape shape) {
  const bool sphere = shape == Shape::sphere, cone = shape == Shape::cone;
  Eigen::MatrixXd a(q.cols(), cone ? 5 : sphere ? 4 : 3);
  a.col(0) = 2.0 * q.row(0).transpose();
  a.col(1) = 2.0 * q.row(1).transpose();
  a.col(2).setOnes();
  Eigen::VectorXd b = q.topRows<2>().colwise().squaredNorm().transpose();
  if (sphere) {
    a.col(3) = 2.0 * q.row(2).transpose();
    b += q.row(2).cwiseAbs2().transpose();
  }
  if (cone) {
    a.col(3) = q.row(2).transpose();
    a.col(4) = q.row(2).cwiseAbs2().transpose();
  }
  Eigen::MatrixXd h = linear::gram(a);
  h.diagonal().array() += 1e-13 * h.trace();
  return linear::solve_normal(h, linear::transposed_product(a, b));
}

double root_of(double square) { return std::sqrt(std::max(square, 1e-12)); }

/// ρ² + z² = 2Rρ + 2z₀z + r² − R² − z₀² about an axis through (x, y).
void set_tube(Placed& placed, const Eigen::Matrix3Xd& q, double x, double y, double length) {
  Eigen::MatrixXd a(q.cols(), 3);
  const Eigen::VectorXd rho =
      ((q.row(0).array() - x).square() + (q.row(1).array() - y).square()).sqrt().transpose();
  a.col(0) = 2.0 * rho;
  a.col(1) = 2.0 * q.row(2).transpose();
  a.col(2).setOnes();
  const Eigen::VectorXd b = rho.cwiseAbs2() + q.row(2).cwiseAbs2().transpose();
  Eigen::MatrixXd h = linear::gram(a);
  h.diagonal().array() += 1e-13 * h.trace();
  const Eigen::VectorXd t = linear::solve_normal(h, linear::transposed_product(a, b));
  placed.size = t[0] * length;
  placed.second_size = root_of(t[2] + t[0] * t[0] + t[1] * t[1]) * length;
  placed.offset += length * t[1] * placed.axes.row(2).transpose();
}

/// The element with its axis in a given direction.
Placed start_along(Shape shape, const PointCloud& cloud, const Eigen::Matrix3d& axes) {
  Placed placed{.shape = shape, .base = cloud.base, .offset = cloud.centroid, .axes = axes};
  if (shape == Shape::plane || shape == Shape::line_2d || shape == Shape::line_3d) return placed;
  const double length = cloud.length;
  const Eigen::Matrix3Xd q = local_points(cloud, axes);
  const Eigen::VectorXd t = algebraic(q, shape);
  Eigen::Vector3d centre(t[0], t[1], shape == Shape::sphere ? t[3] : 0.0);
  placed.offset += length * (axes.transpose() * centre);
  placed.size = root_of(t[2] + centre.squaredNorm()) * length;
  if (shape == Shape::cone) {  // ρ² = (r + z tan α)²
    const double radius = root_of(t[2] + centre.head<2>().squaredNorm());
    const double slope = t[4] > 0.0 ? std::copysign(std::sqrt(t[4]), t[3]) : t[3] / (2.0 * radius);
    placed.second_size = std::atan(slope);
    placed.size = radius * length * std::cos(placed.second_size);
  }
  if (shape == Shape::torus) set_tube(placed, q, t[0], t[1], length);
  return placed;
}

double sum_of_squares(const Placed& placed, const PointCloud& cloud) {
  double sum = 0.0, distance[block_size];
  for (std::size_t at = 0; at < cloud.points.size(); at += block_size) {
    const std::size_t count = std::min(block_size, cloud.points.size() - at);
    evaluate_only_distances(placed, cloud.points.subspan(at, count), distance);
    for (std::size_t i = 0; i < count; ++i) sum += distance[i] * distance[i];
  }
  return sum;
}

struct Candidate {
  Placed placed;
  double cost;
};

/// A short piece of a torus is a bent cylinder: the best cylinder, bent to all sides and radii.
void add_bent_cylinders(const PointCloud& cloud, const std::vector<Eigen::Vector3d>& directions,
                        std::vector<Candidate>& candidates) {
  Candidate best{{}, std::numeric_limits<double>::infinity()};
  for (const Eigen::Vector3d& direction : directions) {
    const Placed placed = start_along(Shape::cylinder, cloud, axes_about(direction));
    const double cost = sum_of_squares(placed, cloud);
    if (cost < best.cost) best = {placed, cost};
  }
  if (!std::isfinite(best.cost)) return;
  constexpr int sides = 16;
  for (const double bend : {1.2, 2.0, 3.5, 6.0, 12.0, 30.0}) {
    for (int side = 0; side < sides; ++side) {
      const double angle = 2.0 * std::numbers::pi * side / sides, radius = bend * best.placed.size;
      const Eigen::Vector3d to =
          best.placed.axes.transpose() * Eigen::Vector3d(std::cos(angle), std::sin(angle), 0.0);
      Placed placed = best.placed;
      placed.shape = Shape::torus;
      placed.offset += radius * to;
      placed.second_size = best.placed.size;
      placed.size = radius;
      placed.axes = axes_about(to.cross(Eigen::Vector3d(best.placed.axes.row(2))));
      candidates.push_back({placed, sum_of_squares(placed, cloud)});
    }
  }
}

bool by_principal_axes(Shape shape) {
  return shape == Shape::plane || shape == Shape::line_2d || shape == Shape::line_3d ||
         shape == Shape::circle_2d || shape == Shape::sphere;
}

Eigen::Matrix3d principal_axes(Shape shape, const PointCloud& cloud) {
  if (shape == Shape::circle_2d) return Eigen::Matrix3d::Identity();
  if (shape == Shape::line_2d) {  // normal, the plane's normal, direction
    Eigen::Matrix3d axes;
    axes.row(2) = cloud.principal.row(0);
    axes.row(1) = Eigen::Vector3d::UnitZ();
    axes.row(0) = axes.row(1).cross(axes.row(2));
    return axes;
  }
  return axes_about(cloud.principal.row(shape == Shape::line_3d ? 0 : 2));
}

/// `count` directions of a half sphere, spread evenly (Fibonacci).
std::vector<Eigen::Vector3d> half_sphere(std::size_t count) {
  std::vector<Eigen::Vector3d> out;
  const double turn = std::numbers::pi * (3.0 - std::sqrt(5.0));
  for (std::size_t i = 0; i < count; ++i) {
    const double z = (static_cast<double>(i) + 0.5) / static_cast<double>(count);
    const double r = std::sqrt(1.0 - z * z), angle = turn * static_cast<double>(i);
    out.emplace_back(r * std::cos(angle), r * std::sin(angle), z);
  }
  return out;
}

/// Where to begin, the most promising first. It uses principal axes if they are the answer.
/// Otherwise it uses the algebraic equation of the element, which is linear once the direction of
/// its axis is given, over directions spread evenly (Eq. 247).
std::vector<Placed> starts_of(Shape shape, const PointCloud& cloud, std::size_t most) {
  if (by_principal_axes(shape)) return {start_along(shape, cloud, principal_axes(shape, cloud))};
  std::vector<Eigen::Vector3d> directions = half_sphere(cloud.points.size() < 50 ? 600 : 200);
  for (Eigen::Index i = 0; i < 3; ++i) directions.emplace_back(cloud.principal.row(i));
  std::vector<Candidate> candidates;
  for (const Eigen::Vector3d& direction : directions) {
    const Placed placed = start_along(shape, cloud, axes_about(direction));
    const double cost = sum_of_squares(placed, cloud);
    if (std::isfinite(cost)) candidates.push_back({placed, cost});
  }
  if (shape == Shape::torus) add_bent_cylinders(cloud, directions, candidates);
  std::ranges::stable_sort(candidates, {}, &Candidate::cost);
  std::vector<Placed> starts;
  constexpr double near = 0.99;  // 8°: what is nearer goes the same way
  for (const Candidate& candidate : candidates) {
    if (starts.size() >= most) break;
    const bool known = std::ranges::any_of(starts, [&](const Placed& other) {
      return std::abs(other.axes.row(2).dot(candidate.placed.axes.row(2))) > near;
    });
    if (!known) starts.push_back(candidate.placed);
  }
  return starts;
}

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

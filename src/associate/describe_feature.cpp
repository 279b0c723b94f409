// SPDX-License-Identifier: Apache-2.0
#include "associate/describe_feature.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <vector>

#include "associate/distance_kernel.hpp"
#include "math/linear_algebra.hpp"

namespace trueaxis {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

}  // namespace

Feature feature_of(const Placed& placed) {
  Feature out;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    out.point_mm[i] = placed.base[i] + placed.offset[k];
    out.direction[i] = placed.shape == Shape::sphere ? nan : placed.axes(2, k) + 0.0;  // no −0
  }
  switch (placed.shape) {
    case Shape::circle_2d:
    case Shape::circle_3d:
    case Shape::sphere:
    case Shape::cylinder:
      out.radius_mm = placed.size;
      break;
    case Shape::cone:
      out.radius_mm = placed.size / std::cos(placed.second_size);
      out.half_angle_rad = std::abs(placed.second_size);
      break;
    case Shape::torus:
      out.radius_mm = placed.size;
      out.minor_radius_mm = placed.second_size;
      break;
    default:
      break;
  }
  return out;
}

ParameterMatrix covariance_of(const LeastSquares& fit, const PointCloud& cloud) {
  const ShapeTraits& traits = traits_of(fit.placed.shape);
  const auto freedom = static_cast<double>(traits.residuals * cloud.points.size()) -
                       static_cast<double>(traits.parameters);
  const Parameters per = step_lengths(fit.placed.shape, cloud).cwiseInverse();
  const ParameterMatrix h = per.asDiagonal() * fit.normal.jtj * per.asDiagonal();
  const double variance = freedom > 0.0 ? fit.normal.sum_of_squares / freedom : nan;
  return variance * (per.asDiagonal() * linear::inverse(h) * per.asDiagonal());
}

Feature uncertainty_of(const Placed& placed, const PointCloud& cloud,
                       const ParameterMatrix& covariance) {
  const ShapeTraits& traits = traits_of(placed.shape);
  const auto p = static_cast<Eigen::Index>(traits.parameters);
  // Rows: shifts 1-3, tilts 1-2, size, second size.
  Eigen::MatrixXd to = Eigen::MatrixXd::Zero(7, p);
  for (Eigen::Index k = 0; k < p; ++k)
    to(static_cast<Eigen::Index>(traits.motions[static_cast<std::size_t>(k)]), k) = 1.0;
  const Eigen::Vector3d away = placed.axes * (cloud.centroid - placed.offset);
  const bool on_axis = placed.shape == Shape::line_2d || placed.shape == Shape::line_3d ||
                       placed.shape == Shape::cylinder || placed.shape == Shape::cone;
  if (on_axis)  // what is nearest to the centroid goes along the axis when it tilts
    to.row(2) += away[0] * to.row(3) + away[1] * to.row(4);
  if (placed.shape == Shape::cone) {
    const double c = std::cos(placed.second_size), t = std::tan(placed.second_size);
    to.row(5) = to.row(5) / c + t * to.row(2) + placed.size / c * t * to.row(6);
  }
  Eigen::MatrixXd world = Eigen::MatrixXd::Zero(8, p);
  world.topRows<3>() = placed.axes.transpose() * to.topRows<3>();
  world.middleRows<3>(3) = placed.axes.topRows<2>().transpose() * to.middleRows<2>(3);
  world.bottomRows<2>() = to.bottomRows<2>();
  const Eigen::VectorXd u =
      (world * covariance * world.transpose()).diagonal().cwiseMax(0.0).cwiseSqrt();
  const bool known = covariance.allFinite();
  const auto at = [&](Eigen::Index i) { return known ? u[i] : nan; };
  Feature out{{at(0), at(1), at(2)}, {at(3), at(4), at(5)}};
  const Feature has = feature_of(placed);
  if (placed.shape == Shape::sphere) out.direction = has.direction;
  if (std::isfinite(has.radius_mm)) out.radius_mm = at(6);
  if (std::isfinite(has.half_angle_rad)) out.half_angle_rad = at(7);
  if (std::isfinite(has.minor_radius_mm)) out.minor_radius_mm = at(7);
  return out;
}

DistanceRange range_of(const Placed& placed, const PointCloud& cloud) {
  std::vector<DistanceRange> parts(chunks_of(cloud.points.size()));
  for_each_chunk(cloud, [&](std::span<const Point3> chunk, std::size_t k) {
    DistanceRange part{1e300, -1e300, 0.0};
    double d[block_size];
    for (std::size_t at = 0; at < chunk.size(); at += block_size) {
      const std::size_t count = std::min(block_size, chunk.size() - at);
      evaluate_only_distances(placed, chunk.subspan(at, count), d);
      for (std::size_t i = 0; i < count; ++i) {
        part.least = std::min(part.least, d[i]);
        part.largest = std::max(part.largest, d[i]);
        part.sum_of_squares += d[i] * d[i];
      }
    }
    parts[k] = part;
  });
  DistanceRange all = parts.front();
  for (std::size_t k = 1; k < parts.size(); ++k) {
    all.least = std::min(all.least, parts[k].least);
    all.largest = std::max(all.largest, parts[k].largest);
    all.sum_of_squares += parts[k].sum_of_squares;
  }
  return all;
}

}  // namespace trueaxis

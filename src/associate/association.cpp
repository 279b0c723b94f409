// SPDX-License-Identifier: Apache-2.0
#include "trueaxis/association.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "associate/distance_kernel.hpp"
#include "associate/extreme_element.hpp"
#include "associate/least_squares.hpp"
#include "math/linear_algebra.hpp"
#include "math/statistics.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis {
namespace {

/// Least and largest distance and the sum of squares over all points.
struct DistanceRange {
  double least = 0.0, largest = 0.0, sum_of_squares = 0.0;
};

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// `placed`, its origin nearest to the centroid, in the terms of the result.
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

constexpr double coverage_factor = 2.0;  // of the U that u is widened for

/// Covariance of the motions from the residuals: σ² (JᵀJ)⁻¹, σ² of the distances (Eq. 248), so that
/// 2 u is what Student's t says where they are few.
ParameterMatrix covariance_of(const LeastSquares& fit, const PointCloud& cloud) {
  const ShapeTraits& traits = traits_of(fit.placed.shape);
  const auto freedom = static_cast<double>(traits.residuals * cloud.points.size()) -
                       static_cast<double>(traits.parameters);
  const Parameters per = step_lengths(fit.placed.shape, cloud).cwiseInverse();
  const ParameterMatrix h = per.asDiagonal() * fit.normal.jtj * per.asDiagonal();
  const double variance = freedom > 0.0
                              ? fit.normal.sum_of_squares / freedom *
                                    std::pow(student_widening(freedom, coverage_factor), 2)
                              : nan;
  return variance * (per.asDiagonal() * linear::inverse(h) * per.asDiagonal());
}

/// Standard uncertainty of each number of it from the covariance of the motions (GUM 5.2).
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

Shape shape_of(Element element, bool in_plane) {
  using enum Shape;
  if (in_plane && element == Element::line) return line_2d;
  if (in_plane && element == Element::circle) return circle_2d;
  constexpr Shape in_space[] = {line_3d, circle_3d, plane, sphere, cylinder, cone, torus};
  return in_space[static_cast<std::size_t>(element)];
}

/// Least number of points: a line or circle in space has two distances a point.
std::size_t least_points(Element element) {
  constexpr std::size_t least[] = {2, 3, 3, 4, 5, 6, 7};
  return least[static_cast<std::size_t>(element)];
}

/// The frame turned over where the result's direction is the other way: a cone's is to where it
/// grows, of any other the component largest in size is positive. @returns whether it was
bool orient(Placed& placed) {
  Eigen::Index largest = 0;
  placed.axes.row(2).cwiseAbs().maxCoeff(&largest);
  const bool over =
      placed.shape == Shape::cone ? placed.second_size < 0.0 : placed.axes(2, largest) < 0.0;
  if (!over) return false;
  placed.axes.row(0) *= -1.0;
  placed.axes.row(2) *= -1.0;
  if (placed.shape == Shape::cone) placed.second_size = -placed.second_size;
  return true;
}

Placed oriented(Placed placed) {
  orient(placed);
  return placed;
}

void describe(AssociatedFeature& out, const Placed& placed, const PointCloud& cloud) {
  const DistanceRange range = range_of(placed, cloud);
  const bool tube = placed.shape == Shape::line_3d || placed.shape == Shape::circle_3d;
  out.feature = feature_of(placed);
  out.rms_mm = std::sqrt(range.sum_of_squares / static_cast<double>(cloud.points.size()));
  out.zone_mm = tube ? 2.0 * range.largest : range.largest - range.least;
}

void fail(AssociatedFeature& out, AssociationStatus status, std::string why) {
  out.status = status;
  out.why = std::move(why);
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  out.feature = out.u = {{nan, nan, nan}, {nan, nan, nan}};
  out.rms_mm = out.zone_mm = nan;
}

void describe_gaussian(AssociatedFeature& out, const GaussianElement& gaussian,
                       const PointCloud& cloud) {
  LeastSquares fit = gaussian.fit;
  if (orient(fit.placed)) fit.normal = accumulate(fit.placed, cloud);
  describe(out, fit.placed, cloud);
  out.iterations = fit.iterations;
  const ShapeTraits& traits = traits_of(fit.placed.shape);
  out.u = uncertainty_of(fit.placed, cloud, covariance_of(fit, cloud));
  if (traits.residuals * cloud.points.size() == traits.parameters)
    out.why_no_u = "there are as many distances as parameters, so they do not show the noise";
  const auto n = static_cast<double>(cloud.points.size());
  const Parameters per = step_lengths(fit.placed.shape, cloud).cwiseInverse();
  const Parameters gradient = per.cwiseProduct(fit.normal.jtd) / n;
  out.certificate.stationarity = gradient.norm();
  const ParameterMatrix h = per.asDiagonal() * fit.normal.jtj * per.asDiagonal() / n;
  out.certificate.gap_mm = std::sqrt(std::max(0.0, linear::weighed_square(gradient, h)));
  out.certificate.starts = gaussian.starts;
  const Shape shape = fit.placed.shape;
  out.certificate.global =
      shape == Shape::line_2d || shape == Shape::line_3d || shape == Shape::plane;
  if (!fit.converged) fail(out, AssociationStatus::max_iterations, "The search did not converge");
}

void describe_extreme(AssociatedFeature& out, const ExtremeElement& extreme,
                      const PointCloud& cloud) {
  Placed placed = extreme.best.placed;
  if (sides_of(placed.shape, out.criterion).size_follows) {
    double& size = placed.shape == Shape::torus ? placed.second_size : placed.size;
    const double by =
        out.criterion == Criterion::minimum_circumscribed ? extreme.best.h : -extreme.best.h;
    size += by;
  }
  const bool flat = placed.shape == Shape::plane || placed.shape == Shape::line_2d;
  const int turned = orient(placed) && flat ? -1 : 1;
  describe(out, placed, cloud);
  out.iterations = extreme.best.iterations;
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  out.u = {{nan, nan, nan}, {nan, nan, nan}};
  out.why_no_u = "an element through few points does not show their noise: repeat the measurement";
  out.certificate = {.contacts = {},
                     .stationarity = extreme.best.stationarity,
                     .gap_mm = extreme.best.gap,
                     .global = extreme.global,
                     .starts = extreme.starts};
  for (const Minimax::Contact& contact : extreme.best.contacts) {
    double distance = 0.0;
    evaluate_only_distances(placed, cloud.points.subspan(contact.point, 1), &distance);
    out.certificate.contacts.push_back(
        {contact.point, turned * contact.sign, distance, contact.multiplier});
  }
  if (!extreme.best.converged)
    fail(out, AssociationStatus::max_iterations, "The search did not converge");
}

}  // namespace

std::string association_objection(Element element, Criterion criterion) {
  if (criterion != Criterion::minimum_circumscribed && criterion != Criterion::maximum_inscribed)
    return {};
  const std::string name = element_names[static_cast<std::size_t>(element)];
  if (element == Element::line || element == Element::plane)
    return "A " + name + " does not have a least or largest size: use minimum_zone";
  if (element == Element::cone)
    return "A cone has two sizes, so a least or largest cone is not defined: use minimum_zone";
  return {};
}

AssociatedFeature associate(std::span<const Point3> points_mm, Element element, Criterion criterion,
                            const AssociateOptions& options) {
  expects(association_objection(element, criterion).empty(), "the criterion applies");
  AssociatedFeature out{.element = element, .criterion = criterion, .points = points_mm.size()};
  if (points_mm.size() < least_points(element)) {
    fail(out, AssociationStatus::too_few,
         "A " + std::string(element_names[static_cast<std::size_t>(element)]) + " needs " +
             std::to_string(least_points(element)) + " points or more, there are " +
             std::to_string(points_mm.size()));
    return out;
  }
  const PointCloud cloud = cloud_of(points_mm, options.threads);
  expects(std::isfinite(cloud.length), "coordinates are finite numbers");
  out.in_plane = cloud.in_plane && (element == Element::line || element == Element::circle);
  const Shape shape = shape_of(element, out.in_plane);
  if (std::string why = degenerate_points(shape, cloud); !why.empty()) {
    fail(out, AssociationStatus::degenerate, std::move(why));
    return out;
  }
  const GaussianElement gaussian = gaussian_element(shape, cloud, options.max_iterations);
  if (!gaussian.why.empty()) {
    fail(out, AssociationStatus::not_determined, gaussian.why);
    return out;
  }
  if (criterion == Criterion::gaussian) {
    describe_gaussian(out, gaussian, cloud);
    return out;
  }
  Placed start = gaussian.fit.placed;
  // The size of a circle in space is that of its points seen along its axis.
  if (shape == Shape::circle_3d && criterion != Criterion::minimum_zone)
    start.shape = Shape::circle_2d;
  if (criterion == Criterion::constrained && shape == Shape::line_3d) {
    fail(out, AssociationStatus::not_determined,
         "A line in space does not have a side of the material");
    return out;
  }
  const ExtremeElement extreme =
      criterion == Criterion::constrained
          ? constrained_element(oriented(start), cloud, options.material == Material::inside,
                                options.max_iterations)
          : extreme_element(start, cloud, criterion, options.max_iterations);
  if (!extreme.why.empty())
    fail(out, AssociationStatus::not_determined, extreme.why);
  else
    describe_extreme(out, extreme, cloud);
  return out;
}

}  // namespace trueaxis

// SPDX-License-Identifier: Apache-2.0
#include "associate/least_squares.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "associate/distance_kernel.hpp"
#include "math/gram.hpp"
#include "math/linear_algebra.hpp"

namespace trueaxis {
namespace {

using GramSums = std::array<double, gram_size(most_parameters + 1)>;

GramSums gram_of(const Placed& placed, std::span<const Point3> points) {
  const ShapeTraits& traits = traits_of(placed.shape);
  const std::size_t columns = traits.parameters + 1;
  DistanceBlock blocks[2];
  LaneSums sums;
  for (std::size_t at = 0; at < points.size(); at += block_size) {
    evaluate_components(placed, points.subspan(at, std::min(block_size, points.size() - at)),
                        blocks);
    for (std::size_t part = 0; part < traits.residuals; ++part) {
      const double* column[most_parameters + 1];
      for (std::size_t k = 0; k < columns; ++k) column[k] = blocks[part].column[k];
      add_products(column, columns, sums);
    }
  }
  GramSums out{};
  for (std::size_t i = 0; i < gram_size(columns); ++i) out[i] = sums.sum(i);
  return out;
}

}  // namespace

NormalSums accumulate(const Placed& placed, const PointCloud& cloud) {
  std::vector<GramSums> parts(chunks_of(cloud.points.size()));
  for_each_chunk(cloud, [&](std::span<const Point3> chunk, std::size_t i) {
    parts[i] = gram_of(placed, chunk);
  });
  GramSums all{};
  for (const GramSums& part : parts)
    for (std::size_t i = 0; i < all.size(); ++i) all[i] += part[i];
  const std::size_t p = traits_of(placed.shape).parameters;
  NormalSums out;
  out.jtj.resize(static_cast<Eigen::Index>(p), static_cast<Eigen::Index>(p));
  out.jtd.resize(static_cast<Eigen::Index>(p));
  for (std::size_t i = 0; i < p; ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    for (std::size_t j = 0; j <= i; ++j) {
      const auto column = static_cast<Eigen::Index>(j);
      out.jtj(row, column) = out.jtj(column, row) = all[gram_index(i, j)];
    }
    out.jtd[row] = all[gram_index(p, i)];
  }
  out.sum_of_squares = all[gram_index(p, p)];
  return out;
}

Parameters step_lengths(Shape shape, const PointCloud& cloud) {
  const ShapeTraits& traits = traits_of(shape);
  Parameters out(static_cast<Eigen::Index>(traits.parameters));
  for (std::size_t k = 0; k < traits.parameters; ++k) {
    const Motion motion = traits.motions[k];
    const bool angle = motion == Motion::tilt_1 || motion == Motion::tilt_2 ||
                       (motion == Motion::second_size && shape == Shape::cone);
    out[static_cast<Eigen::Index>(k)] = angle ? cloud.length : 1.0;
  }
  return out;
}

LeastSquares least_squares(const Placed& start, const PointCloud& cloud, int max_iterations) {
  const Parameters lengths = step_lengths(start.shape, cloud), per = lengths.cwiseInverse();
  const auto n = static_cast<double>(cloud.points.size());
  LeastSquares at{start, accumulate(start, cloud)};
  double damping = 0.0, last = std::numeric_limits<double>::infinity();
  for (; at.iterations < max_iterations; ++at.iterations) {
    const ParameterMatrix h = per.asDiagonal() * at.normal.jtj * per.asDiagonal() / n;
    ParameterMatrix damped = h;
    // The floor keeps a motion that the points do not show from running away.
    damped.diagonal().array() += damping * h.diagonal().array() + 1e-16 * h.trace();
    const Parameters step =
        linear::solve_normal(damped, Eigen::VectorXd(-(per.asDiagonal() * at.normal.jtd / n)));
    const double moves = step.norm();
    if (!std::isfinite(moves)) return at;
    const Placed place = recentred(moved(at.placed, per.cwiseProduct(step)), cloud.centroid);
    NormalSums normal = accumulate(place, cloud);
    const bool better = normal.sum_of_squares <= at.normal.sum_of_squares;
    // Near the minimum the sum drowns in its rounding; there steps that get shorter are good ones.
    const bool near = damping == 0.0 && moves < 1e-6 * cloud.length && moves < 0.98 * last;
    if (!better && !near) {
      if (moves < 1e-8 * cloud.length) {  // no more digits
        at.converged = true;
        return at;
      }
      damping = std::max(10.0 * damping, 1e-4);
      if (damping > 1e12) return at;
      continue;
    }
    damping = damping > 1e-6 ? 0.1 * damping : 0.0;
    at.placed = place;
    at.normal = std::move(normal);
    const double rate = std::isfinite(last) ? std::min(0.999, moves / last) : 0.999;
    last = moves;
    // All the steps that are still to come, as a geometric series; or no more than rounding.
    const bool short_way = moves * rate / (1.0 - rate) <= 1e-13 * cloud.length;
    if (damping == 0.0 && (short_way || moves <= 1e-14 * cloud.length)) {
      at.converged = true;
      return at;
    }
  }
  return at;
}

}  // namespace trueaxis

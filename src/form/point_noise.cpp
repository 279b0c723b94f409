// SPDX-License-Identifier: Apache-2.0
#include "form/point_noise.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <queue>
#include <utility>
#include <vector>

#include "math/linear_algebra.hpp"
#include "math/statistics.hpp"

namespace trueaxis::form {
namespace {

constexpr double as_far = 1.0 + 1e-9;  // the rounding of a grid

/// Points in the order of their first coordinate.
class Cloud {
 public:
  explicit Cloud(std::span<const std::array<double, 2>> at_mm)
      : at_mm_(at_mm), order_(at_mm.size()) {
    std::iota(order_.begin(), order_.end(), std::size_t{0});
    std::ranges::sort(order_, {}, [&](std::size_t i) { return at_mm_[i][0]; });
  }
  std::size_t point(std::size_t k) const { return order_[k]; }

  /// The `count` points that are nearest to the one at place k of the order, and all others as near
  /// as the last of them.
  std::vector<std::size_t> around(std::size_t k, std::size_t count) const {
    const std::array<double, 2>& here = at_mm_[order_[k]];
    std::vector<std::pair<double, std::size_t>> found;
    std::priority_queue<double> nearest;  // the largest first
    const auto limit = [&] {
      return nearest.size() < count ? std::numeric_limits<double>::infinity()
                                    : as_far * nearest.top();
    };
    std::size_t below = k, above = k + 1;
    while (below > 0 || above < order_.size()) {
      const double down = below > 0 ? here[0] - at_mm_[order_[below - 1]][0]
                                    : std::numeric_limits<double>::infinity();
      const double up = above < order_.size() ? at_mm_[order_[above]][0] - here[0]
                                              : std::numeric_limits<double>::infinity();
      const double step = std::min(down, up);
      if (step * step > limit()) break;
      const std::size_t next = order_[down <= up ? --below : above++];
      const double across = at_mm_[next][1] - here[1], far = step * step + across * across;
      if (far > limit()) continue;
      found.emplace_back(far, next);
      nearest.push(far);
      if (nearest.size() > count) nearest.pop();
    }
    std::vector<std::size_t> out;
    for (const auto& [far, i] : found)
      if (far <= limit()) out.push_back(i);
    return out;
  }

 private:
  std::span<const std::array<double, 2>> at_mm_;
  std::vector<std::size_t> order_;
};

/// Weights by which neighbours give the height here: the constant of a surface of `terms` terms.
Eigen::VectorXd weights(const std::array<double, 2>& here,
                        std::span<const std::array<double, 2>> at_mm,
                        const std::vector<std::size_t>& neighbours, Eigen::Index terms,
                        bool plane) {
  double scale = 0.0;
  for (const std::size_t i : neighbours)
    scale = std::max(scale, std::hypot(at_mm[i][0] - here[0], at_mm[i][1] - here[1]));
  if (!(scale > 0.0)) scale = 1.0;
  Eigen::MatrixXd columns(static_cast<Eigen::Index>(neighbours.size()), terms);
  Eigen::Index row = 0;
  for (const std::size_t i : neighbours) {
    const double u = (at_mm[i][0] - here[0]) / scale, v = (at_mm[i][1] - here[1]) / scale;
    const std::array<double, 6> of_plane{1.0, u, v, u * u, u * v, v * v}, of_line{1.0, u, u * u};
    const std::array<double, 6>& all = plane ? of_plane : of_line;
    for (Eigen::Index j = 0; j < terms; ++j) columns(row, j) = all[static_cast<std::size_t>(j)];
    ++row;
  }
  return linear::pseudo_inverse(columns).row(0).transpose();
}

/// Root mean square of what lies within three robust σ, as of a normal one cut off there: twice as
/// sharp as a median.
double without_scratches(std::span<const double> off_mm) {
  constexpr double cut = 3.0, left_of_variance = 0.97330;
  const double limit_mm = cut * mad_sigma(off_mm);
  double sum = 0.0, count = 0.0;
  for (const double one : off_mm)
    if (std::abs(one) <= limit_mm) sum += one * one, count += 1.0;
  return count > 0.0 ? std::sqrt(sum / (left_of_variance * count)) : 0.0;
}

}  // namespace

double noise_of_points_mm(std::span<const std::array<double, 2>> at_mm, bool plane,
                          std::span<const double> height_mm) {
  const std::size_t linear_terms = plane ? 3 : 2, square_terms = plane ? 6 : 3;
  if (at_mm.size() <= linear_terms) return 0.0;
  const std::size_t others = at_mm.size() - 1;
  const std::size_t terms = others > square_terms ? square_terms : linear_terms;
  const Cloud cloud(at_mm);
  std::vector<double> off;
  for (std::size_t k = 0; k < at_mm.size(); ++k) {
    const std::size_t point = cloud.point(k);
    const auto neighbours = cloud.around(k, std::min(2 * terms, others));
    const Eigen::VectorXd w =
        weights(at_mm[point], at_mm, neighbours, static_cast<Eigen::Index>(terms), plane);
    if (std::abs(w.sum() - 1.0) > 1e-6) continue;  // they do not surround it
    double left = height_mm[point];
    for (std::size_t i = 0; i < neighbours.size(); ++i)
      left -= w[static_cast<Eigen::Index>(i)] * height_mm[neighbours[i]];
    off.push_back(left / std::sqrt(1.0 + w.squaredNorm()));
  }
  return without_scratches(off);
}

}  // namespace trueaxis::form

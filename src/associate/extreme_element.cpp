// SPDX-License-Identifier: Apache-2.0
#include "associate/extreme_element.hpp"

#include <algorithm>

#include "associate/distance_kernel.hpp"
#include "associate/least_squares.hpp"
#include "base/threads.hpp"

namespace trueaxis {
namespace {

constexpr std::size_t solved_whole = 400;  ///< so many points are all solved for
constexpr std::size_t spread_out = 256;    ///< of more, so many from everywhere: they enclose it
constexpr std::size_t stretches = 512;     ///< of many points each offers its furthest

}  // namespace

Furthest furthest(const Placed& placed, const PointCloud& cloud, const Sides& sides) {
  const std::size_t n = cloud.points.size();
  const std::size_t blocks = (n + block_size - 1) / block_size;
  const std::size_t each = std::max<std::size_t>(1, (blocks + stretches - 1) / stretches);
  const std::size_t count = (blocks + each - 1) / each;
  Furthest out{std::vector<Furthest::One>(count), std::vector<Furthest::One>(count)};
  for_each_index(count, n < 40000 ? 1 : cloud.threads, [&](std::size_t k) {
    double d[block_size];
    const std::size_t end = std::min(n, (k + 1) * each * block_size);
    for (std::size_t at = k * each * block_size; at < end; at += block_size) {
      const std::size_t some = std::min(block_size, end - at);
      evaluate_only_distances(placed, cloud.points.subspan(at, some), d);
      double high = d[0], low = d[0];
      for (std::size_t i = 1; i < some; ++i) high = std::max(high, d[i]), low = std::min(low, d[i]);
      const auto offer = [&](Furthest::One& to, double value, double of) {
        if (value <= to.value) return;
        to = {at + static_cast<std::size_t>(std::find(d, d + some, of) - d), value};
      };
      offer(out.outer[k], high, high);
      offer(out.inner[k], -low, low);
    }
  });
  for (std::size_t k = 0; k < count; ++k) {
    if (sides.outer) out.top = std::max(out.top, out.outer[k].value);
    if (sides.inner) out.top = std::max(out.top, out.inner[k].value);
  }
  return out;
}

ChosenPoints::ChosenPoints(const PointCloud& cloud) : cloud_(cloud) {
  const std::size_t n = cloud.points.size();
  const std::size_t some = n > solved_whole ? spread_out : n;
  for (std::size_t i = 0; i < some; ++i) indices_.push_back(n > some ? spread_index(i, n) : i);
  std::ranges::sort(indices_);
  gather();
}

bool ChosenPoints::add(const Furthest& from, const Sides& sides, double h) {
  const std::size_t before = indices_.size();
  const auto take = [&](const std::vector<Furthest::One>& all) {
    for (const Furthest::One& one : all)
      if (one.value > h) indices_.push_back(one.point);
  };
  if (sides.outer) take(from.outer);
  if (sides.inner) take(from.inner);
  std::ranges::sort(indices_);
  indices_.erase(std::unique(indices_.begin(), indices_.end()), indices_.end());
  gather();
  return indices_.size() > before;
}

void ChosenPoints::gather() {
  points_.clear();
  for (const std::size_t i : indices_) points_.push_back(cloud_.points[i]);
}

namespace {

bool convex(Shape shape, Criterion criterion) {
  return criterion == Criterion::minimum_circumscribed &&
         (shape == Shape::circle_2d || shape == Shape::sphere);
}

/// Places about the Gaussian element, as far from it as the points are: each motion to both sides,
/// and two at a time.
std::vector<Placed> places_about(const Placed& gaussian, const PointCloud& cloud,
                                 const Sides& sides, double far) {
  const Parameters per = step_lengths(gaussian.shape, cloud).cwiseInverse();
  const auto motions = static_cast<Eigen::Index>(free_motions(gaussian.shape, sides));
  std::vector<Placed> out;
  const auto add = [&](const Parameters& step) { out.push_back(moved(gaussian, step)); };
  for (Eigen::Index i = 0; i < motions; ++i) {
    for (const double a : {far, -far}) {
      Parameters step = Parameters::Zero(per.size());
      step[i] = a * per[i];
      add(step);
      if (i + 1 == motions) continue;
      step[i + 1] = a * per[i + 1];
      add(step);
      step[i + 1] = -step[i + 1];
      add(step);
    }
  }
  return out;
}

/// What a maximum inscribed element is largest in. One that points enclose has one of them at its
/// far side or beyond, seen from the Gaussian element, and none is further off than the furthest:
/// one that is larger by more has slipped out between the points.
double size_of(const Placed& placed) {
  return placed.shape == Shape::torus ? placed.second_size : placed.size;
}

/// Extremes over all points, from `start` and the points chosen so far.
Minimax over_all(const Placed& start, const PointCloud& cloud, const Sides& sides,
                 ChosenPoints& chosen, int max_iterations) {
  Minimax best{.placed = start};
  constexpr int most_rounds = 100;
  int iterations = 0;
  const double rounding = 1e-15 * cloud.length + 0.25 * cloud.rounding;
  for (int round = 0; round < most_rounds; ++round) {
    best = minimax(best.placed, chosen.cloud(), sides, max_iterations);
    iterations += best.iterations;
    best.iterations = iterations;
    if (chosen.all()) return best;
    const Furthest beyond = furthest(best.placed, cloud, sides);
    if (beyond.top <= best.h + rounding || !chosen.add(beyond, sides, best.h)) return best;
  }
  best.converged = false;
  return best;
}

}  // namespace

ExtremeElement extreme_element(const Placed& gaussian, const PointCloud& cloud, Criterion criterion,
                               int max_iterations) {
  const Sides sides = sides_of(gaussian.shape, criterion);
  ExtremeElement out;
  ChosenPoints chosen(cloud);
  const Furthest first = furthest(gaussian, cloud, sides);
  if (!chosen.all()) chosen.add(first, sides, -1e300);
  out.best = over_all(gaussian, cloud, sides, chosen, max_iterations);
  out.global = convex(gaussian.shape, criterion);
  if (out.global && !out.best.converged) {  // of a short arc it is far from the Gaussian element
    Placed middle = gaussian;
    middle.offset = cloud.centroid, middle.size = cloud.length;
    ++out.starts;
    out.best = over_all(middle, cloud, sides, chosen, max_iterations);
  }
  Sides both = sides;
  both.outer = both.inner = true;
  const double far = furthest(gaussian, chosen.cloud(), both).top;
  const double widest = size_of(gaussian) + far + 1e-9 * cloud.length;
  const auto slipped = [&](const Minimax& one) {
    return criterion == Criterion::maximum_inscribed && size_of(one.placed) - one.h > widest;
  };
  if (!out.global && !out.best.runs_away) {
    for (const Placed& start : places_about(gaussian, chosen.cloud(), sides, far)) {
      ++out.starts;
      const auto better = [&](const Minimax& one, double by) {
        return one.converged && !slipped(one) && (slipped(out.best) || one.h < out.best.h - by);
      };
      const Minimax other = minimax(start, chosen.cloud(), sides, max_iterations);
      if (!better(other, 1e-12 * cloud.length)) continue;
      const Minimax whole = over_all(other.placed, cloud, sides, chosen, max_iterations);
      if (better(whole, 0.0) || (whole.converged && !slipped(whole) && !out.best.converged))
        out.best = whole;
    }
  }
  out.best.runs_away = out.best.runs_away || slipped(out.best);
  for (Minimax::Contact& contact : out.best.contacts) contact.point = chosen.index(contact.point);
  if (out.best.runs_away) out.why = "The points do not enclose the element: it grows without bound";
  return out;
}

}  // namespace trueaxis

// SPDX-License-Identifier: Apache-2.0
#include "associate/extreme_element.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "associate/chosen_points.hpp"
#include "associate/least_squares.hpp"

namespace trueaxis {
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
  if (!out.global && !out.best.runs_away) {
    Sides both = sides;
    both.outer = both.inner = true;
    const double far = furthest(gaussian, chosen.cloud(), both).top;
    for (const Placed& start : places_about(gaussian, chosen.cloud(), sides, far)) {
      ++out.starts;
      const Minimax other = minimax(start, chosen.cloud(), sides, max_iterations);
      if (!other.converged || other.h >= out.best.h - 1e-12 * cloud.length) continue;
      const Minimax whole = over_all(other.placed, cloud, sides, chosen, max_iterations);
      if (whole.converged && (whole.h < out.best.h || !out.best.converged)) out.best = whole;
    }
  }
  for (Minimax::Contact& contact : out.best.contacts) contact.point = chosen.index(contact.point);
  if (out.best.runs_away) out.why = "The points do not enclose the element: it grows without bound";
  return out;
}

}  // namespace trueaxis

// SPDX-License-Identifier: Apache-2.0
#include "diagnose/search/judge.hpp"

#include <algorithm>
#include <cmath>

#include "diagnose/regression/size_prior.hpp"
#include "math/linear_algebra.hpp"

namespace trueaxis::diagnose_detail {
namespace {

// Odds that sizes alone give between lobes and a sensor that bends: with four to one the average of
// both axes has either within two standard deviations.
constexpr double most_odds = 4.0;

/// Whether the readings after a step tell all of its form. Where they are of one section, a shift
/// and a tilt do the same to them, and a fit of both runs away.
bool tells_whole_form(const Hypothesis& h, const Projection& beside, const Columns& own) {
  if (!h.effect || !is_step(h.effect->term)) return true;
  const Eigen::VectorXd right = beside.gram(own, {0});
  return size_prior(h).allows(linear::least_squares(beside.gram(own, own), right));
}

}  // namespace

double choice_of(const Hypothesis& hypothesis) {
  return 2.0 * std::log(std::max(hypothesis.tests, 1.0));
}

double criterion_as(const Hypothesis& rival, const Columns& its, const Hypothesis& named,
                    const Columns& own, const Projection& beside, std::size_t count) {
  const auto seen2 = [&](std::size_t column) {
    const auto j = static_cast<Eigen::Index>(column);
    return std::max(beside.gram(j, j), 0.0);
  };
  infer::SizePrior sizes = size_prior(rival);
  const double rms = sizes.median(0) * std::sqrt(seen2(its.front()));
  sizes.median.resize(static_cast<Eigen::Index>(own.size()));
  for (std::size_t j = 0; j < own.size(); ++j)
    sizes.median(static_cast<Eigen::Index>(j)) =
        seen2(own[j]) > 0.0 ? rms / std::sqrt(seen2(own[j])) : 0.0;
  sizes.least.resize(0), sizes.most.resize(0);
  return infer::weigh(sizes, beside, own, count).criterion +
         2.0 * std::log(std::max({rival.tests, named.tests, 1.0}));
}

double lobes_over_bend(const Hypothesis& lobes, const Columns& its, const Hypothesis& bend,
                       const Columns& own, const Projection& beside, std::size_t count) {
  const Weighed weighed = weigh(bend, beside, own, count);
  return criterion_as(lobes, its, bend, own, beside, count) - weighed.criterion - choice_of(bend);
}

double apart_in_phase(const Columns& lobes, const Columns& bend, const Projection& beside) {
  const Eigen::MatrixXd cross = beside.gram(lobes, bend);
  const Eigen::MatrixXd nearest =
      linear::product(linear::pseudo_inverse(beside.gram(lobes, lobes)), cross);
  const Eigen::VectorXd with_readings = beside.gram(lobes, {0});
  const Eigen::VectorXd right = linear::transposed_product(nearest, with_readings);
  const Eigen::MatrixXd inverse =
      linear::pseudo_inverse(linear::transposed_product(nearest, cross));
  return score(beside, bend).gain - right.dot(inverse * right);
}

double counted_as_bend(double over_bend, double sizes, double apart) {
  const double most = 2.0 * std::log(most_odds);
  return std::min(over_bend - sizes, apart) + std::clamp(sizes, -most, most);
}

double log_p_of(const Candidate& c) {
  return log_p_value(c.gain, static_cast<double>(c.rank), c.rss, c.freedom);
}

std::vector<Candidate> judge(const NormalEquations& equations, const Solution& taken,
                             const std::vector<Columns>& places,
                             const std::vector<Hypothesis>& list) {
  const Projection projection(equations.total(), taken);
  const auto freedom = static_cast<double>(equations.count() - projection.rank);
  std::vector<Candidate> out;
  for (std::size_t h = 0; h < list.size(); ++h) {
    const Score s = score(projection, places[h]);
    Candidate c{list[h], s.gain, s.rank, 0.0, 0.0, true, false, projection.rss, freedom};
    if (s.rank > 0) {
      const Weighed weighed = weigh(list[h], projection, places[h], equations.count());
      c.criterion = weighed.criterion + choice_of(list[h]);
      c.possible = weighed.possible && tells_whole_form(list[h], projection, places[h]);
      c.extraordinary = weighed.extraordinary;
    }
    out.push_back(std::move(c));
  }
  return out;
}

Judge::Judge(const Problem& problem, const std::vector<double>& phi,
             const std::vector<Hypothesis>& terms)
    : problem_(&problem),
      equations_(problem.point, problem.mask, problem.deviation_mm, phi, problem.threads),
      taken_(solve_with(terms)) {
  equations_.keep_columns();
}

std::vector<Candidate> Judge::operator()(const std::vector<Hypothesis>& list) {
  const auto columns = static_cast<std::size_t>(equations_.total().rows());
  const std::vector<Columns> places = equations_.append(list, 0);
  std::vector<Candidate> out = judge(equations_, taken_, places, list);
  equations_.shrink(columns);
  return out;
}

Solution Judge::solve_with(const std::vector<Hypothesis>& terms) {
  const std::vector<Columns> places = equations_.append(terms);
  return solve(equations_.total(), infer::besides(equations_.base(), places));
}

}  // namespace trueaxis::diagnose_detail

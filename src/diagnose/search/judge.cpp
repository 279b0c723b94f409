// SPDX-License-Identifier: Apache-2.0
#include "diagnose/search/judge.hpp"

#include "diagnose/regression/size_prior.hpp"

namespace trueaxis::diagnose_detail {

double log_p_of(const Candidate& c) {
  return log_p_value(c.gain, static_cast<double>(c.rank), c.rss, c.freedom);
}

void append_columns(Columns& to, const std::vector<Columns>& from) {
  for (const Columns& own : from) to.insert(to.end(), own.begin(), own.end());
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
      c.criterion = weighed.criterion + choice_of(list[h], weighed.mean);
      c.possible = weighed.possible;
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
  Columns taken = equations_.base();
  append_columns(taken, equations_.append(terms));
  return solve(equations_.total(), taken);
}

}  // namespace trueaxis::diagnose_detail

// SPDX-License-Identifier: Apache-2.0
#include "diagnose/explain/rival_axes.hpp"

namespace trueaxis::diagnose_detail {

Eigen::MatrixXd between_causes(const Problem& problem, const Joint& joint,
                               const std::vector<AmbiguousFinding>& questions) {
  const auto n = static_cast<Eigen::Index>(joint.equations.base().size());
  Eigen::MatrixXd between = Eigen::MatrixXd::Zero(n, n);
  std::vector<Hypothesis> all = joint.terms;
  for (const AmbiguousFinding& question : questions) {
    for (std::size_t r = 1; r < question.found.members.size(); ++r)
      all.push_back(question.found.members[r].hypothesis);
  }
  if (all.size() == joint.terms.size()) return between;
  // One pass over the readings for all of them.
  const Joint wide(problem, joint.equations.autoregression(), std::move(all), joint.terms.size());
  std::size_t next = joint.terms.size();
  for (const AmbiguousFinding& question : questions) {
    Columns others = wide.equations.base();
    for (std::size_t t = 0; t < joint.terms.size(); ++t) {
      if (t != question.term)
        others.insert(others.end(), wide.places[t].begin(), wide.places[t].end());
    }
    for (const Rival& rival : question.found.rivals) {
      Columns columns = others;
      columns.insert(columns.end(), wide.places[next].begin(), wide.places[next].end());
      ++next;
      const Solution instead = solve(wide.equations.total(), columns);
      const Eigen::VectorXd off = instead.coefficients.head(n) - wide.base();
      between += rival.probability * off * off.transpose();
    }
  }
  return between;
}

}  // namespace trueaxis::diagnose_detail

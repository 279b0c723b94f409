// SPDX-License-Identifier: Apache-2.0
#include "diagnose/explain/confounder_set.hpp"

#include <algorithm>
#include <cmath>

#include "diagnose/regression/joint.hpp"
#include "diagnose/regression/size_prior.hpp"
#include "diagnose/search/statistic.hpp"

namespace trueaxis::diagnose_detail {
namespace {

constexpr double told_apart = 3.2897;  // d with Φ(d/2) = 0.95
// Where the rival at distance d is the true cause, 2 ln(L_named/L_rival) is Gaussian about −d² with
// variance 4 d², and above t with probability Φ(−(t + d²)/(2 d)) ≤ Φ(−√t), the most at
// d² = t: of 7, 0.4 %.
constexpr double likelihood_tells = 7.0;
constexpr double structural = 0.999;
constexpr double unlike = 0.2;  // share of the named prediction that is left: what columns bend
constexpr double implausible = 1e-3;  // of the class: by its size, or a chance among many shapes

/// ‖(I − P_rival) μ‖² and ‖μ‖² beside base and the other terms; μ: columns × coefficients.
struct Distance {
  double left2 = 0.0, all2 = 0.0;
};
Distance distance(const NormalEquations& equations, const Columns& others, const Columns& named,
                  const Eigen::VectorXd& coefficients, const Columns& rival) {
  const auto square = [&](const Columns& taken) {
    const Projection p = project(equations.total(), taken);
    double sum = 0.0;
    for (std::size_t a = 0; a < named.size(); ++a) {
      for (std::size_t b = 0; b < named.size(); ++b)
        sum += coefficients(static_cast<Eigen::Index>(a)) *
               coefficients(static_cast<Eigen::Index>(b)) *
               p.gram(static_cast<Eigen::Index>(named[a]), static_cast<Eigen::Index>(named[b]));
    }
    return std::max(sum, 0.0);
  };
  Columns with = others;
  with.insert(with.end(), rival.begin(), rival.end());
  return {square(with), square(others)};
}

}  // namespace

ConfounderSet distinguish(const Proposer& proposer, const Model& model, std::size_t term,
                          int threads) {
  std::vector<Hypothesis> others = model.terms;
  others.erase(others.begin() + static_cast<long>(term));
  const Hypothesis& named = model.terms[term];
  std::vector<Candidate> causes = proposer.rivals(named, others, threads);
  std::erase_if(causes, [](const Candidate& c) { return c.rank == 0; });
  // The search has weighed the named one against all others jointly; its own refined form leads.
  const auto own = std::ranges::find_if(
      causes, [&](const Candidate& c) { return c.hypothesis.effect == named.effect; });
  if (own != causes.end()) std::rotate(causes.begin(), own, own + 1);

  std::vector<Hypothesis> list = others;
  list.push_back(named);
  for (const Candidate& c : causes) list.push_back(c.hypothesis);
  const Joint joint(proposer.problem(), model.phi, list, others.size() + 1);
  Columns base = joint.equations.base();
  for (std::size_t t = 0; t < others.size(); ++t)
    base.insert(base.end(), joint.places[t].begin(), joint.places[t].end());
  const Eigen::VectorXd coefficients = joint.of(others.size());
  const double variance = joint.sigma_mm * joint.sigma_mm;
  const auto freedom = static_cast<double>(joint.equations.count() - joint.solution.rank);
  const Projection beside = project(joint.equations.total(), base);
  const Score best = score(beside, joint.places[others.size()]);

  ConfounderSet out;
  for (std::size_t k = 0; k < causes.size(); ++k) {
    const Candidate& c = causes[k];
    if (c.hypothesis.effect == named.effect) {
      if (out.members.empty()) out.members.push_back(c);
      continue;
    }
    const Columns& columns = joint.places[others.size() + 1 + k];
    const Distance d =
        distance(joint.equations, base, joint.places[others.size()], coefficients, columns);
    Rival rival;
    rival.effect = c.hypothesis.id();
    rival.distance = std::sqrt(d.left2 / variance);
    rival.likelihood_ratio =
        freedom * std::log(std::max(beside.rss - c.gain, 1e-300) / (beside.rss - best.gain)) +
        2.0 * (static_cast<double>(c.rank) - static_cast<double>(best.rank));
    const auto listed = std::ranges::find_if(out.members, [&](const Candidate& m) {
      return m.hypothesis.effect == c.hypothesis.effect;
    });
    if (listed != out.members.end()) continue;  // another variant of it, which is the better one
    rival.structural = d.all2 > 0.0 && 1.0 - d.left2 / d.all2 > structural * structural;
    if (rival.distance >= told_apart && rival.likelihood_ratio >= likelihood_tells) {
      if (d.left2 < unlike * d.all2) out.dropped.push_back({c, 0.0, true});
      continue;
    }
    out.members.push_back(c);
    out.rivals.push_back(rival);
  }
  if (out.members.size() ==
      out.rivals.size()) {  // its own refined form is none, it stands as it is
    const Weighed weighed =
        weigh(named, beside, joint.places[others.size()], joint.equations.count());
    out.members.insert(out.members.begin(), {named, best.gain, best.rank, 0.0,
                                             weighed.criterion + choice_of(named, weighed.mean)});
  }
  double sum = 0.0;
  const double best_criterion = std::ranges::min(out.members, {}, &Candidate::criterion).criterion;
  const auto likelihood = [&](const Candidate& c) {
    return std::exp(-0.5 * (c.criterion - best_criterion));
  };
  for (const Candidate& c : out.members) sum += likelihood(c);
  out.probability = likelihood(out.members.front()) / sum;
  for (std::size_t r = 0; r < out.rivals.size(); ++r)
    out.rivals[r].probability = likelihood(out.members[r + 1]) / sum;
  // Most probable first, behind the named one.
  std::vector<std::size_t> order(out.rivals.size());
  for (std::size_t r = 0; r < order.size(); ++r) order[r] = r;
  std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) {
    return out.rivals[a].probability > out.rivals[b].probability;
  });
  ConfounderSet sorted{{out.members.front()}, {}, out.probability, out.dropped};
  for (const std::size_t r : order) {
    if (out.rivals[r].probability < implausible) {
      sorted.dropped.push_back({out.members[r + 1], out.rivals[r].probability, false});
      continue;
    }
    sorted.members.push_back(out.members[r + 1]);
    sorted.rivals.push_back(out.rivals[r]);
  }
  return sorted;
}

void narrow(ConfounderSet& found, double likelihood_ratio) {
  const Effect& named = *found.members.front().hypothesis.effect;
  const auto at = std::ranges::find(found.rivals, named.second_order_twin, &Rival::effect);
  if (at == found.rivals.end()) return;
  const double both = found.probability + at->probability;
  const double other = both / (1.0 + std::exp(0.5 * likelihood_ratio));
  at->likelihood_ratio = likelihood_ratio;
  if (likelihood_ratio < likelihood_tells) {
    found.probability = both - other;
    at->probability = other;
    return;
  }
  found.probability = both;
  found.members.erase(found.members.begin() + 1 + (at - found.rivals.begin()));
  found.rivals.erase(at);
}

}  // namespace trueaxis::diagnose_detail

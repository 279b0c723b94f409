// SPDX-License-Identifier: Apache-2.0
#include "diagnose/explain/confounder_set.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "diagnose/explain/shared_scale.hpp"
#include "diagnose/regression/joint.hpp"
#include "diagnose/regression/size_prior.hpp"
#include "diagnose/search/judge.hpp"
#include "infer/classes.hpp"
#include "math/linear_algebra.hpp"
#include "trueaxis/effect.hpp"

namespace trueaxis::diagnose_detail {
namespace {

constexpr double farthest = 3.0;  // spreads of a size

/// Whether the named form is a special case of a rival cause's, lobes that grow along the part, or
/// nearly: a form about a place on the axis that was fitted, or lobes that decay.
bool is_case_of(const Hypothesis& named, const Hypothesis& rival) {
  const auto* one = named.effect ? std::get_if<Harmonic>(&named.effect->term) : nullptr;
  const auto* lobes = std::get_if<Harmonic>(&rival.effect->term);
  return one && lobes && lobes->envelope == Harmonic::Envelope::growing && !named.free.empty() &&
         rival.shape.order == named.shape.order &&
         (one->envelope == Harmonic::Envelope::lever || one->envelope == Harmonic::Envelope::jaws);
}

/// Lobes that keep a phase with the eccentricity may be just what a bend of the sensor or a play
/// makes of it.
bool may_be_bend(const Hypothesis& lobes, const Hypothesis& bend) {
  if (!lobes.effect || !has_free_order(*lobes.effect) || !bend.effect) return false;
  const auto* response = std::get_if<Response>(&bend.effect->term);
  return bends_reading(bend.effect->term) || (response && response->of == Response::Of::hysteresis);
}

Eigen::VectorXd size_of(const Columns& its, const Projection& beside) {
  return linear::shortest_solution(beside.gram(its, its), beside.gram(its, {0}).col(0)).x;
}

/// The first pair of a cause in spreads of its prior about the median, at most as far as sizes are
/// ordinary; 0: it has no such size.
double spreads_of(const Hypothesis& h, const Eigen::VectorXd& fitted) {
  if (!h.effect || !origin_of(*h.effect) || fitted.size() < 2) return 0.0;
  const SizePrior prior = size_prior(h);
  const double size = fitted.head(2).norm(), median = prior.median.head(2).norm();
  if (!(size > 0.0 && median > 0.0)) return 0.0;
  return std::clamp(std::log(size / median) / prior.spread, -farthest, farthest);
}

/// How far the size that a cause would have is from the usual: Rival::times_usual.
double times_usual(const Hypothesis& h, const Eigen::VectorXd& fitted) {
  if (!h.effect) return 0.0;
  std::map<const EffectParameter*, double> squares;
  const auto names = linear_parameters(h.effect->term, h.shape);
  for (std::size_t j = 0; j < static_cast<std::size_t>(fitted.size()); ++j)
    squares[size_for(*h.effect, names[h.free.empty() ? j : h.free[j]])] +=
        std::pow(fitted(static_cast<Eigen::Index>(j)), 2);
  double farthest = 0.0;
  for (const auto& [usual, square] : squares) {
    if (usual == nullptr || !(usual->high > 0.0) || !(square > 0.0)) continue;
    const double size = std::sqrt(square);
    const double times = size > usual->high  ? size / usual->high
                         : size < usual->low ? size / usual->low
                                             : 1.0;
    if (farthest == 0.0 || std::abs(std::log(times)) > std::abs(std::log(farthest)))
      farthest = times;
  }
  return farthest;
}

}  // namespace

ConfounderSet distinguish(const Proposer& proposer, const Model& model, std::size_t term,
                          int threads) {
  std::vector<Hypothesis> others = model.terms;
  others.erase(others.begin() + static_cast<long>(term));
  const Hypothesis& named = model.terms[term];
  std::vector<Candidate> causes = proposer.rivals(named, others, threads);
  std::erase_if(causes, [](const Candidate& c) { return c.rank == 0; });
  for (Candidate& c : causes)
    if (is_case_of(named, c.hypothesis)) c.hypothesis.free.clear();

  std::vector<Hypothesis> list = others;
  list.push_back(named);
  for (const Candidate& c : causes) list.push_back(c.hypothesis);
  const Joint joint(proposer.problem(), model.phi, list, others.size() + 1);
  const Columns base = joint.besides(others.size());
  const Columns& own = joint.places[others.size()];
  const Projection beside = project(joint.equations.total(), base);

  // The search has weighed the named one against all others jointly; its own refined form leads.
  ConfounderSet out;
  Columns named_columns = own;
  std::vector<Cause> rivals;
  std::vector<std::size_t> place;
  for (std::size_t k = 0; k < causes.size(); ++k) {
    Candidate& c = causes[k];
    const Columns& its = joint.places[others.size() + 1 + k];
    if (is_case_of(named, c.hypothesis)) {
      const Score all = score(beside, its);
      c.gain = all.gain, c.rank = all.rank;
      const double worse = static_cast<double>(joint.equations.count() - beside.rank) *
                           std::log((beside.rss - all.gain) /
                                    std::max(beside.rss - score(beside, own).gain, 1e-300));
      c.criterion = std::min(
          c.criterion, std::max(worse, 0.0) + criterion_as(c.hypothesis, its, named, own, beside,
                                                           joint.equations.count()));
    }
    if (c.hypothesis.effect != named.effect) {
      rivals.push_back({c.hypothesis.id(), its, c.gain, c.rank, c.criterion});
      place.push_back(k);
    } else if (out.members.empty()) {
      out.members.push_back(c);
      named_columns = its;
    }
  }
  if (out.members.empty()) {  // none of its own: it stays as it is
    const Score best = score(beside, own);
    const Weighed weighed = weigh(named, beside, own, joint.equations.count());
    out.members.push_back({named, best.gain, best.rank, 0.0, weighed.criterion + choice_of(named)});
  }
  const double criterion = out.members.front().criterion;
  for (std::size_t k = 0; k < rivals.size(); ++k) {
    Candidate& c = causes[place[k]];
    const Columns& its = rivals[k].columns;
    const bool bent = may_be_bend(c.hypothesis, named);
    if (bent || may_be_bend(named, c.hypothesis)) {
      const std::size_t count = joint.equations.count();
      const Hypothesis &lobes = bent ? c.hypothesis : named, &bend = bent ? named : c.hypothesis;
      const Columns &of_lobes = bent ? its : own, &of_bend = bent ? own : its;
      const Weighed as_lobes = weigh(lobes, beside, of_lobes, count);
      const Weighed as_bend = weigh(bend, beside, of_bend, count);
      const double over = counted_as_bend(
          as_lobes.criterion + choice_of(lobes) - as_bend.criterion - choice_of(bend),
          lobes_over_bend(lobes, of_lobes, bend, of_bend, beside, count),
          apart_in_phase(of_lobes, of_bend, beside) / (joint.sigma_mm * joint.sigma_mm));
      c.criterion = bent ? criterion + over : criterion - over;
    }
    rivals[k].criterion = c.criterion;
  }
  const Class found = infer::distinguish(
      joint.equations.total(), base, beside, {own, joint.of(others.size()), criterion}, rivals,
      joint.sigma_mm * joint.sigma_mm,
      static_cast<double>(joint.equations.count() - joint.solution.rank));
  out.probability = found.probability;
  out.spreads.push_back(spreads_of(out.members.front().hypothesis, size_of(named_columns, beside)));
  for (const Class::Member& m : found.members) {
    out.members.push_back(causes[place[m.cause]]);
    const Hypothesis& member = out.members.back().hypothesis;
    const Eigen::VectorXd size = size_of(rivals[m.cause].columns, beside);
    out.spreads.push_back(spreads_of(member, size));
    out.rivals.push_back(m.rival);
    out.rivals.back().times_usual = times_usual(member, size);
  }
  for (const Class::Dropped& d : found.dropped)
    out.dropped.push_back({causes[place[d.cause]], d.probability, d.told});
  return out;
}

void narrow(ConfounderSet& found, double twice_log_ratio) {
  const Effect& named = *found.members.front().hypothesis.effect;
  const auto at = std::ranges::find(found.rivals, named.second_order_twin, &Rival::effect);
  if (at == found.rivals.end()) return;
  const double both = found.probability + at->probability;
  const double other = both / (1.0 + std::exp(0.5 * twice_log_ratio));
  at->log_likelihood_ratio = 0.5 * twice_log_ratio;
  if (twice_log_ratio < likelihood_tells) {
    found.probability = both - other;
    at->probability = other;
    return;
  }
  found.probability = both;
  found.members.erase(found.members.begin() + 1 + (at - found.rivals.begin()));
  found.spreads.erase(found.spreads.begin() + 1 + (at - found.rivals.begin()));
  found.rivals.erase(at);
}

}  // namespace trueaxis::diagnose_detail

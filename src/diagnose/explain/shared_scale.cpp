// SPDX-License-Identifier: Apache-2.0
#include "diagnose/explain/shared_scale.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "infer/classes.hpp"

namespace trueaxis::diagnose_detail {
namespace {

/// Share of the variance of a logarithm of size that the orders of one source have in common.
/// Chosen: as much is their own.
constexpr double alike = 0.5;
constexpr std::size_t most_terms = 8;  // whose choices are all looked at; beyond, the last are not

/// ln of how much more likely sizes are together than each on its own.
class Together {
 public:
  void add(double spreads) { ++count_, sum_ += spreads, squares_ += spreads * spreads; }
  double log_ratio() const {
    if (count_ < 2) return 0.0;
    const double own = 1.0 - alike, others = alike * (count_ - 1), all = 1.0 + others;
    const double square = (squares_ - alike / all * sum_ * sum_) / own;
    return -0.5 * ((count_ - 1) * std::log(own) + std::log(all) + square - squares_);
  }

 private:
  int count_ = 0;
  double sum_ = 0.0, squares_ = 0.0;
};

double probability_of(const ConfounderSet& found, std::size_t member) {
  return member == 0 ? found.probability : found.rivals[member - 1].probability;
}

/// What a term may be, of those that have a source; the rest is one choice.
struct Choice {
  std::optional<Origin> origin;
  double spreads = 0.0, probability = 0.0, weight = 0.0;
  std::vector<std::size_t> members;
};

std::vector<Choice> choices_of(const ConfounderSet& found) {
  std::vector<Choice> out(1);
  for (std::size_t m = 0; m < found.members.size(); ++m) {
    const auto origin = origin_of(*found.members[m].hypothesis.effect);
    Choice& choice = origin ? out.emplace_back() : out.front();
    choice.origin = origin;
    choice.spreads = found.spreads[m];
    choice.probability += probability_of(found, m);
    choice.members.push_back(m);
  }
  if (out.front().members.empty()) out.erase(out.begin());
  return out;
}

/// All that terms may be together: adds to each choice the probability of all that have it.
void weigh_all(std::vector<std::vector<Choice>>& terms) {
  std::vector<std::size_t> at(terms.size(), 0);
  while (true) {
    std::array<Together, 2> sizes;
    double weight = 1.0;
    for (std::size_t t = 0; t < terms.size(); ++t) {
      const Choice& c = terms[t][at[t]];
      weight *= c.probability;
      if (c.origin) sizes[static_cast<std::size_t>(*c.origin)].add(c.spreads);
    }
    weight *= std::exp(sizes[0].log_ratio() + sizes[1].log_ratio());
    for (std::size_t t = 0; t < terms.size(); ++t) terms[t][at[t]].weight += weight;
    std::size_t t = 0;
    for (; t < terms.size() && ++at[t] == terms[t].size(); ++t) at[t] = 0;
    if (t == terms.size()) return;
  }
}

/// The most probable rival cause first.
void sort_rivals(ConfounderSet& found) {
  std::vector<std::size_t> order(found.rivals.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, std::ranges::greater{},
                           [&](std::size_t k) { return found.rivals[k].probability; });
  ConfounderSet out = found;
  for (std::size_t k = 0; k < order.size(); ++k) {
    out.rivals[k] = found.rivals[order[k]];
    out.members[k + 1] = found.members[order[k] + 1];
    out.spreads[k + 1] = found.spreads[order[k] + 1];
  }
  found = std::move(out);
}

}  // namespace

std::optional<Origin> origin_of(const Effect& effect) {
  const auto* harmonic = std::get_if<Harmonic>(&effect.term);
  if (!harmonic || !has_free_order(effect) || harmonic->angle == Harmonic::Angle::chuck) return {};
  return harmonic->angle == Harmonic::Angle::part ? Origin::part : Origin::spindle;
}

void share_scales(std::vector<AmbiguousFinding>& findings) {
  std::vector<ConfounderSet*> sets;
  std::vector<std::vector<Choice>> terms;
  for (AmbiguousFinding& finding : findings) {
    std::vector<Choice> choices = choices_of(finding.found);
    if (terms.size() == most_terms ||
        std::ranges::none_of(choices, [](const Choice& c) { return c.origin.has_value(); }))
      continue;
    sets.push_back(&finding.found);
    terms.push_back(std::move(choices));
  }
  if (terms.size() < 2) return;
  weigh_all(terms);
  for (std::size_t t = 0; t < terms.size(); ++t) {
    const double all = std::transform_reduce(terms[t].begin(), terms[t].end(), 0.0, std::plus{},
                                             [](const Choice& c) { return c.weight; });
    if (!(all > 0.0)) continue;
    for (const Choice& c : terms[t])
      for (const std::size_t m : c.members) {
        const double now = c.probability > 0.0
                               ? probability_of(*sets[t], m) / c.probability * c.weight / all
                               : 0.0;
        (m == 0 ? sets[t]->probability : sets[t]->rivals[m - 1].probability) = now;
      }
    sort_rivals(*sets[t]);
  }
}

}  // namespace trueaxis::diagnose_detail

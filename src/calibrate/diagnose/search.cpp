// SPDX-License-Identifier: Apache-2.0
#include "calibrate/diagnose/search.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "infer/model_criterion.hpp"
#include "infer/stepwise.hpp"

namespace trueaxis::calibrate_detail {
namespace {

using Set = Regression::Set;

constexpr std::size_t of_pairs = 100;

class Search {
 public:
  Search(const Regression& regression, const std::vector<Term>& terms, const SearchOptions& options)
      : regression_(regression), terms_(terms), options_(options) {}

  Set found() {
    infer::search_stepwise(*this);
    return set_;
  }

  std::size_t size() const { return set_.size(); }

  void forward() {
    while (set_.size() < options_.most) {
      const auto best = best_beside(set_, true);
      if (!best) return;
      set_.push_back(*best);
      if (set_.size() == 1) take_pair();
    }
  }

  /// Over the level of its family.
  double log_p(std::size_t i) const {
    const Term& term = terms_[set_[i]];
    return log_p_of(regression_, regression_.beside(without(set_, i)), set_[i]) -
           std::log(options_.family_of(term).single_level(options_.false_alarm));
  }
  bool passes(double log_p) const { return log_p < 0.0; }
  void drop(std::size_t i) { set_ = without(std::move(set_), i); }

  bool exchange() {
    bool changed = false;
    for (std::size_t i = 0; i < set_.size(); ++i) {
      const auto best = best_beside(without(set_, i), false);
      if (!best || *best == set_[i]) continue;
      Set other = set_;
      other[i] = *best;
      if (criterion(other) > criterion(set_) - infer::better_by) continue;
      set_ = std::move(other);
      changed = true;
    }
    return changed;
  }

 private:
  bool may_be_taken(std::size_t t) const {
    return !regression_.block(t).columns.empty() && !terms_[t].barred;
  }

  /// The best term beside others. @param passing that passes its test as well
  std::optional<std::size_t> best_beside(const Set& others, bool passing) const {
    const infer::Projection beside = regression_.beside(others);
    std::optional<std::size_t> best;
    double least = 0.0;
    for (std::size_t t = 0; t < terms_.size(); ++t) {
      if (!may_be_taken(t) || std::ranges::find(others, t) != others.end()) continue;
      if (passing &&
          family_p(options_, terms_[t], log_p_of(regression_, beside, t)) >= options_.false_alarm)
        continue;
      const double value =
          weighed(regression_, terms_, t, beside, regression_.block(t).columns).criterion;
      // Of two alike (orders that the positions alias) the first stands.
      if (!best || value < least - 1e-6) best = t, least = value;
    }
    return best;
  }

  double criterion(const Set& set) const {
    // Of few columns: no product with any other is asked for.
    infer::Columns small{0};
    std::vector<infer::Columns> places;
    for (const std::size_t t : set) {
      places.emplace_back(regression_.block(t).columns.size());
      std::iota(places.back().begin(), places.back().end(), small.size());
      small.insert(small.end(), regression_.block(t).columns.begin(),
                   regression_.block(t).columns.end());
    }
    const Eigen::MatrixXd gram = regression_.gram()(small, small);
    return infer::model_criterion(gram, {}, places, regression_.rows(),
                                  [&](std::size_t i, const infer::Projection& beside) {
                                    return weighed(regression_, terms_, set[i], beside, places[i]);
                                  });
  }

  /// The best pair of the terms that do most alone, in the place of the best term where it is
  /// better: of two effects a third may look most like both.
  void take_pair() {
    const infer::Projection beside = regression_.beside({});
    std::vector<std::pair<double, std::size_t>> alone;
    for (std::size_t t = 0; t < terms_.size(); ++t)
      if (may_be_taken(t))
        alone.emplace_back(-infer::score(beside, regression_.block(t).columns).gain, t);
    std::ranges::sort(alone);
    if (alone.size() > of_pairs) alone.resize(of_pairs);
    const Set first = set_;
    double least = criterion(first);
    for (std::size_t a = 0; a < alone.size(); ++a)
      for (std::size_t b = 0; b < a; ++b) {
        const Set pair{alone[a].second, alone[b].second};
        if (const double value = criterion(pair); value < least) least = value, set_ = pair;
      }
    for (std::size_t i = 0; i < set_.size() && set_.size() > 1; ++i)
      if (!passes(log_p(i))) set_ = first;
  }

  const Regression& regression_;
  const std::vector<Term>& terms_;
  const SearchOptions& options_;
  Set set_;
};

}  // namespace

double tests_of(const Regression& regression, const std::vector<Term>& terms) {
  double tests = 0.0;
  for (std::size_t t = 0; t < terms.size(); ++t)
    if (!terms[t].pattern && !regression.block(t).columns.empty()) tests += terms[t].tests;
  return std::max(1.0, tests);
}

double log_p_of(const Regression& regression, const infer::Projection& beside, std::size_t term) {
  const infer::Score s = infer::score(beside, regression.block(term).columns);
  return infer::log_p_value(s.gain, static_cast<double>(s.rank), beside.rss,
                            static_cast<double>(regression.rows() - beside.rank));
}

double family_p(const SearchOptions& options, const Term& term, double log_p) {
  return options.family_of(term).p_value(std::exp(log_p));
}

infer::Weighed weighed(const Regression& regression, const std::vector<Term>& terms,
                       std::size_t term, const infer::Projection& beside,
                       const infer::Columns& columns) {
  infer::Weighed out =
      infer::weigh(regression.block(term).prior, beside, columns, regression.rows());
  out.criterion += 2.0 * std::log(std::max(1.0, terms[term].tests)) +
                   (terms[term].pattern ? infer::catalogue_first : 0.0);
  return out;
}

Set search(const Regression& regression, const std::vector<Term>& terms,
           const SearchOptions& options) {
  return Search(regression, terms, options).found();
}

}  // namespace trueaxis::calibrate_detail

// SPDX-License-Identifier: Apache-2.0
#include "infer/dictionary_search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

#include "infer/stepwise.hpp"
#include "math/linear_algebra.hpp"

namespace trueaxis::infer {
namespace {

using Set = Dictionary::Set;

constexpr std::size_t of_pairs = 100;

class Search {
 public:
  Search(const Dictionary& dictionary, const SearchOptions& options)
      : dictionary_(dictionary), options_(options) {}

  Set found() {
    search_stepwise(*this);
    return set_;
  }

  // What infer/stepwise.hpp asks of a side.

  Set& terms() { return set_; }
  std::size_t most() const { return options_.most; }
  std::optional<std::size_t> passing_beside(const Set& others) const { return best(others, true); }
  std::optional<std::size_t> best_beside(const Set& others) const { return best(others, false); }

  /// Over the level of its family.
  double log_p(std::size_t i) const {
    return dictionary_.model(set_).log_p(i) -
           std::log(
               options_.family_of(dictionary_.block(set_[i])).single_level(options_.false_alarm));
  }
  bool passes(double log_p) const { return log_p < 0.0; }

  double criterion(const Set& set) const {
    // Of few columns: no product with any other is asked for.
    Columns small{0};
    std::vector<Columns> places;
    for (const std::size_t t : set) {
      const Columns& own = dictionary_.block(t).columns;
      places.emplace_back(own.size());
      std::iota(places.back().begin(), places.back().end(), small.size());
      small.insert(small.end(), own.begin(), own.end());
    }
    const Eigen::MatrixXd gram = dictionary_.gram()(small, small);
    const Fitted model{gram, {}, std::move(places), dictionary_.rows()};
    return model.criterion([&](std::size_t i, const Projection& beside) {
      return dictionary_.weighed(set[i], beside, model.terms[i]);
    });
  }

  bool may_leave(std::size_t) const { return true; }
  bool exchange() { return exchange_each(*this); }
  void taken() {
    if (set_.size() == 1) take_pair();
  }
  void dropped() {}

 private:
  bool may_be_taken(std::size_t t) const {
    return !dictionary_.block(t).columns.empty() && !dictionary_.block(t).barred;
  }

  /// The best term after others. @param passing that passes its test as well
  std::optional<std::size_t> best(const Set& others, bool passing) const {
    const Projection beside = dictionary_.beside(others);
    std::optional<std::size_t> first;
    double least = 0.0;
    for (std::size_t t = 0; t < dictionary_.size(); ++t) {
      if (!may_be_taken(t) || std::ranges::find(others, t) != others.end()) continue;
      if (passing && family_p(dictionary_, options_, beside, t) >= options_.false_alarm) continue;
      const double value = dictionary_.weighed(t, beside).criterion;
      // Of two alike (orders that the positions alias) the first stays.
      if (!first || value < least - 1e-6) first = t, least = value;
    }
    return first;
  }

  /// The best pair of the terms that do most alone, in the place of the best term where it is
  /// better: of two effects a third may look most like both.
  void take_pair() {
    const Projection beside = dictionary_.beside({});
    std::vector<std::pair<double, std::size_t>> alone;
    for (std::size_t t = 0; t < dictionary_.size(); ++t)
      if (may_be_taken(t)) alone.emplace_back(-score(beside, dictionary_.block(t).columns).gain, t);
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

  const Dictionary& dictionary_;
  const SearchOptions& options_;
  Set set_;
};

}  // namespace

double family_p(const Dictionary& dictionary, const SearchOptions& options,
                const Projection& others, std::size_t term) {
  return options.family_of(dictionary.block(term))
      .p_value(std::exp(dictionary.log_p(others, term)));
}

Set search(const Dictionary& dictionary, const SearchOptions& options) {
  return Search(dictionary, options).found();
}

Class class_of(const Dictionary& dictionary, const Set& set, std::size_t at) {
  const Dictionary::Block& named = dictionary.block(set[at]);
  const Columns others = dictionary.columns_of(without(set, at));
  const Projection beside(dictionary.gram(), others);
  std::vector<Cause> causes;  // the best of each effect first
  for (std::size_t t = 0; t < dictionary.size(); ++t) {
    const Dictionary::Block& block = dictionary.block(t);
    if (block.pattern || block.name == named.name || block.columns.empty() ||
        std::ranges::find(set, t) != set.end())
      continue;
    const Score s = score(beside, block.columns);
    if (s.rank > 0)
      causes.push_back(
          {block.name, block.columns, s.gain, s.rank, dictionary.weighed(t, beside).criterion});
  }
  std::ranges::stable_sort(causes, {}, &Cause::criterion);
  const Solution all = dictionary.fitted(with_last(set, at));
  const auto freedom = static_cast<double>(dictionary.rows() - all.rank);
  return distinguish(
      dictionary.gram(), others, beside,
      {named.columns, all.coefficients.tail(static_cast<Eigen::Index>(named.columns.size())),
       dictionary.weighed(set[at], beside).criterion},
      causes, all.rss / freedom, freedom);
}

double Detection::lambda(std::size_t term) const {
  const Dictionary::Block& block = dictionary_.block(term);
  const auto rank = static_cast<Eigen::Index>(block.columns.size());
  if (rank < block.back.rows()) return 0.0;
  // Orthonormal columns are those of the term times its own axes over their lengths.
  const Eigen::VectorXd length = block.back.colwise().norm().cwiseInverse();
  const Eigen::MatrixXd left =
      length.asDiagonal() * beside_.gram(block.columns, block.columns) * length.asDiagonal();
  return std::max(0.0, linear::eigenvalues(left).minCoeff()) / variance_;
}

double Detection::detectable_size(std::size_t term) const {
  const double one = lambda(term);
  if (!(one > 0.0)) return std::numeric_limits<double>::infinity();
  const std::size_t rank = dictionary_.block(term).columns.size();
  if (half_lambda_.size() <= rank) half_lambda_.resize(rank + 1, 0.0);
  if (half_lambda_[rank] == 0.0)
    half_lambda_[rank] = required_lambda(static_cast<double>(rank),
                                         freedom_ - static_cast<double>(rank), level_, 0.5);
  return std::sqrt(half_lambda_[rank] / one);
}

double Detection::power(std::size_t term, double size) const {
  const double one = lambda(term);
  if (!(one > 0.0)) return level_;
  const auto rank = static_cast<double>(dictionary_.block(term).columns.size());
  return detection_power(size * size * one, rank, freedom_ - rank, level_);
}

}  // namespace trueaxis::infer

// SPDX-License-Identifier: Apache-2.0
#include "calibrate/diagnose/explain.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "infer/classes.hpp"
#include "math/covariance.hpp"

namespace trueaxis::calibrate_detail {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// The other effects as causes of a finding, the best of each first.
std::vector<infer::Cause> causes_of(const Regression& regression, const std::vector<Term>& terms,
                                    const Regression::Set& set, std::size_t at,
                                    const infer::Projection& beside) {
  std::vector<infer::Cause> causes;
  for (std::size_t t = 0; t < terms.size(); ++t) {
    const infer::Columns& own = regression.block(t).columns;
    if (terms[t].pattern || terms[t].effect == terms[set[at]].effect || own.empty() ||
        std::ranges::find(set, t) != set.end())
      continue;
    const infer::Score s = infer::score(beside, own);
    if (s.rank > 0)
      causes.push_back({terms[t].effect, own, s.gain, s.rank,
                        weighed(regression, terms, t, beside, own).criterion});
  }
  std::ranges::stable_sort(causes, {}, &infer::Cause::criterion);
  return causes;
}

}  // namespace

MachineFinding finding_of(const Regression& regression, const std::vector<Term>& terms,
                          const Regression::Set& set, std::size_t at,
                          const SearchOptions& options) {
  const Term& term = terms[set[at]];
  const auto& block = regression.block(set[at]);
  const Regression::Set others = without(set, at);
  const infer::Projection beside = regression.beside(others);
  const infer::Solution all = regression.fitted(with_last(set, at));
  const auto rank = static_cast<Index>(block.columns.size());
  const VectorXd a = all.coefficients.tail(rank);
  const auto freedom = static_cast<double>(regression.rows() - all.rank);
  const double variance = all.rss / freedom;

  MachineFinding out;
  out.effect = term.effect;
  out.formula = term.formula;
  out.shape = term.shape;
  if (term.of) {
    out.term = term.of->term;
    out.consequence = term.of->consequence;
  }
  out.p_value = family_p(options, term, log_p_of(regression, beside, set[at]));
  const infer::Class found = infer::distinguish(
      regression.gram(), regression.columns_of(others), beside,
      {block.columns, a, weighed(regression, terms, set[at], beside, block.columns).criterion},
      causes_of(regression, terms, set, at, beside), variance, freedom);
  for (const infer::Class::Member& member : found.members) out.rivals.push_back(member.rival);
  out.probability = found.probability;

  const VectorXd value = block.back * a;
  const MatrixXd covariance =
      variance * block.back * all.inverse.bottomRightCorner(rank, rank) * block.back.transpose();
  out.covariance = with_names(term.parameters, covariance);
  for (Index k = 0; k < value.size(); ++k)
    out.parameters.push_back(
        {term.parameters[static_cast<std::size_t>(k)],
         {value[k], std::sqrt(std::max(0.0, covariance(k, k))), term.angle ? "rad" : "mm", ""}});
  for (std::size_t k = 0; k < term.errors.size(); ++k) {
    ErrorTerm error = term.errors[k];
    error.function = scaled(error.function, value[static_cast<Index>(k)]);
    out.errors.push_back(std::move(error));
  }
  out.size = value.norm();
  // Over σ: the caller knows σ and the number of readings.
  out.rms_mm = std::sqrt(infer::left_of(beside, block.columns, a));
  return out;
}

double Detection::detectable_size(std::size_t term) const {
  const auto& block = regression_.block(term);
  const std::size_t rank = block.columns.size();
  if (rank == 0 || !(block.information > 0.0)) return std::numeric_limits<double>::infinity();
  if (half_lambda_.size() <= rank) half_lambda_.resize(rank + 1, 0.0);
  if (half_lambda_[rank] == 0.0)
    half_lambda_[rank] = infer::required_lambda(
        static_cast<double>(rank), static_cast<double>(regression_.rows() - rank), level_, 0.5);
  return std::sqrt(half_lambda_[rank] * variance_ / block.information);
}

double Detection::surely(std::size_t term, double size) const {
  const auto& block = regression_.block(term);
  const std::size_t rank = block.columns.size();
  if (static_cast<Index>(rank) < block.back.rows() || !(block.weakest > 0.0)) return level_;
  return infer::detection_power(size * size * block.weakest / variance_, static_cast<double>(rank),
                                static_cast<double>(regression_.rows() - rank), level_);
}

}  // namespace trueaxis::calibrate_detail

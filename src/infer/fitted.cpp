// SPDX-License-Identifier: Apache-2.0
#include "infer/fitted.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "infer/significance.hpp"
#include "math/linear_algebra.hpp"

namespace trueaxis::infer {
namespace {

/// ln det(G + Λ), Λ what the plausible sizes add: if terms share their columns, the width of all
/// together is not the sum of what each has after the others.
double shared_width(const Projection& beside, const Columns& own, const Weighed& sizes) {
  Eigen::MatrixXd gram = beside.gram(own, own);
  gram.diagonal() += sizes.precision;
  const linear::Cholesky factor(gram);
  return factor.positive_definite() ? factor.log_determinant() : 0.0;
}
Weighed joined(const std::vector<Weighed>& sizes) {
  Weighed out;
  for (const Weighed& w : sizes) {
    const Eigen::VectorXd before = out.precision;
    out.precision.resize(before.size() + w.precision.size());
    out.precision << before, w.precision;
  }
  return out;
}

}  // namespace

Columns besides(Columns base, std::span<const Columns> terms, std::size_t but) {
  for (std::size_t t = 0; t < terms.size(); ++t)
    if (t != but) base.insert(base.end(), terms[t].begin(), terms[t].end());
  return base;
}

double log_p_of(const Projection& beside, const Columns& own, std::size_t count) {
  const Score s = score(beside, own);
  return log_p_value(s.gain, static_cast<double>(s.rank), beside.rss,
                     static_cast<double>(count - beside.rank));
}

Eigen::VectorXd Fitted::of(std::size_t term) const {
  Columns all = besides(term);
  all.insert(all.end(), terms[term].begin(), terms[term].end());
  return solve(gram, all).coefficients.tail(static_cast<Eigen::Index>(terms[term].size()));
}

double Fitted::criterion(const WeighTerm& weigh_term, bool one_width) const {
  double sum =
      static_cast<double>(count - base.size()) * std::log(solve(gram, besides()).rss / gram(0, 0));
  std::vector<Weighed> sizes;
  for (std::size_t i = 0; i < terms.size(); ++i) {
    const Projection others = beside(i);
    Weighed weighed = weigh_term(i, others);
    const double gain = score(others, terms[i]).gain;
    if (one_width) sum -= shared_width(others, terms[i], weighed);
    sum += weighed.criterion - static_cast<double>(count - others.rank) *
                                   std::log(std::max(1.0 - gain / others.rss, 1e-12));
    sizes.push_back(std::move(weighed));
  }
  if (one_width && !terms.empty())
    sum += shared_width(project(gram, base), infer::besides({}, terms), joined(sizes));
  return sum;
}

std::vector<std::size_t> remaining(Fitted model, std::vector<double> level) {
  std::vector<std::size_t> out(model.terms.size());
  std::iota(out.begin(), out.end(), std::size_t{0});
  while (!out.empty()) {
    std::vector<double> over;
    for (std::size_t i = 0; i < out.size(); ++i) over.push_back(model.log_p(i) - level[i]);
    const auto weakest = std::ranges::max_element(over) - over.begin();
    if (over[static_cast<std::size_t>(weakest)] < 0.0) break;
    out.erase(out.begin() + weakest);
    level.erase(level.begin() + weakest);
    model.terms.erase(model.terms.begin() + weakest);
  }
  return out;
}

}  // namespace trueaxis::infer

// SPDX-License-Identifier: Apache-2.0
#include "infer/model_criterion.hpp"

#include <algorithm>
#include <cmath>

#include "math/linear_algebra.hpp"

namespace trueaxis::infer {
namespace {

/// ln det(G + Λ), Λ what the plausible sizes add: of terms that share their columns the width of
/// all together is not the sum of what each has beside the others.
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

Columns besides(const Columns& base, const std::vector<Columns>& terms, std::size_t but) {
  Columns taken = base;
  for (std::size_t t = 0; t < terms.size(); ++t)
    if (t != but) taken.insert(taken.end(), terms[t].begin(), terms[t].end());
  return taken;
}

double model_criterion(const Eigen::MatrixXd& gram, const Columns& base,
                       const std::vector<Columns>& terms, std::size_t count,
                       const WeighTerm& weigh_term, bool one_width) {
  const Solution s = solve(gram, besides(base, terms, terms.size()));
  double sum = static_cast<double>(count - base.size()) * std::log(s.rss / gram(0, 0));
  std::vector<Weighed> sizes;
  for (std::size_t i = 0; i < terms.size(); ++i) {
    const Projection beside = project(gram, besides(base, terms, i));
    Weighed weighed = weigh_term(i, beside);
    const double gain = score(beside, terms[i]).gain;
    if (one_width) sum -= shared_width(beside, terms[i], weighed);
    sum += weighed.criterion - static_cast<double>(count - beside.rank) *
                                   std::log(std::max(1.0 - gain / beside.rss, 1e-12));
    sizes.push_back(std::move(weighed));
  }
  if (one_width && !terms.empty())
    sum += shared_width(project(gram, base), besides({}, terms, terms.size()), joined(sizes));
  return sum;
}

}  // namespace trueaxis::infer

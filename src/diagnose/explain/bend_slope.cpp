// SPDX-License-Identifier: Apache-2.0
#include "diagnose/explain/bend_slope.hpp"

#include <algorithm>
#include <cmath>

#include "diagnose/search/causes.hpp"

namespace trueaxis::diagnose_detail {
namespace {

bool is(Response::Of of, const Effect& effect) {
  const auto* response = std::get_if<Response>(&effect.term);
  return response && response->of == of;
}

}  // namespace

std::optional<Hypothesis> slope_beside(const Problem& problem,
                                       const std::vector<Hypothesis>& terms) {
  const auto is_found = [&](const Hypothesis& h) {
    return h.effect && is(Response::Of::gain, *h.effect);
  };
  const auto gain = std::ranges::find_if(
      problem.effects, [](const Effect* effect) { return is(Response::Of::gain, *effect); });
  if (gain == problem.effects.end() || (*gain)->stated || std::ranges::any_of(terms, is_found))
    return {};
  return of_effect(**gain, typical_shape(**gain, problem.point));
}

bool bends_about_a_place(const Hypothesis& h) {
  return h.effect && is(Response::Of::nonlinearity, *h.effect);
}

SizePrior slope_prior(const Hypothesis& bend, const Weighed& size) {
  // c₂v² about a place r of the range read has the slope −2c₂r in the middle; r is anywhere in
  // (−1, 1), r² is 1/3 in the mean. c₃v³ alone has its place near the middle, and −3c₃r² with
  // 3c₃r as large as c₃.
  const auto names = linear_parameters(bend.effect->term, bend.shape);
  double variance = 0.0;
  for (Eigen::Index j = 0; j < size.mean.size(); ++j) {
    const auto k = static_cast<std::size_t>(j);
    const bool square = names[bend.free.empty() ? k : bend.free[k]].name == "quadratic";
    const double size2 = size.mean(j) * size.mean(j) + size.covariance(j, j);
    variance += (square ? 4.0 : 1.0) / 3.0 * size2;
  }
  SizePrior out;
  out.median = Eigen::VectorXd::Ones(1);
  out.stated = std::sqrt(variance) / bend.shape.range_mm, out.doubt = 0.0;
  return out;
}

}  // namespace trueaxis::diagnose_detail

// SPDX-License-Identifier: Apache-2.0
#include "calibrate/explain.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <boost/math/distributions/fisher_f.hpp>
#include <boost/math/distributions/non_central_f.hpp>
#include <cmath>

#include "math/linear_algebra.hpp"

namespace trueaxis::calibrate_detail {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double likelihood_tells = 7.0;  // a rival that is true passes with 0.4 %
constexpr double surely_apart = 6.6;      // Φ(d/2) = 0.9995

double criterion_of(const Regression::Beside& left, double gain, Index rank) {
  return left.freedom * std::log(std::max(left.rss - gain, 1e-300)) +
         2.0 * static_cast<double>(rank);
}

void settle_probabilities(double named, std::vector<double>& criteria,
                          std::vector<MachineRival>& rivals, double& probability) {
  double least = named;
  for (const double one : criteria) least = std::min(least, one);
  double sum = std::exp(-0.5 * (named - least));
  probability = sum;
  for (const double one : criteria) sum += std::exp(-0.5 * (one - least));
  probability /= sum;
  for (std::size_t r = 0; r < rivals.size(); ++r)
    rivals[r].probability = std::exp(-0.5 * (criteria[r] - least)) / sum;
}

struct Class {
  std::vector<MachineRival> rivals;
  double probability = 1.0;
};

Regression::Set others_of(const Regression::Set& set, std::size_t at) {
  Regression::Set others = set;
  others.erase(others.begin() + static_cast<std::ptrdiff_t>(at));
  return others;
}

Class class_of(const Regression& regression, const std::vector<Term>& terms,
               const Regression::Set& set, std::size_t at) {
  const Regression::Beside left = regression.beside(others_of(set, at));
  const auto& own = regression.block(set[at]);
  const MatrixXd G = left.products.block(own.first, own.first, own.rank, own.rank);
  const VectorXd c = left.right.segment(own.first, own.rank);
  const VectorXd a = linear::least_squares(G, c);
  const double own_gain = c.dot(a), variance = (left.rss - own_gain) / left.freedom;
  const double named = criterion_of(left, own_gain, own.rank);
  Class out;
  std::vector<double> criteria;
  for (std::size_t t = 0; t < terms.size(); ++t) {
    const auto& block = regression.block(t);
    if (terms[t].pattern || terms[t].effect == terms[set[at]].effect || block.rank == 0 ||
        std::ranges::find(set, t) != set.end())
      continue;
    const MatrixXd H = left.products.block(block.first, block.first, block.rank, block.rank);
    const VectorXd cross = left.products.block(block.first, own.first, block.rank, own.rank) * a;
    const double gain = gain_of(H, left.right.segment(block.first, block.rank));
    const double left2 = std::max(0.0, a.dot(G * a) - gain_of(H, cross));
    MachineRival rival{terms[t].effect, std::sqrt(left2 / variance), 0.0, 0.0};
    const double value = criterion_of(left, gain, block.rank);
    rival.likelihood_ratio = value - named;
    if (rival.distance >= surely_apart ||
        (rival.distance >= told_apart && rival.likelihood_ratio >= likelihood_tells))
      continue;
    const auto listed = std::ranges::find(out.rivals, rival.effect, &MachineRival::effect);
    if (listed == out.rivals.end()) {
      out.rivals.push_back(rival);
      criteria.push_back(value);
    } else if (double& before = criteria[static_cast<std::size_t>(listed - out.rivals.begin())];
               value < before) {
      *listed = rival;
      before = value;
    }
  }
  settle_probabilities(named, criteria, out.rivals, out.probability);
  std::ranges::stable_sort(out.rivals, std::ranges::greater{}, &MachineRival::probability);
  return out;
}

}  // namespace

MachineFinding finding_of(const Regression& regression, const std::vector<Term>& terms,
                          const Regression::Set& set, std::size_t at,
                          const SearchOptions& options) {
  const Term& term = terms[set[at]];
  const Regression::Set others = others_of(set, at);
  const auto& block = regression.block(set[at]);
  MachineFinding out;
  out.effect = term.effect;
  out.formula = term.formula;
  out.shape = term.shape;
  out.p_value = std::min(1.0, options.measurement_alarm * chance(regression, others, set[at]) /
                                  options.level_of(term));
  Class alike = class_of(regression, terms, set, at);
  out.rivals = std::move(alike.rivals);
  out.probability = alike.probability;

  const Regression::Beside left = regression.beside(others);
  const MatrixXd G = left.products.block(block.first, block.first, block.rank, block.rank);
  const VectorXd c = left.right.segment(block.first, block.rank);
  const VectorXd a = linear::least_squares(G, c);
  const double variance = (regression.rss() - regression.gain(set)) /
                          (regression.freedom() - static_cast<double>(regression.rank(set)));
  const VectorXd value = block.back * a;
  const MatrixXd covariance = linear::product_transposed(
      linear::product(variance * block.back, linear::pseudo_inverse(G)), block.back);
  out.covariance.assign(covariance.data(), covariance.data() + covariance.size());
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
  out.rms_mm = std::sqrt(a.dot(G * a));  // over σ: the caller knows σ and the number of readings
  return out;
}

double detectable_lambda(double rank, double freedom, double single_level, double power) {
  const boost::math::fisher_f central(rank, freedom);
  const double critical = quantile(complement(central, single_level));
  double low = 0.0, high = 1e4;
  for (int step = 0; step < 60; ++step) {
    const double middle = 0.5 * (low + high);
    const boost::math::non_central_f distribution(rank, freedom, middle);
    (cdf(complement(distribution, critical)) < power ? low : high) = middle;
  }
  return high;
}

namespace {

/// The same for few ranks, remembered as long as the rest stays.
double known_lambda(Index rank, double freedom, double single_level, double power) {
  static thread_local std::array<std::pair<std::array<double, 3>, double>, 4> known{};
  auto& [of, lambda] = known[static_cast<std::size_t>(std::min<Index>(rank, 3))];
  const std::array now{freedom, single_level, power};
  if (of != now) {
    of = now;
    const auto q = static_cast<double>(rank);
    lambda = detectable_lambda(q, freedom - q, single_level, power);
  }
  return lambda;
}

}  // namespace

std::optional<double> detectable_size(const Regression& regression, std::size_t term,
                                      double variance, const SearchOptions& options) {
  const auto& block = regression.block(term);
  if (block.rank == 0 || !(block.information > 0.0)) return std::nullopt;
  const double lambda = known_lambda(block.rank, regression.freedom(), options.single_level(), 0.5);
  return std::sqrt(lambda * variance / block.information);
}

std::optional<double> surely_shown_size(const Regression& regression, std::size_t term,
                                        double variance, const SearchOptions& options) {
  const auto& block = regression.block(term);
  if (block.rank < block.back.rows() || !(block.weakest > 0.0)) return std::nullopt;
  const double lambda =
      known_lambda(block.rank, regression.freedom(), options.single_level(), sure_power);
  return std::sqrt(lambda * variance / block.weakest);
}

}  // namespace trueaxis::calibrate_detail

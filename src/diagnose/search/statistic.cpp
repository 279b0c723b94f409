// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/fisher_f.hpp>
#include <cmath>

#include "diagnose/search/search.hpp"

namespace trueaxis::diagnose_detail {
namespace {

constexpr double generous = 3.0;     // times the largest typical size: no surprise yet
constexpr double most_second = 0.3;  // of a jaw's second harmonic; ring theory says 0.05 for three
constexpr double surprise = 2.0;     // of ln(size/(generous × typical))², in units of 2 ln L

/// Largest typical size of the catalogue's parameter that a linear one is the factor of; 0: none.
/// Of a sensor that is not linear it is a share of the range that the term is written over.
double typical_high(const Effect& effect, const TermShape& shape, std::string_view linear) {
  constexpr double of_range = 0.01;
  for (const EffectParameter& p : effect.parameters) {
    if (linear == p.name || (linear.starts_with(p.name) && linear.size() > p.name.size() &&
                             linear[p.name.size()] == '_'))
      return effect.id == "probe.nonlinearity" ? std::min(p.high, of_range * shape.range_mm)
                                               : p.high;
  }
  return 0.0;
}

}  // namespace

double log_p_value(double gain, double rank, double rss, double freedom) {
  const double left = freedom - rank;
  if (!(gain > 0.0) || rank < 1.0 || left < 1.0) return 0.0;
  const double rest = std::max(rss - gain, 1e-12 * rss);
  const double f = gain / rank / (rest / left);
  // Far out the tail of the F distribution is (1 + q F/ν)^(−ν/2) up to a factor that changes
  // slowly.
  if (f * rank > 600.0 && left > 60.0) return -0.5 * left * std::log1p(rank * f / left);
  const boost::math::fisher_f distribution(rank, left);
  const double p = cdf(complement(distribution, f));
  return p > 0.0 ? std::log(p) : -700.0;
}

double Family::p_value(double single_p) const {
  if (!(single_p < 1.0)) return 1.0;
  const double z = single_p > 0.0 ? -std::log(single_p) : 700.0;
  return -std::expm1(-single_p * (single + bandwidth * std::sqrt(std::max(z, 1.0))));
}

double Family::threshold(double level) const {
  double low = 0.0, high = 400.0;  // e^(−z/2) is the p-value of a statistic z
  for (int i = 0; i < 60; ++i) {
    const double z = 0.5 * (low + high);
    (p_value(std::exp(-0.5 * z)) > level ? low : high) = z;
  }
  return high;
}

double penalty(const Hypothesis& hypothesis, std::size_t rank, std::size_t count,
               const Eigen::VectorXd& coefficients) {
  double sum = static_cast<double>(rank) * std::log(static_cast<double>(count)) +
               2.0 * std::log(std::max(hypothesis.tests, 1.0));
  if (!hypothesis.effect) return sum;
  const auto names = linear_parameters(hypothesis.effect->term, hypothesis.shape);
  double worst = 0.0, pair = 0.0;
  for (Eigen::Index j = 0; j < coefficients.size(); ++j) {
    if (hypothesis.with_radial && j >= coefficients.size() - 2) break;
    const std::size_t place = hypothesis.free.empty()
                                  ? static_cast<std::size_t>(j)
                                  : hypothesis.free[static_cast<std::size_t>(j)];
    const double high = typical_high(*hypothesis.effect, hypothesis.shape, names[place].name);
    const bool second = names[place].name.ends_with("_sin");
    pair = second ? std::hypot(pair, coefficients(j)) : std::abs(coefficients(j));
    if (high > 0.0 && pair > generous * high)
      worst = std::max(worst, std::log(pair / (generous * high)));
  }
  if (hypothesis.effect->id == "part.chuck_lobing" && coefficients.size() == 4) {
    const double first = std::hypot(coefficients(0), coefficients(1));
    const double second = std::hypot(coefficients(2), coefficients(3));
    if (second > most_second * first)
      sum +=
          16.0 * surprise * std::pow(std::log(second / (most_second * std::max(first, 1e-12))), 2);
  }
  return sum + surprise * worst * worst;
}

}  // namespace trueaxis::diagnose_detail

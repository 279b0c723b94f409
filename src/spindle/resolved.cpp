// SPDX-License-Identifier: Apache-2.0
#include "spindle/resolved.hpp"

#include <algorithm>
#include <boost/random/gamma_distribution.hpp>
#include <boost/random/mersenne_twister.hpp>
#include <boost/random/normal_distribution.hpp>
#include <boost/random/uniform_01.hpp>
#include <cmath>

namespace trueaxis {
namespace {

using Complex = std::complex<double>;
using Eigen::Index;

constexpr int chain_draws = 500, burn_in = 100;  // u to 3 %
constexpr std::uint64_t chain_seed = 230'7;
constexpr double rounding = 1e-300;  // a share is more than 0

/// A Gibbs sampler of one series: turns of the angles, size and amplitudes of every order, shares.
class Chain {
 public:
  explicit Chain(const UncertainSeries& series) : series_(series) {
    double least = 0.0, largest = 0.0;
    for (std::size_t n = 0; n < series.harmonics.size(); ++n) {
      const double u = series.u_mm[n];
      if (u > 0.0) least = least > 0.0 ? std::min(least, u) : u;
      largest = std::max({largest, u, std::abs(series.harmonics[n])});
    }
    squares_.push_back(0.0);
    if (least > 0.0)
      for (double size = 0.5 * least; size < 2.0 * largest; size *= 2.0)
        squares_.push_back(size * size);
    shares_.assign(squares_.size(), 1.0 / static_cast<double>(squares_.size()));
  }

  Series sweep() {
    Series drawn = series_.harmonics;
    Eigen::VectorXcd turned(series_.moved_mm.cols());
    for (Complex& one : turned) one = normal_(engine_);
    std::vector<double> counts(shares_.size(), 1.0 / static_cast<double>(shares_.size()));
    for (std::size_t n = 0; n < drawn.size(); ++n) {
      if (series_.moved_mm.cols() > 0)
        drawn[n] -= (series_.moved_mm.row(static_cast<Index>(n)) * turned).value();
      if (!(series_.u_mm[n] > 0.0)) continue;
      drawn[n] += series_.u_not_noise_mm[n] * normal();
      const std::size_t size = size_of(drawn[n], series_.u_mm[n]);
      const double square = squares_[size];
      counts[size] += 1.0;
      const double noise = series_.u_mm[n] * series_.u_mm[n];
      const double kept = square / (noise + square), u = std::sqrt(kept * noise);
      drawn[n] = kept * drawn[n] + u * normal();
    }
    // Dirichlet, but for the sum, by which the draw of a size divides.
    for (std::size_t k = 0; k < counts.size(); ++k)
      shares_[k] = boost::random::gamma_distribution<double>(counts[k])(engine_);
    return drawn;
  }

 private:
  /// Drawn by the evidence of each, 0: the order is absent.
  std::size_t size_of(Complex z, double u) {
    const double noise = u * u, power = 0.5 * std::norm(z);
    sums_.clear();
    double sum = 0.0;
    for (std::size_t k = 0; k < squares_.size(); ++k) {
      // exp(power/(noise + largest) − power/(noise + τ²)) is at most 1: nothing overflows.
      const double variance = noise + squares_[k];
      const double off = power / (noise + squares_.back()) - power / variance;
      sums_.push_back(sum += (shares_[k] + rounding) * std::exp(off) / variance);
    }
    const double at = uniform_(engine_) * sum;
    const auto size = std::ranges::upper_bound(sums_, at) - sums_.begin();
    return std::min(static_cast<std::size_t>(size), squares_.size() - 1);
  }
  Complex normal() {
    const double real = normal_(engine_);
    return {real, normal_(engine_)};
  }

  const UncertainSeries& series_;
  std::vector<double> squares_;  ///< τ²: 0, then from half the least u on in steps of 4
  std::vector<double> shares_;   ///< of orders of each size, up to a factor
  std::vector<double> sums_;
  boost::random::mt19937_64 engine_{chain_seed};
  boost::random::normal_distribution<double> normal_;
  boost::random::uniform_01<double> uniform_;
};

}  // namespace

ResolvedSeries resolve(const UncertainSeries& series) {
  Chain chain(series);
  for (int sweep = 0; sweep < burn_in; ++sweep) chain.sweep();
  ResolvedSeries out;
  out.mean.assign(series.harmonics.size(), 0.0);
  for (int draw = 0; draw < chain_draws; ++draw) {
    out.drawn.push_back(chain.sweep());
    for (std::size_t n = 0; n < out.mean.size(); ++n)
      out.mean[n] += out.drawn.back()[n] / static_cast<double>(chain_draws);
  }
  return out;
}

}  // namespace trueaxis

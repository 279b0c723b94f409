// SPDX-License-Identifier: Apache-2.0
#include "spindle/resolved.hpp"

#include <algorithm>
#include <boost/random/beta_distribution.hpp>
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

/// A Gibbs sampler of one series: turns of the angles, state and amplitudes of every order, share.
class Chain {
 public:
  explicit Chain(const UncertainSeries& series) : series_(series) {
    double least = 0.0, largest = 0.0;
    for (std::size_t n = 0; n < series.harmonics.size(); ++n) {
      const double u = series.u_mm[n];
      if (u > 0.0) least = least > 0.0 ? std::min(least, u) : u;
      largest = std::max({largest, u, std::abs(series.harmonics[n])});
    }
    if (least > 0.0)
      for (double size = 0.5 * least; size < 2.0 * largest; size *= 2.0)
        squares_.push_back(size * size);
  }

  Series sweep() {
    Series drawn = series_.harmonics;
    Eigen::VectorXcd turned(series_.moved_mm.cols());
    for (Complex& one : turned) one = normal_(engine_);
    int present = 0, orders = 0;
    for (std::size_t n = 0; n < drawn.size(); ++n) {
      if (series_.moved_mm.cols() > 0)
        drawn[n] -= (series_.moved_mm.row(static_cast<Index>(n)) * turned).value();
      if (!(series_.u_mm[n] > 0.0)) continue;
      drawn[n] += series_.u_not_noise_mm[n] * normal();
      const double square = size_of(drawn[n], series_.u_mm[n]);
      const double noise = series_.u_mm[n] * series_.u_mm[n];
      const double kept = square / (noise + square), u = std::sqrt(kept * noise);
      drawn[n] = kept * drawn[n] + u * normal();
      present += square > 0.0;
      ++orders;
    }
    share_ =
        boost::random::beta_distribution<double>(1.0 + present, 1.0 + orders - present)(engine_);
    return drawn;
  }

 private:
  /// τ² of a state drawn by its evidence, 0: the order is absent.
  double size_of(Complex z, double u) {
    const double noise = u * u, power = 0.5 * std::norm(z);
    // exp(power/(noise + τ²) − power/noise) is at most 1: nothing overflows.
    const auto evidence = [&](double square) {
      return std::exp(power / (noise + largest()) - power / (noise + square)) / (noise + square);
    };
    sums_.assign(1, (1.0 - share_) * evidence(0.0));
    for (const double square : squares_)
      sums_.push_back(sums_.back() +
                      share_ / static_cast<double>(squares_.size()) * evidence(square));
    const double at = uniform_(engine_) * sums_.back();
    const auto state =
        static_cast<std::size_t>(std::ranges::upper_bound(sums_, at) - sums_.begin());
    return state == 0 ? 0.0 : squares_[std::min(state, squares_.size()) - 1];
  }
  Complex normal() {
    const double real = normal_(engine_);
    return {real, normal_(engine_)};
  }
  double largest() const { return squares_.back(); }

  const UncertainSeries& series_;
  std::vector<double> squares_,
      sums_;            ///< τ², from half the least u on, each four times that before
  double share_ = 0.5;  ///< of orders that are there
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

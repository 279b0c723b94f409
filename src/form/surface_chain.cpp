// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <boost/random/gamma_distribution.hpp>
#include <boost/random/mersenne_twister.hpp>
#include <boost/random/normal_distribution.hpp>
#include <boost/random/uniform_01.hpp>
#include <cmath>
#include <utility>

#include "base/stop.hpp"
#include "form/order_evidence.hpp"
#include "form/surface_model.hpp"
#include "form/surface_order.hpp"
#include "math/exponential.hpp"
#include "math/linear_algebra.hpp"

namespace trueaxis::form {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int warm_up = 240, sweeps_a_draw = 5;
/// An order may be absent, the same along Z, or changing: Dirichlet numbers of their shares.
enum State { absent, constant, changing };
constexpr std::array<double, 3> prior_counts{2.0, 1.0, 1.0};
constexpr double least_size_over_u = 0.5, size_step = 2.0;
constexpr int most_sizes = 30;
/// Orders that were not found are looked at in one sweep of so many: in the warm-up after its first
/// quarter, and after it.
constexpr int seldom_at_first = 4, seldom = 8;
constexpr std::size_t most_to_begin = 8;
constexpr double least_to_begin = 8.0;  // of the logarithm of the evidence

class Chain {
 public:
  Chain(const SurfaceTerms& terms, SurfaceSums sums, const ChainOptions& options)
      : engine_(options.seed),
        least_variance_(options.least_noise_mm * options.least_noise_mm),
        count_(static_cast<double>(sums.count)) {
    take_out_base(terms, sums);
    for (int n = 0; n <= terms.orders; ++n) {
      const int first = n < 2 ? 2 : 0, last = terms.degrees_of(n);
      if (first > last) continue;
      const Index begin = terms.column(n, first);
      const Index size = (last - first + 1) * SurfaceTerms::width(n);
      orders_.emplace_back(n, first, last, begin, normal_.block(begin, begin, size, size));
    }
    state_.assign(orders_.size(), absent);
    found_.assign(orders_.size(), false);
    value_ = VectorXd::Zero(terms.size());
    rounding_ = 1e-22 * (sums.squares[0] / count_ + 1e-30);
    variance_ = std::max({squares_ / count_, least_variance_, rounding_});
    make_sizes();
    begin_by_largest();
    for (int sweep = 0; sweep < warm_up; ++sweep) {
      const bool first_quarter = 4 * sweep < warm_up;
      renew_all(sweep, first_quarter ? 1 : seldom_at_first);
      for (std::size_t at = 0; !first_quarter && at < orders_.size(); ++at)
        if (state_[at] != absent) found_[at] = true;
      if (sweep == warm_up / 4 || sweep == warm_up / 2) make_sizes();
    }
  }

  void renew_all(int sweep, int every) {
    for (std::size_t at = 0; at < orders_.size(); ++at)
      if (found_[at] || (sweep + orders_[at].order()) % every == 0) renew(at);
    renew_shares();
    renew_noise();
  }

  /// All coefficients, with a draw of radius, cone and axis.
  VectorXd draw() {
    VectorXd out = value_;
    VectorXd base = base_right_;
    for (std::size_t at = 0; at < orders_.size(); ++at)
      if (state_[at] != absent)
        base -= base_rows_.middleCols(orders_[at].column(), orders_[at].size()) *
                value_.segment(orders_[at].column(), orders_[at].size());
    const VectorXd z = normal_numbers(base.size());
    base = base_inverse_ * base + std::sqrt(variance_) * (base_root_ * z);
    for (std::size_t i = 0; i < base_columns_.size(); ++i)
      out[base_columns_[i]] = base[static_cast<Index>(i)];
    return out;
  }
  double noise_mm() const { return std::sqrt(variance_); }
  bool has(int order) const {
    for (std::size_t at = 0; at < orders_.size(); ++at)
      if (orders_[at].order() == order) return state_[at] != absent;
    return false;
  }

 private:
  /// What radius, cone and axis leave of every column.
  void take_out_base(const SurfaceTerms& terms, SurfaceSums& sums) {
    for (int n = 0; n <= 1; ++n)
      for (int d = 0; d <= 1; ++d)
        for (int w = 0; w < SurfaceTerms::width(n); ++w)
          base_columns_.push_back(terms.column(n, d) + w);
    const auto m = static_cast<Index>(base_columns_.size());
    MatrixXd square(m, m);
    base_rows_.resize(m, terms.size());
    base_right_.resize(m);
    for (Index i = 0; i < m; ++i) {
      const Index at = base_columns_[static_cast<std::size_t>(i)];
      base_rows_.row(i) = sums.normal.row(at);
      base_right_[i] = sums.right(at, 0);
      for (Index j = 0; j < m; ++j)
        square(i, j) = sums.normal(at, base_columns_[static_cast<std::size_t>(j)]);
    }
    base_inverse_ = linear::inverse_of_normal(square);
    base_root_ = linear::Cholesky(base_inverse_).lower();
    const MatrixXd by_base = linear::product(base_inverse_, base_rows_);
    normal_ = std::move(sums.normal);
    normal_ -= linear::transposed_product(base_rows_, by_base);
    right_ = sums.right.col(0) - by_base.transpose() * base_right_;
    squares_ = sums.squares[0] - base_right_.dot(base_inverse_ * base_right_);
  }

  /// Variances of the coefficients of an order that is there: from what is half their u to all that
  /// the readings vary, equally probable in the logarithm.
  void make_sizes() {
    const double least = 2.0 * least_size_over_u * least_size_over_u * variance_ / count_;
    const double most = std::max(4.0 * squares_ / count_, 16.0 * least);
    double step = size_step * size_step;
    while (std::log(most / least) / std::log(step) > most_sizes) step *= size_step;
    sizes_.clear();
    for (double size = least; size < most * step; size *= step) sizes_.push_back(size);
    make_gain();
  }

  void make_gain() {
    gain_.assign((sizes_.size() + sizes_at_once - 1) / sizes_at_once * sizes_at_once, 0.0);
    for (std::size_t k = 0; k < sizes_.size(); ++k) gain_[k] = sizes_[k] / variance_;
  }

  double uniform() { return uniform_(engine_); }
  VectorXd normal_numbers(Index count) {
    VectorXd out(count);
    for (double& one : out) one = gauss_(engine_);
    return out;
  }

  /// The chain begins with the orders that explain most, one after the other: of two that look
  /// alike at these angles the first to come would otherwise stay.
  void begin_by_largest() {
    for (std::size_t round = 0; round < most_to_begin; ++round) {
      double largest = 0.0;
      std::size_t which = orders_.size();
      for (std::size_t at = 0; at < orders_.size(); ++at) {
        if (state_[at] != absent) continue;
        orders_[at].evidence(without_others(at), variance_, gain_, evidence_);
        if (evidence_.maxCoeff() <= largest) continue;
        largest = evidence_.maxCoeff();
        which = at;
      }
      if (largest < least_to_begin) return;
      renew(which);
      renew_noise();
    }
  }

  /// Aᵀy of an order's columns without all others.
  VectorXd without_others(std::size_t at) const {
    const Index begin = orders_[at].column(), size = orders_[at].size();
    VectorXd out = right_.segment(begin, size);
    for (std::size_t other = 0; other < orders_.size(); ++other) {
      if (other == at || state_[other] == absent) continue;
      const Index from = orders_[other].column(), count = orders_[other].size();
      const auto between = normal_.block(from, begin, count, size);
      out.noalias() -= between.transpose().lazyProduct(value_.segment(from, count));
    }
    return out;
  }

  /// State, course, size and coefficients of an order by what all others leave. Eq. 320.
  void renew(std::size_t at) {
    const SurfaceOrder& order = orders_[at];
    const VectorXd right = without_others(at);
    order.evidence(right, variance_, gain_, evidence_);
    const auto sizes = static_cast<Index>(sizes_.size());
    const double largest = std::max(0.0, evidence_.maxCoeff());
    evidence_.array() -= largest;
    const std::span<double> all(evidence_.data(), static_cast<std::size_t>(evidence_.size()));
    exponential(all, all);
    evidence_ /= static_cast<double>(sizes);
    evidence_.bottomRows(evidence_.rows() - sizes).setZero();
    const Index steady = order.first_is_constant() ? 1 : 0;
    const Index others = evidence_.cols() - steady;
    if (steady) evidence_.col(0) *= share_of_state_[constant];
    evidence_.rightCols(others) *= share_of_state_[changing] / static_cast<double>(others);
    const double none = share_of_state_[absent] * std::exp(-largest);
    double left = uniform() * (none + evidence_.sum()) - none;
    auto value = value_.segment(order.column(), order.size());
    value.setZero();
    state_[at] = absent;
    if (left < 0.0) return;
    Index course = 0, k = 0;
    for (Index one = 0; one < sizes * order.courses() && left >= 0.0; ++one) {
      course = one % order.courses();
      k = one / order.courses();
      left -= evidence_(k, course);
    }
    state_[at] = course < steady ? constant : changing;
    value = order.draw(right, variance_, course, sizes_[static_cast<std::size_t>(k)],
                       normal_numbers(order.size()));
  }

  void renew_shares() {
    std::array<double, 3> counts = prior_counts;
    for (const State state : state_) counts[state] += 1.0;
    double sum = 0.0;
    for (std::size_t k = 0; k < counts.size(); ++k) {
      share_of_state_[k] =
          boost::random::gamma_distribution<double>(counts[k], 1.0)(engine_) + 1e-9;
      sum += share_of_state_[k];
    }
    for (double& one : share_of_state_) one /= sum;
  }

  void renew_noise() {
    double explained = 0.0;
    for (std::size_t at = 0; at < orders_.size(); ++at) {
      if (state_[at] == absent) continue;
      const Index begin = orders_[at].column(), size = orders_[at].size();
      const auto value = value_.segment(begin, size);
      explained += value.dot(right_.segment(begin, size) + without_others(at) -
                             normal_.block(begin, begin, size, size) * value);
    }
    const double rest = std::max(squares_ - explained, rounding_ * count_);
    const double half = 0.5 * (count_ - static_cast<double>(base_columns_.size()));
    const double gamma = boost::random::gamma_distribution<double>(half, 1.0)(engine_);
    variance_ = std::max(0.5 * rest / gamma, least_variance_);
    make_gain();
  }

  boost::random::mt19937_64 engine_;
  boost::random::normal_distribution<double> gauss_;
  boost::random::uniform_01<double> uniform_;
  double least_variance_, count_, squares_ = 0.0, rounding_ = 0.0, variance_ = 0.0;
  std::vector<Index> base_columns_;
  MatrixXd base_rows_, base_inverse_, base_root_, normal_, evidence_;
  VectorXd base_right_, right_, value_;
  std::vector<SurfaceOrder> orders_;
  std::vector<State> state_;
  std::vector<bool> found_;
  std::vector<double> sizes_, gain_;  ///< τ², and τ²/σ² padded
  std::array<double, 3> share_of_state_{0.9, 0.05, 0.05};
};

}  // namespace

SurfacePosterior sample_surface(const SurfaceTerms& terms, SurfaceSums sums,
                                const ChainOptions& options) {
  Chain chain(terms, std::move(sums), options);
  SurfacePosterior out;
  out.coefficients.resize(terms.size(), options.draws);
  out.order_is_there = VectorXd::Zero(terms.orders + 1);
  for (int draw = 0; draw < options.draws; ++draw) {
    stop_if_asked();
    for (int k = 0; k < sweeps_a_draw; ++k) chain.renew_all(sweeps_a_draw * draw + k, seldom);
    out.coefficients.col(draw) = chain.draw();
    out.noise_mm.push_back(chain.noise_mm());
    for (int n = 0; n <= terms.orders; ++n)
      out.order_is_there[n] += chain.has(n) ? 1.0 / options.draws : 0.0;
  }
  return out;
}

}  // namespace trueaxis::form

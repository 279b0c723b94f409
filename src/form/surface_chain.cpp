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
constexpr std::size_t most_local = 6;
constexpr int turns_of_places = 2;

class Chain {
 public:
  Chain(const SurfaceTerms& terms, const SurfaceData& data, const ChainOptions& options)
      : terms_(terms),
        data_(data),
        search_(terms, data),
        engine_(options.seed),
        least_variance_(options.least_noise_mm * options.least_noise_mm),
        count_(static_cast<double>(data.t.size())) {
    const std::vector<double> height_mm(data.height_mm.begin(), data.height_mm.end());
    SurfaceSums sums = surface_sums(terms, data.angle_rad, data.t, {&height_mm, 1});
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
      if (found_[at] || (sweep + static_cast<int>(at)) % every == 0) renew(at);
    renew_shares();
    renew_noise();
  }

  /// All coefficients, with a draw of radius, cone and axis.
  VectorXd draw() {
    const VectorXd z = normal_numbers(base_right_.size());
    return with_base(std::sqrt(variance_) * (base_root_ * z));
  }
  const std::vector<LocalForm>& local() const { return local_; }
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

  /// @param off of radius, cone and axis from what fits best with all else
  VectorXd with_base(const VectorXd& off) const {
    VectorXd out = value_;
    VectorXd base = base_right_;
    for (std::size_t at = 0; at < orders_.size(); ++at)
      if (state_[at] != absent)
        base -= base_rows_.middleCols(orders_[at].column(), orders_[at].size()) *
                value_.segment(orders_[at].column(), orders_[at].size());
    base = base_inverse_ * base + off;
    for (std::size_t i = 0; i < base_columns_.size(); ++i)
      out[base_columns_[i]] = base[static_cast<Index>(i)];
    return out;
  }

  /// The columns of a local form in the place of another or after all: less what radius, cone and
  /// axis leave of them.
  void put_local(std::size_t place, const LocalForm& form) {
    constexpr Index own = LocalForm::columns;
    const Index begin = terms_.size() + own * static_cast<Index>(place);
    if (place == local_.size()) {
      local_.push_back(form);
      normal_.conservativeResize(begin + own, begin + own);
      base_rows_.conservativeResize(Eigen::NoChange, begin + own);
      right_.conservativeResize(begin + own);
      value_.conservativeResize(begin + own);
      state_.push_back(absent);
      found_.push_back(true);
    }
    local_[place] = form;
    const Index all = value_.size();
    std::vector<std::vector<double>> columns(own);
    MatrixXd raw = MatrixXd::Zero(all, own);
    VectorXd right = VectorXd::Zero(own);
    for (std::size_t i = 0; i < data_.t.size(); ++i) {
      const double angle = data_.angle_rad[i], t = data_.t[i];
      const LocalForm::Row row = form.at(angle, t);
      for (Index k = 0; k < own; ++k) columns[static_cast<std::size_t>(k)].push_back(row[k]);
      right += data_.height_mm[i] * row.transpose();
      Index from = terms_.size();
      for (const LocalForm& one : local_) {
        raw.middleRows(from, own) += one.at(angle, t).transpose() * row;
        from += own;
      }
    }
    raw.topRows(terms_.size()) = surface_right(terms_, data_.angle_rad, data_.t, columns);
    MatrixXd of_base(static_cast<Index>(base_columns_.size()), own);
    for (std::size_t i = 0; i < base_columns_.size(); ++i)
      of_base.row(static_cast<Index>(i)) = raw.row(base_columns_[i]);
    base_rows_.middleCols(begin, own) = of_base;
    const MatrixXd by_base = base_inverse_ * of_base;
    raw -= base_rows_.transpose() * by_base;
    normal_.middleCols(begin, own) = raw;
    normal_.middleRows(begin, own) = raw.transpose();
    right_.segment(begin, own) = right - by_base.transpose() * base_right_;
    const SurfaceOrder block(begin, raw.middleRows(begin, own), search_.log_tests());
    const std::size_t at =
        orders_.size() - local_.size() + place + (orders_.size() < state_.size());
    if (at == orders_.size())
      orders_.push_back(block);
    else
      orders_[at] = block;
  }

  void clear() {
    std::ranges::fill(state_, absent);
    value_.setZero();
    variance_ = std::max({squares_ / count_, least_variance_, rounding_});
    make_gain();
  }

  /// The chain begins with what explains most, one after the other: of two orders that look alike
  /// at these angles the first to come would otherwise stay. A local form that explains more than
  /// any order is a term. Its place depends on the orders, and they on it: both are found in turn.
  void begin_by_largest() {
    while (const auto found = begin_with_orders(local_.size() < most_local)) {
      put_local(local_.size(), *found);
      for (int turn = 0; turn < turns_of_places; ++turn) {
        clear();
        begin_with_orders(false);
        const VectorXd all = with_base(VectorXd::Zero(base_right_.size()));
        for (std::size_t k = 0; k < local_.size(); ++k) {
          VectorXd others = all;
          others
              .segment<LocalForm::columns>(terms_.size() +
                                           LocalForm::columns * static_cast<Index>(k))
              .setZero();
          const LocalForm refined = search_.refined(local_, others, k);
          if (refined.differs(local_[k])) put_local(k, refined);
        }
      }
      clear();
    }
  }

  /// @return a local form that explains more than any order, if it is looked for
  std::optional<LocalForm> begin_with_orders(bool look) {
    for (std::size_t round = 0; round < most_to_begin; ++round) {
      double largest = least_to_begin;
      std::size_t which = orders_.size();
      for (std::size_t at = 0; at < orders_.size(); ++at) {
        if (state_[at] != absent) continue;
        orders_[at].evidence(without_others(at), variance_, gain_, evidence_);
        if (evidence_.maxCoeff() <= largest) continue;
        largest = evidence_.maxCoeff();
        which = at;
      }
      if (look) {
        const auto found =
            search_.best(local_, with_base(VectorXd::Zero(base_right_.size())), variance_);
        if (found && found->log_evidence > largest) return found->form;
      }
      if (which == orders_.size()) return {};
      renew(which);
      renew_noise();
    }
    return {};
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

  const SurfaceTerms& terms_;
  SurfaceData data_;
  LocalFormSearch search_;
  boost::random::mt19937_64 engine_;
  boost::random::normal_distribution<double> gauss_;
  boost::random::uniform_01<double> uniform_;
  double least_variance_, count_, squares_ = 0.0, rounding_ = 0.0, variance_ = 0.0;
  std::vector<Index> base_columns_;
  MatrixXd base_rows_, base_inverse_, base_root_, normal_, evidence_;
  VectorXd base_right_, right_, value_;
  std::vector<SurfaceOrder> orders_;  ///< and after them the local forms
  std::vector<LocalForm> local_;
  std::vector<State> state_;
  std::vector<bool> found_;
  std::vector<double> sizes_, gain_;  ///< τ², and τ²/σ² padded
  std::array<double, 3> share_of_state_{0.9, 0.05, 0.05};
};

}  // namespace

SurfacePosterior sample_surface(const SurfaceTerms& terms, const SurfaceData& data,
                                const ChainOptions& options) {
  Chain chain(terms, data, options);
  SurfacePosterior out;
  out.local = chain.local();
  out.coefficients.resize(terms.size() + LocalForm::columns * static_cast<Index>(out.local.size()),
                          options.draws);
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

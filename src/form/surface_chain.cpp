// SPDX-License-Identifier: Apache-2.0
#include "form/surface_chain.hpp"

#include <algorithm>
#include <array>
#include <boost/random/gamma_distribution.hpp>
#include <boost/random/mersenne_twister.hpp>
#include <boost/random/normal_distribution.hpp>
#include <boost/random/uniform_01.hpp>
#include <cmath>
#include <optional>
#include <utility>

#include "base/stop.hpp"
#include "math/linear_algebra.hpp"

namespace trueaxis::form {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// One order of a surface, a Gaussian process along Z: h_n = τ Σ_d √w_d f_d z_d, z normal. The
/// course w and the size τ are those of a list, by their evidence. Eq. 320.
class SurfaceOrder {
 public:
  /// @param normal AᵀA of the order's own columns
  SurfaceOrder(int order, int first_degree, int degrees, Eigen::Index column,
               Eigen::MatrixXd normal);

  int order() const { return order_; }
  Eigen::Index column() const { return column_; }
  Eigen::Index size() const { return normal_.rows(); }
  const Eigen::MatrixXd& normal() const { return normal_; }
  std::size_t courses() const { return weights_.size(); }
  bool first_is_constant() const { return first_degree_ == 0; }

  /// ln of the density of Aᵀy with each course and size over that without the order: a row a
  /// course. @param right Aᵀy of the order's columns without all else
  void evidence(const Eigen::VectorXd& right, double variance, const std::vector<double>& sizes,
                Eigen::MatrixXd& out) const;

  /// The coefficients by a course and a size (τ²) and as many normal numbers as `size()`.
  Eigen::VectorXd draw(const Eigen::VectorXd& right, double variance, std::size_t course,
                       double size, const Eigen::VectorXd& normal_numbers) const;

 private:
  /// √w AᵀA √w = V diag(λ) Vᵀ, of the columns whose w is not 0.
  struct System {
    Eigen::VectorXd values;
    Eigen::MatrixXd back;  ///< √w V: from coordinates to coefficients; its transpose the other way
  };
  const System& system(std::size_t course) const;

  int order_, first_degree_;
  Eigen::Index column_;
  Eigen::MatrixXd normal_;
  std::vector<Eigen::VectorXd> weights_;  ///< of the columns
  mutable std::vector<std::optional<System>> systems_;
};

constexpr double reaches[] = {0.3, 1.5, 4.0, 8.0};  // degrees that a course holds; 0.3: a line
constexpr double shares[] = {0.1, 2.0};             // of what changes, over what stays
constexpr double least_weight = 1e-4;

/// How an order's size may run along Z: variances of its degrees over that of the first. The first
/// of these is an order that is the same at every Z. Eq. 319.
std::vector<Eigen::VectorXd> courses_along_z(int first_degree, int degrees) {
  std::vector<Eigen::VectorXd> out;
  if (first_degree == 0) out.push_back(Eigen::VectorXd::Unit(degrees + 1, 0));
  const int changing = std::max(1, first_degree);
  for (const double share : shares) {
    for (const double reach : reaches) {
      Eigen::VectorXd weight = Eigen::VectorXd::Zero(degrees + 1);
      if (first_degree == 0) weight[0] = 1.0;
      for (int d = changing; d <= degrees; ++d) {
        const double off = (d - changing) / reach;
        weight[d] = (first_degree == 0 ? share : 1.0) * std::exp(-off * off);
        if (weight[d] < least_weight) weight[d] = 0.0;
      }
      out.push_back(weight);
      if (reach >= degrees) break;
    }
    if (first_degree > 0) break;
  }
  return out;
}

SurfaceOrder::SurfaceOrder(int order, int first_degree, int degrees, Eigen::Index column,
                           Eigen::MatrixXd normal)
    : order_(order), first_degree_(first_degree), column_(column), normal_(std::move(normal)) {
  const int width = SurfaceTerms::width(order);
  for (const Eigen::VectorXd& one : courses_along_z(first_degree, degrees)) {
    Eigen::VectorXd weight(size());
    for (Eigen::Index i = 0; i < size(); ++i) weight[i] = one[first_degree + i / width];
    weights_.push_back(weight);
  }
  systems_.resize(weights_.size());
}

const SurfaceOrder::System& SurfaceOrder::system(std::size_t course) const {
  if (systems_[course]) return *systems_[course];
  const Eigen::VectorXd root = weights_[course].cwiseSqrt();
  std::vector<Eigen::Index> there;
  for (Eigen::Index i = 0; i < size(); ++i)
    if (root[i] > 0.0) there.push_back(i);
  const auto m = static_cast<Eigen::Index>(there.size());
  Eigen::MatrixXd scaled(m, m);
  for (Eigen::Index i = 0; i < m; ++i)
    for (Eigen::Index j = 0; j < m; ++j) {
      const Eigen::Index a = there[static_cast<std::size_t>(i)],
                         b = there[static_cast<std::size_t>(j)];
      scaled(i, j) = root[a] * normal_(a, b) * root[b];
    }
  linear::Spectrum spectrum = linear::spectrum(scaled);
  System out{spectrum.values.cwiseMax(0.0), Eigen::MatrixXd::Zero(size(), m)};
  for (Eigen::Index i = 0; i < m; ++i) {
    const Eigen::Index a = there[static_cast<std::size_t>(i)];
    out.back.row(a) = root[a] * spectrum.vectors.row(i);
  }
  systems_[course] = std::move(out);
  return *systems_[course];
}

void SurfaceOrder::evidence(const Eigen::VectorXd& right, double variance,
                            const std::vector<double>& sizes, Eigen::MatrixXd& out) const {
  out.resize(static_cast<Eigen::Index>(courses()), static_cast<Eigen::Index>(sizes.size()));
  const Eigen::ArrayXd gain = Eigen::Map<const Eigen::ArrayXd>(sizes.data(), out.cols()) / variance;
  Eigen::ArrayXd grown(gain.size()), square(gain.size()), product(gain.size());
  Eigen::ArrayXd log_product(gain.size());
  for (std::size_t course = 0; course < courses(); ++course) {
    const System& in = system(course);
    const Eigen::VectorXd seen = in.back.transpose() * right;
    square.setZero(), product.setOnes(), log_product.setZero();
    for (Eigen::Index j = 0; j < seen.size(); ++j) {
      grown = 1.0 + gain * in.values[j];
      square += seen[j] * seen[j] / grown;
      product *= grown;
      if (product[product.size() - 1] > 1e200) {  // that of the largest size
        log_product += product.log();
        product.setOnes();
      }
    }
    out.row(static_cast<Eigen::Index>(course)) =
        0.5 * (gain / variance * square - log_product - product.log());
  }
}

Eigen::VectorXd SurfaceOrder::draw(const Eigen::VectorXd& right, double variance,
                                   std::size_t course, double size,
                                   const Eigen::VectorXd& normal_numbers) const {
  const System& in = system(course);
  Eigen::VectorXd at = in.back.transpose() * right;
  const double tau = std::sqrt(size);
  for (Eigen::Index j = 0; j < at.size(); ++j) {
    const double precision = 1.0 + size / variance * in.values[j];
    at[j] = tau / variance * at[j] / precision + normal_numbers[j] / std::sqrt(precision);
  }
  return tau * (in.back * at);
}

constexpr int warm_up = 240, sweeps_a_draw = 5;
/// An order may be absent, the same along Z, or changing: Dirichlet numbers of their shares.
enum State { absent, constant, changing };
constexpr std::array<double, 3> prior_counts{2.0, 1.0, 1.0};
constexpr double least_size_over_u = 0.5, size_step = 2.0;
constexpr int most_sizes = 30;
/// Orders that the warm-up did not find are looked at in one sweep of so many.
constexpr int seldom = 8;
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
    found_.assign(orders_.size(), 0);
    value_ = VectorXd::Zero(terms.size());
    rounding_ = 1e-22 * (sums.squares / count_ + 1e-30);
    variance_ = std::max({squares_ / count_, least_variance_, rounding_});
    make_sizes();
    begin_by_largest();
    for (int sweep = 0; sweep < warm_up; ++sweep) {
      for (std::size_t at = 0; at < orders_.size(); ++at) {
        renew(at);
        if (2 * sweep > warm_up && state_[at] != absent) ++found_[at];
      }
      renew_shares();
      renew_noise();
      if (sweep == warm_up / 4 || sweep == warm_up / 2) make_sizes();
    }
  }

  void sweep(int number) {
    for (std::size_t at = 0; at < orders_.size(); ++at)
      if (found_[at] > 0 || (number + orders_[at].order()) % seldom == 0) renew(at);
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
      base_right_[i] = sums.right[at];
      for (Index j = 0; j < m; ++j)
        square(i, j) = sums.normal(at, base_columns_[static_cast<std::size_t>(j)]);
    }
    base_inverse_ = linear::inverse_of_normal(square);
    base_root_ = linear::Cholesky(base_inverse_).lower();
    const MatrixXd by_base = linear::product(base_inverse_, base_rows_);
    normal_ = std::move(sums.normal);
    normal_ -= linear::transposed_product(base_rows_, by_base);
    left_ = sums.right - by_base.transpose() * base_right_;
    right_ = left_;
    squares_ = sums.squares - base_right_.dot(base_inverse_ * base_right_);
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
        const SurfaceOrder& order = orders_[at];
        order.evidence(left_.segment(order.column(), order.size()), variance_, sizes_, evidence_);
        if (evidence_.maxCoeff() <= largest) continue;
        largest = evidence_.maxCoeff();
        which = at;
      }
      if (largest < least_to_begin) return;
      renew(which);
      renew_noise();
    }
  }

  /// State, course, size and coefficients of an order by what all others leave. Eq. 320.
  void renew(std::size_t at) {
    const SurfaceOrder& order = orders_[at];
    const Index begin = order.column(), size = order.size();
    VectorXd right = left_.segment(begin, size);
    const VectorXd old = value_.segment(begin, size);
    const bool was = state_[at] != absent;
    if (was) right += order.normal() * old;
    order.evidence(right, variance_, sizes_, evidence_);
    const double largest = std::max(0.0, evidence_.maxCoeff());
    evidence_ = (evidence_.array() - largest).exp() / static_cast<double>(sizes_.size());
    const Index steady = order.first_is_constant() ? 1 : 0;
    const Index others = evidence_.rows() - steady;
    if (steady) evidence_.row(0) *= share_of_state_[constant];
    evidence_.bottomRows(others) *= share_of_state_[changing] / static_cast<double>(others);
    const double none = share_of_state_[absent] * std::exp(-largest);
    double left = uniform() * (none + evidence_.sum()) - none;
    VectorXd now = VectorXd::Zero(size);
    state_[at] = absent;
    if (left >= 0.0) {
      Index course = 0, k = 0;
      for (Index one = 0; one < evidence_.size() && left >= 0.0; ++one) {
        course = one % evidence_.rows();
        k = one / evidence_.rows();
        left -= evidence_(course, k);
      }
      state_[at] = course < steady ? constant : changing;
      now = order.draw(right, variance_, static_cast<std::size_t>(course),
                       sizes_[static_cast<std::size_t>(k)], normal_numbers(size));
    }
    if (!was && state_[at] == absent) return;
    left_ -= normal_.middleCols(begin, size) * (now - old);
    value_.segment(begin, size) = now;
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
    const double explained = value_.dot(right_ + left_);
    const double rest = std::max(squares_ - explained, rounding_ * count_);
    const double half = 0.5 * (count_ - static_cast<double>(base_columns_.size()));
    const double gamma = boost::random::gamma_distribution<double>(half, 1.0)(engine_);
    variance_ = std::max(0.5 * rest / gamma, least_variance_);
  }

  boost::random::mt19937_64 engine_;
  boost::random::normal_distribution<double> gauss_;
  boost::random::uniform_01<double> uniform_;
  double least_variance_, count_, squares_ = 0.0, rounding_ = 0.0, variance_ = 0.0;
  std::vector<Index> base_columns_;
  MatrixXd base_rows_, base_inverse_, base_root_, normal_, evidence_;
  VectorXd base_right_, left_, right_, value_;
  std::vector<SurfaceOrder> orders_;
  std::vector<State> state_;
  std::vector<int> found_;
  std::vector<double> sizes_;
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
    for (int k = 0; k < sweeps_a_draw; ++k) chain.sweep(sweeps_a_draw * draw + k);
    out.coefficients.col(draw) = chain.draw();
    out.noise_mm.push_back(chain.noise_mm());
    for (int n = 0; n <= terms.orders; ++n)
      out.order_is_there[n] += chain.has(n) ? 1.0 / options.draws : 0.0;
  }
  return out;
}

}  // namespace trueaxis::form

// SPDX-License-Identifier: Apache-2.0
#include "calibrate/estimate/random_effects.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "math/linear_algebra.hpp"

namespace trueaxis::calibrate_detail {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int most_iterations = 300;
constexpr double settled = 1e-3;  // of ln t and of ln φ, a round

/// The most probable x = ln t of `count` amounts whose squares over s² share add up to `square`. x
/// itself is normal about `centre`: square e^{−2x} − count − (x − centre)/τ² = 0.
double best_log(double count, double square, double centre, double tau) {
  double x = 0.5 * std::log(std::max(square, 1e-300) / count);
  for (int step = 0; step < 50; ++step) {
    const double e = square * std::exp(-2.0 * x), pull = 1.0 / (tau * tau);
    const double move = (e - count - pull * (x - centre)) / (2.0 * e + pull);
    x += std::clamp(move, -1.0, 1.0);
    if (std::abs(move) < 1e-12) break;
  }
  return x;
}

/// Expectation-maximisation over the sizes: amounts over t s √share are standard normal.
class Regressor {
 public:
  Regressor(const VectorXd& residuals, const MatrixXd& fixed, const MatrixXd& random,
            const std::vector<RandomGroup>& groups, bool noise_stated, const SizeSpread& spread)
      : groups_(groups),
        fixed_(fixed.cols()),
        random_(random.cols()),
        equations_(fixed.rows()),
        least_variance_(noise_stated ? 1.0 : 1e-12),
        tau_(std::log(spread.group)),
        tau_all_(std::log(spread.all)),
        logs_(groups.size(), 0.0) {
    MatrixXd all(equations_, fixed_ + random_);
    all << fixed, random;
    unit_ = VectorXd::Ones(all.cols());
    // Fixed columns of length 1 keep the numbers of the normal matrix alike.
    for (Index j = 0; j < fixed_; ++j) unit_[j] = 1.0 / std::max(all.col(j).norm(), 1e-300);
    Index at = fixed_;
    for (const RandomGroup& group : groups)
      for (const double share : group.shares) unit_[at++] = group.size * std::sqrt(share);
    all = linear::scaled_columns(all, unit_);
    products_ = linear::gram(all);
    right_ = linear::transposed_product(all, residuals);
    square_ = residuals.squaredNorm();
    eliminate_fixed();
  }

  RandomEffects run() {
    for (int round = 0; round < most_iterations; ++round) {
      solve_random();
      if (improve() < settled) break;
    }
    RandomEffects out;
    for (const double one : logs_) out.times.push_back(std::exp(one));
    const VectorXd x = scale_after(logs_).cwiseProduct(unit_).cwiseProduct(
        normal_factors().solve(VectorXd(scale_.cwiseProduct(right_) / variance_)));
    out.fixed = x.head(fixed_);
    out.random = x.tail(random_);
    const VectorXd back = scale_after(widened_logs()).cwiseProduct(unit_);
    out.covariance = linear::scaled_both(normal_factors().inverse(), back);
    out.times_all = std::exp(common_);
    out.variance = variance_;
    return out;
  }

 private:
  /// The fixed ones are free at any size of the random ones: their Schur complement stays.
  void eliminate_fixed() {
    const linear::Cholesky factors(products_.topLeftCorner(fixed_, fixed_));
    const MatrixXd lower = factors.lower();
    const MatrixXd cross =
        linear::solve_lower(lower, MatrixXd(products_.topRightCorner(fixed_, random_)));
    const VectorXd along = linear::solve_lower(lower, VectorXd(right_.head(fixed_)));
    beside_ = products_.bottomRightCorner(random_, random_);
    beside_ -= linear::gram(cross);
    right_beside_ = right_.tail(random_) - linear::transposed_product(cross, along);
    square_beside_ = square_ - along.squaredNorm();
  }

  const VectorXd& scale_after(const std::vector<double>& logs) {
    scale_ = VectorXd::Ones(fixed_ + random_);
    Index at = fixed_;
    for (std::size_t g = 0; g < groups_.size(); ++g) {
      scale_.segment(at, groups_[g].shares.size()).setConstant(std::exp(logs[g]));
      at += groups_[g].shares.size();
    }
    return scale_;
  }

  /// N at the scale, in units of it.
  linear::Cholesky normal_factors() const {
    MatrixXd normal = linear::scaled_both(products_, scale_);
    normal /= variance_;
    normal.diagonal().tail(random_).array() += 1.0;
    return linear::Cholesky(normal);
  }

  /// ln t plus its variance, which the readings leave open: E t² is t² exp 2v (Eq. 334).
  std::vector<double> widened_logs() const {
    const double own = tau_ * tau_, all = tau_all_ * tau_all_;
    std::vector<double> seen;  // numbers of a group that the readings show
    double of_common = 1.0 / all;
    Index at = 0;
    for (const RandomGroup& group : groups_) {
      const Index n = group.shares.size();
      seen.push_back(group.known ? 0.0 : static_cast<double>(n) - variances_.segment(at, n).sum());
      of_common += 2.0 * seen.back() / (1.0 + 2.0 * seen.back() * own);
      at += n;
    }
    std::vector<double> logs = logs_;
    for (std::size_t g = 0; g < logs.size(); ++g) {
      if (groups_[g].known) continue;
      const double open = 1.0 / (1.0 + 2.0 * seen[g] * own);
      logs[g] += open * own + open * open / of_common;
    }
    return logs;
  }

  /// Mean and variances of the random ones at the sizes so far.
  void solve_random() {
    const auto scale = scale_after(logs_).tail(random_);
    MatrixXd normal = linear::scaled_both(beside_, scale);
    normal /= variance_;
    normal.diagonal().array() += 1.0;
    const linear::Cholesky factors(normal);
    mean_ = factors.solve(VectorXd(scale.cwiseProduct(right_beside_) / variance_));
    // The diagonal of the inverse L⁻ᵀL⁻¹ alone: columns of L⁻¹, which begin at their own row.
    constexpr Index columns = 16;
    const MatrixXd lower = factors.lower();
    variances_.resize(random_);
    for (Index j = 0; j < random_; j += columns) {
      const Index left = random_ - j, some = std::min(columns, left);
      const MatrixXd part = linear::solve_lower(lower.bottomRightCorner(left, left),
                                                MatrixXd(MatrixXd::Identity(left, some)));
      variances_.segment(j, some) = part.colwise().squaredNorm().transpose();
    }
  }

  /// The sizes that are most probable given these; returns the largest change.
  double improve() {
    const VectorXd x = scale_.tail(random_).cwiseProduct(mean_);
    // tr(P S N⁻¹ S) = σ² (n − Σ of the random ones' variances), as N = S P S/σ² + 1 of these.
    const double spread = variance_ * (static_cast<double>(fixed_ + random_) - variances_.sum());
    const double left = square_beside_ - 2.0 * right_beside_.dot(x) + x.dot(beside_ * x) + spread;
    const double variance = std::max(least_variance_, left / static_cast<double>(equations_));
    double change = std::abs(std::log(variance / variance_)), sum = 0.0, count = 0.0;
    variance_ = variance;
    Index at = 0;
    for (std::size_t g = 0; g < groups_.size(); ++g) {
      const Index n = groups_[g].shares.size();
      const double square = std::exp(2.0 * logs_[g]) *
                            (mean_.segment(at, n).squaredNorm() + variances_.segment(at, n).sum());
      at += n;
      if (groups_[g].known) continue;
      const double next = best_log(static_cast<double>(n), square, common_, tau_);
      change = std::max(change, std::abs(next - logs_[g]));
      logs_[g] = next;
      sum += next;
      count += 1.0;
    }
    common_ = sum / (count + tau_ * tau_ / (tau_all_ * tau_all_));
    return change;
  }

  const std::vector<RandomGroup>& groups_;
  Index fixed_, random_, equations_;
  double least_variance_, tau_, tau_all_;
  std::vector<double> logs_;  ///< ln t
  VectorXd unit_, right_, scale_;
  MatrixXd products_;
  MatrixXd beside_;                           ///< products of the random ones after the fixed
  VectorXd right_beside_, mean_, variances_;  ///< of the random ones
  double square_ = 0.0, square_beside_ = 0.0, variance_ = 1.0, common_ = 0.0;
};

}  // namespace

RandomEffects regress(const VectorXd& residuals, const MatrixXd& fixed, const MatrixXd& random,
                      const std::vector<RandomGroup>& groups, bool noise_stated,
                      const SizeSpread& spread) {
  return Regressor(residuals, fixed, random, groups, noise_stated, spread).run();
}

}  // namespace trueaxis::calibrate_detail

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Dense>
#include <complex>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "math/linear_algebra.hpp"

namespace trueaxis {

/// What repeats with C in the readings of some sensors that read at once, and the covariance of it
/// from what does not.
struct SynchronousPart {
  /// z_n of order n = 0 … for every sensor (rows): the reading holds Re(z_n exp(inC)).
  Eigen::MatrixXcd harmonics;
  /// E[z zᴴ] of order n, sensors by sensors (Eq. 143): from the lines next to it.
  std::vector<Eigen::MatrixXcd> covariance;
  double freedom = 0.0;  ///< complex lines that a covariance is the mean of
  /// E|z|² of noise that all orders have alike, for every sensor: what an order has more is motion.
  Eigen::VectorXd white_mm2;
  /// E|z|² of higher orders that may fold into every order: that of the highest fitted.
  Eigen::VectorXd folded_mm2;
  Eigen::MatrixXd asynchronous_mm;  ///< readings by sensors: less what repeats and the drift
  double free_share = 0.0;          ///< of their freedom that these two have left
};

/// The widest stretch of the revolution without a reading.
struct Gap {
  double from_rad = 0.0, to_rad = 0.0;
};
/// "from C = 50.6° to 101.2° (50.6° of every revolution)".
std::string gap_words(const Gap& gap);

/// Least squares of a Fourier series in C and a drift of third degree (Eq. 142). Sums over readings
/// are non-uniform fast transforms, the normal matrix follows from twice as many of them.
class SynchronousFit {
 public:
  /// @param c_rad running, at least 4 turns. @param wanted highest order asked for.
  SynchronousFit(std::span<const double> c_rad, int wanted);

  /// Highest order that these angles carry: `wanted`, or fewer.
  int order_max() const { return carried_; }
  double turns() const { return turns_; }
  /// The first and the last of the highest eighth of the fitted orders, three at least.
  std::pair<int, int> end_orders() const {
    return {std::max(2, fitted_ + 1 - std::max(fitted_ / 8, 3)), fitted_};
  }

  /// Whether the angles carry fewer orders than as many readings evenly around the revolution do.
  bool cut() const { return cut_; }
  Gap gap() const;
  /// Whether what the fit has left still repeats: more at the same angle than over the turns.
  bool leaves_what_repeats(const SynchronousPart& part) const;

  /// @param columns one for every sensor.
  SynchronousPart operator()(std::span<const std::vector<double>> columns) const;

 private:
  static constexpr int drift = 3;
  bool prepare(int orders);
  Eigen::VectorXd right_side(std::span<const double> column,
                             const std::vector<std::complex<double>>& sums) const;
  std::vector<double> residuals(const std::vector<double>& column,
                                const Eigen::VectorXd& solution) const;
  void add_covariance(SynchronousPart& part) const;
  double folded_mm2(const Eigen::VectorXd& solution, double noise_mm2) const;

  std::vector<double> c_rad_;
  std::vector<std::vector<double>> drift_;  ///< columns P1 … P3 over the order of the readings
  double turns_ = 0.0;
  int wanted_, fitted_ = 0, carried_ = 0;
  bool cut_ = false;
  bool interleaved_ = false;  ///< turns do not repeat their angles: nothing folds
  linear::Cholesky normal_;
  std::vector<double> inflation_;  ///< variance of order n over that of even spacing
};

}  // namespace trueaxis

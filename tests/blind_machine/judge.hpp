// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <map>

#include "blind_machine/bench.hpp"

namespace trueaxis::blind_machine {

/// A term of the contract as faults of size 1 (mm or rad; drift mm over all, slip mm), each a
/// coefficient.
struct Effect {
  std::string name;
  std::vector<Fault> units;
  bool angle = false;
};

inline constexpr double largest_mm = 0.1, largest_rad = 0.2e-3;  ///< plausible sizes
inline constexpr double typical_mm = 0.01, typical_rad = 50e-6;  ///< that matter

/// Coefficients times the units of an effect, in addition to `fault`.
Fault with(const Fault& fault, const Effect& effect, const Eigen::VectorXd& coefficients);

/// Judges by finite differences of the virtual machine alone what a plan shows after location
/// errors and the places of the balls.
class Judge {
 public:
  Judge(const Machine& machine, const Plan& plan);

  const std::vector<Effect>& effects() const { return effects_; }
  /// Columns over σ after the base, per mm or rad.
  const Eigen::MatrixXd& columns(std::size_t effect) const { return columns_[effect]; }
  std::size_t index(const std::string& name) const;

  /// What a fault does to the readings over σ, after the base.
  Eigen::VectorXd effect_of(const Fault& fault) const;
  /// Distance of `mu` from the best fit of an effect, for ball.slip of the best row, after columns
  /// that are fitted as well.
  double distance(const Eigen::VectorXd& mu, const std::string& name,
                  const Eigen::MatrixXd& beside = {}) const;
  /// λ that is left of `mu` after the base and columns.
  static double left(const Eigen::VectorXd& mu, const Eigen::MatrixXd& beside);
  /// λ that the best sum of two effects leaves of `mu`, found one after the other.
  double left_by_two(const Eigen::VectorXd& mu) const;
  /// ball.slip at a visit.
  Eigen::MatrixXd slip_columns(std::size_t visit) const;

 private:
  Eigen::VectorXd over_sigma(const Fault& fault) const;
  Eigen::MatrixXd beside_base(Eigen::MatrixXd columns) const;
  void make_base();

  const Machine& machine_;
  const Plan& plan_;
  Eigen::VectorXd nominal_;
  Eigen::MatrixXd base_;
  std::vector<Effect> effects_;
  std::vector<Eigen::MatrixXd> columns_;
};

}  // namespace trueaxis::blind_machine

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "trueaxis/machine.hpp"

namespace trueaxis {

/// Legendre's polynomial P_degree(2 (q − low)/(high − low) − 1) as an error of size 1.
PolynomialError legendre(int degree, double low, double high);

/// The covariance as a matrix.

/// Adds what is independent of it; of an amount that both have the sum is uncertain.
void add_covariance(ErrorCovariance& all, const ErrorCovariance& more);

/// u of terms whose constant the covariance has goes into it, and nowhere else.
void gather_uncertainty(ErrorModel& errors);

/// Where the tip is uncertain, to first order in all errors about the nominal machine (Eq. 216):
/// by the covariance, and by the u of terms outside of it, each independent of all others.
/// Immutable: threads share it.
class TipUncertainty {
 public:
  explicit TipUncertainty(const MachineModel& model);

  bool stated() const { return !amounts_.empty(); }
  /// Displacements of the tip in the part, mm, a column each of as many independent causes of
  /// standard deviation 1 as there are amounts.
  Eigen::Matrix3Xd causes(const AxisPositions& axes, const Setting& setting) const;
  /// Covariance of the tip in the part, mm².
  Matrix3 covariance_mm2(const AxisPositions& axes, const Setting& setting) const;
  /// The root of its trace: the standard uncertainty of the distance.
  double u_mm(const AxisPositions& axes, const Setting& setting) const;

 private:
  struct Amount {
    std::size_t joint = 0;   ///< in the chain, or after it: spindle, workpiece
    std::size_t column = 0;  ///< of the joint's unit errors
    ErrorFunction function;
  };
  void add(const ErrorName& name, ErrorFunction function);
  Eigen::Matrix3Xd moved(const AxisPositions& axes, const Setting& setting) const;

  MachineModel model_;
  std::vector<Amount> amounts_;  ///< the correlated ones first
  Eigen::MatrixXf root_;         ///< lower L of those, Σ = L Lᵀ; single: U to six digits, fast
  Eigen::VectorXd u_;            ///< of the others
};

}  // namespace trueaxis

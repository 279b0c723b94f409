// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "calibrate/diagnose/search.hpp"
#include "infer/cross_validation.hpp"
#include "trueaxis/machine_diagnosis.hpp"

namespace trueaxis::calibrate_detail {

/// A found term with its sizes beside all others, and its class: the other effects that the data do
/// not tell from it (Eqs. 87-93). Its `rms_mm` is left over σ and summed: |μ|.
MachineFinding finding_of(const Regression& regression, const std::vector<Term>& terms,
                          const Regression::Set& set, std::size_t at, const SearchOptions& options);

/// What tests of the noncentral F distribution find in data (Eq. 182).
class Detection {
 public:
  /// @param variance of a residual over its σ
  Detection(const Regression& regression, double variance, const SearchOptions& options)
      : regression_(regression),
        variance_(variance),
        level_(options.effects().single_level(options.false_alarm)) {}

  /// Size of a term that is found with power one half, mm or rad; infinite: none is.
  double detectable_size(std::size_t term) const;
  /// Power at a size in the phase that is seen least.
  double surely(std::size_t term, double size) const;

 private:
  const Regression& regression_;
  double variance_, level_;
  mutable std::vector<double> half_lambda_;  ///< λ of power one half, for a rank each
};

/// What the base, and base and terms, predict of blocks of rotary positions that were left out, mm
/// (Eqs. 101, 183). @param columns over σ, those of the base first
struct HeldOut {
  infer::CrossValidated rms;
  std::size_t blocks = 0;
};
HeldOut held_out(const Problem& problem, const Eigen::MatrixXd& columns, Eigen::Index base,
                 const Eigen::VectorXd& readings);

}  // namespace trueaxis::calibrate_detail

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "calibrate/diagnose/term.hpp"
#include "calibrate/estimate/tip_fit.hpp"
#include "trueaxis/machine_diagnosis.hpp"

namespace trueaxis::calibrate_detail {

/// What no effect explains, with the amplitude that a calibration of the readings leaves of it.
class Unexplained {
 public:
  Unexplained(const TipFit& fit, const Calibration& counted);

  MachineUnexplained pattern(const Term& term, const MachineFinding& found) const;
  MachineUnexplained scatter(double noise_mm, double freedom, double p) const;

 private:
  double amplitude_of(const Term& term) const;

  const Problem& problem_;
  Eigen::VectorXd residuals_;  ///< over σ
  double variance_;            ///< of one of them
  bool noise_as_stated_;
};

}  // namespace trueaxis::calibrate_detail

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "calibrate/estimate/problem.hpp"

namespace trueaxis::calibrate_detail {

/// An unknown that is held, and those that move the readings as it does.
struct Held {
  std::size_t unknown = 0;
  std::vector<std::size_t> alike;
  bool places = false;  ///< the ball's centre, or the bar's line, is one of them
  double effect = 0.0;  ///< of its largest plausible size, in σ of all readings together
};

struct Determined {
  std::vector<std::size_t> kept;  ///< ascending
  std::vector<Held> held;
};

/// Which unknowns a measurement determines (Eqs. 174, 175). `unknowns` are columns over σ, each
/// times its largest plausible size, the preferred ones first; `places` those that are always
/// fitted, over σ. An unknown is held if less than one σ of it is left after the places and the
/// unknowns before it. Then, while some direction of the others stays below one σ, the last unknown
/// that takes part in it is held. The threshold is absolute. Ball data tell 13 to 19 of 30
/// unknowns, and the rest come back in second order off the nominal ball. A relative threshold
/// would let them swallow whole effects there. @param tells the threshold, σ
Determined determine(const MatrixXd& unknowns, const MatrixXd& places, double tells = 1.0);

/// The least squares estimate of what is determined, and of every place.
struct Solution {
  bool converged = false;
  std::string message;
  Determined determined;
  VectorXd unknowns;  ///< mm and rad; 0 of those that are held
  VectorXd places;
  VectorXd residuals;     ///< over σ
  MatrixXd jacobian;      ///< over σ: the kept unknowns per largest size, then the places
  double variance = 1.0;  ///< of a residual over its σ
  double freedom = 0.0;
};

/// Which unknowns the start tells, then Levenberg-Marquardt through the exact chain (Eq. 176).
Solution solve(const Problem& problem, const ErrorModel& given,
               const std::vector<Unknown>& unknowns);

/// The places that fit best when the machine has `errors`: what is known before.
VectorXd best_places(const Problem& problem, const ErrorModel& errors);

/// Columns of the kept unknowns and the places at a point, over σ.
MatrixXd weighted_jacobian(const Problem& problem, const ErrorModel& errors,
                           const std::vector<Unknown>& kept, const VectorXd& places);

/// Divides every equation by the σ of its row.
void weigh(const Problem& problem, MatrixXd& columns);

/// Files of kinds ball, bar and array fitted.
struct TipFit {
  Problem problem;
  std::vector<Unknown> unknowns;
  Solution solution;
  ErrorModel given;
};

/// A calibration to begin with: the errors that were given and those of the read-outs.
Calibration of_read_outs(const Machine& machine, std::span<const MachineMeasurement> data,
                         const CalibrationOptions& options);

/// Adds the fit to `out`. `array_errors`, a calibration: position and straightness of the axes of
/// arrays are unknown too, and read-outs alone, which were fitted before, give nothing. Otherwise
/// these are fitted by their zeros, for a diagnosis.
std::optional<TipFit> fit_tips(const Machine& machine, std::span<const MachineMeasurement> data,
                               const CalibrationOptions& options, bool array_errors,
                               Calibration& out);

}  // namespace trueaxis::calibrate_detail

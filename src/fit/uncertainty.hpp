// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Dense>
#include <optional>
#include <string>
#include <vector>

#include "fit/associate.hpp"
#include "trueaxis/fit.hpp"

namespace trueaxis {

/// The noise of the readings as an autoregression, and what it makes of the normal matrix.
struct CorrelatedNoise {
  std::vector<double> phi;  ///< φ of ε_i = Σ φ_j ε_{i−j} + e_i
  Eigen::MatrixXd jtcj;     ///< JᵀCJ, C the correlation matrix of the noise of all readings
};

/// The autoregression of residuals clipped at ± `clip_mm`; excluded readings do not count. There is
/// none if too few readings follow each other, if these are white, or if the residuals ring with
/// the spindle: that is form, not noise (Eqs. 34a, 65).
std::optional<CorrelatedNoise> find_correlated_noise(const JointModel& model,
                                                     const Association& association,
                                                     double clip_mm);

/// What the data say about the noise of one reading.
struct ReadingNoise {
  double sigma_mm = 0.0;  ///< NaN: no redundancy and no sensor noise given
  SigmaSource source = SigmaSource::none;
  std::optional<double> stated_mm;  ///< what stream, job or caller say of the sensor
  double shown_mm = 0.0;            ///< what the residuals alone show; NaN: no redundancy
  double redundancy = 0.0;          ///< readings beyond the parameters
  double autocorrelation = 0.0;
  std::optional<CorrelatedNoise> correlated{};  ///< where neighbours correlate, and not as form
  /// By which correlation widens every u, √((1 + ρ)/(1 − ρ)); with `correlated` the most that it
  /// widens the u of a parameter by (see take_in). 1: uncorrelated.
  double u_factor = 1.0;
  double widened = 1.0;      ///< of u where few readings show σ (see take_in)
  double angle_rad2 = 0.0;   ///< variance of C, where the scatter goes with the slope of X over C
  double loss_factor = 1.0;  ///< variance of the M-estimate over that of least squares
};

/// Whether σ as stated and as the readings show it differ by more than 3, either way, and enough
/// readings show it.
bool noise_disagrees(double stated_mm, double shown_mm, double redundancy);

/// Eqs. 32–34a.
ReadingNoise estimate_noise(const JointModel& model, const Association& association,
                            const FitOptions& options);

/// Which combinations of the working parameters the data determine.
struct Determination {
  Eigen::MatrixXd inverse;          ///< (JᵀJ)⁻¹ over the determined subspace
  Eigen::MatrixXd free_directions;  ///< working parameters × undetermined combinations
};

/// A direction is undetermined where JᵀJ is singular to rounding, or where `coverage` standard
/// uncertainties exceed a tenth of the surface's own size, beyond which the linearisation means
/// nothing (Eq. 31).
Determination determine(const NormalMatrix& normal, const std::vector<double>& scale_mm,
                        double size_mm, const ReadingNoise& noise, double coverage);

/// What correlated noise makes of the readings' freedom, which σ follows from, and of the u of the
/// parameters (Eq. 34b); then what that freedom makes of u (Eq. 34c).
void take_in(const Determination& determination, double coverage, ReadingNoise& noise);

/// "0.71 x + 0.70 radius" for a direction, in mm on the surface.
std::string name_direction(const Eigen::VectorXd& direction, const std::vector<std::string>& names,
                           const std::vector<double>& scale_mm);

/// One covariance of the joint parameters per source: the noise first, then the influences.
struct Source {
  std::string name;
  char type = 'A';
  Eigen::MatrixXd covariance;
};
/// Eq. 35.
std::vector<Source> budget_sources(const JointModel& model, const Association& association,
                                   const Determination& determination, const ReadingNoise& noise,
                                   const FitOptions& options);

}  // namespace trueaxis

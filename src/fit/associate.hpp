// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "fit/joint_model.hpp"
#include "trueaxis/fit.hpp"

namespace trueaxis {

/// Where Levenberg-Marquardt ended.
struct Minimum {
  std::vector<double> working;  ///< joint parameters: the working ones of all set-ups
  NormalMatrix normal;          ///< at `working`
  int iterations = 0;
  bool converged = false;
};

/// Minimises ½Σρ(reading − prediction) with Ceres' Levenberg-Marquardt on the (p + 1)-row factor of
/// the normal matrix: the same minimum as one residual a reading, without ever holding N residuals.
Minimum minimise(const JointModel& model, std::vector<double> start, const LossScale& loss,
                 int max_iterations);

/// Newton steps from a minimum of a robust loss until they are below 1e-9 of the noise. Near the
/// minimum the gradient is exact where the cost, which Ceres goes by, already drowns in its
/// rounding.
void polish(const JointModel& model, const LossScale& loss, Minimum& minimum);

/// Readings a start is taken from: all of a short stream, else whole blocks spread by the golden
/// ratio, so that no period of the sampling is met.
struct Sample {
  std::vector<double> reading, cos_c, sin_c, position;
  ReadingBlock view() const {
    return {reading.data(), cos_c.data(), sin_c.data(), position.data()};
  }
};
Sample sample_of(const PreparedStream& stream);

/// A sample of each part of a model.
std::vector<Sample> samples_of(const JointModel& model);

/// The algebraic start; for a robust loss refitted on the readings near it. If a probe line misses
/// it, the level start (Eq. 24).
std::vector<double> find_start(const JointModel& model, const std::vector<Sample>& samples,
                               Loss loss);

/// The lowest minimum reached, and the lowest of the others when there is one.
struct Minima {
  Minimum best;
  std::optional<Minimum> rival;
};

/// Minimises from `start`; where that fails, or a mirrored tilt may do as well, also from the level
/// start and from the minimum's tilt reversed, one clamping after the other (Eq. 25). If there are
/// at most two readings more than parameters, also from tilts all around.
Minima lowest_minimum(const JointModel& model, const std::vector<Sample>& samples,
                      const std::vector<double>& start, const LossScale& loss, int max_iterations);

/// A minimum with its residuals and, for a robust loss, the scale it was found with.
struct Association {
  Minimum minimum;
  std::optional<Minimum> rival;  ///< the lowest minimum but one, when several starts were tried
  LossScale loss;
  double scale_mm = 0.0;            ///< robust σ; 0 for plain
  std::vector<double> residual_mm;  ///< reading − prediction
};

/// Starting values from the data, then the minimum of the loss; a robust scale and the minimum are
/// found in turn until the scale no longer changes (Huber, Robust Statistics, 1981, section 7.8).
Association associate(const JointModel& model, Loss loss, int max_iterations);

/// ψ and ψ' of a loss at a residual (Eqs. 26, 27).
struct PsiAndDerivative {
  double psi, slope;
};
PsiAndDerivative psi_and_derivative(const LossScale& loss, double residual_mm);

/// The readings without weight (Tukey), or beyond 6 σ (Huber).
std::vector<Rejected> list_rejected(const Association& association);

}  // namespace trueaxis

// SPDX-License-Identifier: Apache-2.0
#include "study/bound/whitening.hpp"

#include <cmath>
#include <optional>
#include <utility>

namespace trueaxis::study {
namespace {

using namespace virtual_lathe;

/// x_i = F x_{i−1} + q e₁, its first component of standard deviation 1.
struct StateSpace {
  Eigen::MatrixXd transition, covariance;
  double fresh_variance = 1.0;
};

std::optional<StateSpace> state_space(const Noise& noise) {
  std::vector<double> phi = noise.autoregression;
  if (phi.empty()) phi = {noise.rho};
  const auto order = static_cast<Eigen::Index>(phi.size());
  StateSpace out;
  out.transition = Eigen::MatrixXd::Zero(order, order);
  for (Eigen::Index j = 0; j < order; ++j) {
    out.transition(0, j) = phi[static_cast<std::size_t>(j)];
    if (j > 0) out.transition(j, j - 1) = 1.0;
  }
  // P = Σ Fⁱ e₁e₁ᵀ (Fⁱ)ᵀ, twice as many terms a step (Smith 1968).
  Eigen::MatrixXd power = out.transition, sum = Eigen::MatrixXd::Zero(order, order);
  sum(0, 0) = 1.0;
  constexpr int most_doublings = 40;
  for (int i = 0; i < most_doublings; ++i) {
    sum += (power * sum * power.transpose()).eval();
    power = (power * power).eval();
    if (!sum.allFinite() || !power.allFinite()) return std::nullopt;
    if (power.norm() < 1e-30) {
      out.covariance = sum / sum(0, 0);
      out.fresh_variance = 1.0 / sum(0, 0);
      return out;
    }
  }
  return std::nullopt;
}

/// Of the uniform part and of rounding, mm².
double white_variance(const CleanStream& clean, const Noise& noise) {
  return (noise.uniform_mm * noise.uniform_mm +
          0.25 * clean.sensor.quantisation_mm * clean.sensor.quantisation_mm) /
         3.0;
}

}  // namespace

bool has_noise(const CleanStream& clean, const Noise& noise) {
  return noise.sigma_mm > 0.0 || white_variance(clean, noise) > 0.0;
}

bool whiten(const CleanStream& clean, const Noise& noise, Eigen::MatrixXd& rows) {
  const double white = white_variance(clean, noise);
  if (!has_noise(clean, noise)) return false;
  std::optional<StateSpace> space = state_space(noise);
  if (!space) return false;
  const Eigen::MatrixXd& transition = space->transition;
  Eigen::MatrixXd& covariance = space->covariance;
  Eigen::MatrixXd state = Eigen::MatrixXd::Zero(transition.rows(), rows.cols());
  for (Eigen::Index i = 0; i < rows.rows(); ++i) {
    const double tangent =
        noise.incidence > 0.0 ? clean.tan_incidence[static_cast<std::size_t>(i)] : 0.0;
    const double s = noise.sigma_mm * std::sqrt(1.0 + noise.incidence * tangent * tangent);
    const double spread = s * s * covariance(0, 0) + white;
    const Eigen::RowVectorXd innovation = rows.row(i) - s * state.row(0);
    rows.row(i) = innovation / std::sqrt(spread);
    const Eigen::VectorXd gain = s / spread * covariance.col(0);
    state = (transition * (state + gain * innovation)).eval();
    covariance -= s * gain * covariance.row(0).eval();
    covariance = (transition * covariance * transition.transpose()).eval();
    covariance(0, 0) += space->fresh_variance;
  }
  return true;
}

}  // namespace trueaxis::study

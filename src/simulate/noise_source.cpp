// SPDX-License-Identifier: Apache-2.0
#include "simulate/noise_source.hpp"

#include <algorithm>
#include <cmath>

#include "trueaxis/error.hpp"

namespace trueaxis::virtual_lathe {
namespace {

/// How an autoregression answers one impulse: until it has died out (then it is stationary).
struct ImpulseResponse {
  std::size_t length = 0;
  double energy = 0.0;  ///< variance of the series over that of its innovations
  bool dies_out = true;
};

ImpulseResponse impulse_response(const std::vector<double>& phi) {
  constexpr std::size_t most = 200000;
  ImpulseResponse out;
  std::vector<double> recent(phi.size(), 0.0);
  double now = 1.0, lately = 1.0;
  while (lately > 1e-20 * out.energy) {
    out.energy += now * now;
    if (++out.length > most || !(out.energy < 1e12)) {
      out.dies_out = false;
      return out;
    }
    std::shift_right(recent.begin(), recent.end(), 1);
    recent.front() = now;
    now = lately = 0.0;
    for (std::size_t j = 0; j < phi.size(); ++j) {
      now += phi[j] * recent[j];
      lately += recent[j] * recent[j];
    }
  }
  return out;
}

void need(bool condition, const char* message) {
  if (!condition) throw InputError("scenario", std::string("noise: ") + message);
}

}  // namespace

std::mt19937_64 engine_for(std::uint64_t seed, std::uint32_t purpose) {
  std::seed_seq sequence{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32U),
                         purpose};
  return std::mt19937_64(sequence);
}

bool is_stationary(const std::vector<double>& phi) {
  return phi.empty() || impulse_response(phi).dies_out;
}

void validate(const Noise& noise) {
  need(noise.sigma_mm >= 0.0 && noise.uniform_mm >= 0.0, "sigma and uniform must be at least 0");
  need(std::abs(noise.rho) < 1.0, "rho must be in (-1, 1)");
  need(noise.student_dof == 0.0 || noise.student_dof > 2.0, "student_dof must be more than 2");
  need(noise.outlier_fraction >= 0.0 && noise.outlier_fraction <= 1.0,
       "outlier_fraction must be in [0, 1]");
  need(noise.quantisation_mm >= 0.0, "quantisation must be at least 0");
  need(noise.autoregression.empty() || noise.rho == 0.0, "give rho or an autoregression, not both");
}

NoiseSource::NoiseSource(const Noise& noise, std::uint64_t seed)
    : noise_(noise),
      gaussian_(engine_for(seed, 1)),
      uniform_(engine_for(seed, 2)),
      outliers_(engine_for(seed, 3)),
      student_(noise.student_dof > 2.0 ? noise.student_dof : 3.0) {
  validate(noise);
  if (noise.student_dof > 2.0) {
    student_scale_ = std::sqrt((noise.student_dof - 2.0) / noise.student_dof);
  }
  innovation_ = std::sqrt(1.0 - noise.rho * noise.rho);
  if (noise.autoregression.empty()) return;
  const ImpulseResponse response = impulse_response(noise.autoregression);
  need(response.dies_out, "the autoregression is not stationary");
  innovation_ = 1.0 / std::sqrt(response.energy);
  recent_.assign(noise.autoregression.size(), 0.0);
  for (std::size_t i = 0; i < response.length; ++i) correlated_variate();
}

double NoiseSource::unit_variate() {
  return noise_.student_dof > 2.0 ? student_scale_ * student_(gaussian_) : normal_(gaussian_);
}

double NoiseSource::correlated_variate() {
  if (!recent_.empty()) {
    double next = innovation_ * unit_variate();
    for (std::size_t j = 0; j < recent_.size(); ++j) next += noise_.autoregression[j] * recent_[j];
    std::shift_right(recent_.begin(), recent_.end(), 1);
    return recent_.front() = next;
  }
  const double fresh = unit_variate();
  state_ = started_ ? noise_.rho * state_ + innovation_ * fresh : fresh;
  started_ = true;
  return state_;
}

NoiseDraw NoiseSource::draw(double tan_incidence, double away) {
  NoiseDraw draw;
  if (noise_.sigma_mm > 0.0) {
    const double variate = correlated_variate();
    const double widened = std::sqrt(1.0 + noise_.incidence * tan_incidence * tan_incidence);
    draw.error_mm += noise_.sigma_mm * widened * variate;
  }
  if (noise_.uniform_mm > 0.0) {
    draw.error_mm += noise_.uniform_mm * (2.0 * uniform_01(uniform_) - 1.0);
  }
  if (noise_.outlier_fraction > 0.0) {
    const double chance = uniform_01(outliers_);
    const double size = noise_.outlier_size_mm * (0.5 + uniform_01(outliers_));
    const double side = uniform_01(outliers_) < 0.5 ? -1.0 : 1.0;
    draw.outlier = chance < noise_.outlier_fraction;
    if (draw.outlier) draw.error_mm += size * (noise_.outliers_one_sided ? away : side);
  }
  return draw;
}

}  // namespace trueaxis::virtual_lathe

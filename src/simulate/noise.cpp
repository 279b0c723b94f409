// SPDX-License-Identifier: Apache-2.0
#include "simulate/noise.hpp"

#include <string>

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

const Noise& validated(const Noise& noise) {
  validate(noise);
  return noise;
}

}  // namespace

bool is_stationary(const std::vector<double>& phi) {
  return phi.empty() || impulse_response(phi).dies_out;
}

Autoregression::Autoregression(const Noise& noise) : phi_(noise.autoregression) {
  if (phi_.empty()) {
    phi_ = {noise.rho};
    innovation_ = std::sqrt(1.0 - noise.rho * noise.rho);
  } else {
    const ImpulseResponse response = impulse_response(phi_);
    if (!response.dies_out)
      throw InputError("scenario", "noise: the autoregression is not stationary");
    innovation_ = 1.0 / std::sqrt(response.energy);
    run_in_ = response.length;
    begun_ = true;
  }
  recent_.assign(phi_.size(), 0.0);
}

std::mt19937_64 engine_for(std::uint64_t seed, std::uint32_t purpose) {
  std::seed_seq sequence{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32U),
                         purpose};
  return std::mt19937_64(sequence);
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

UnitVariates::UnitVariates(const Noise& noise, std::uint64_t seed)
    : heavy_(noise.student_dof > 2.0),
      engine_(engine_for(seed, 1)),
      student_(heavy_ ? noise.student_dof : 3.0) {
  if (heavy_) scale_ = std::sqrt((noise.student_dof - 2.0) / noise.student_dof);
}

NoiseSource::NoiseSource(const Noise& noise, std::uint64_t seed)
    : noise_(validated(noise)),
      variates_(noise, seed),
      series_(noise),
      uniform_(engine_for(seed, 2)),
      outliers_(engine_for(seed, 3)) {}

NoiseDraw NoiseSource::draw(double tan_incidence, double away) {
  NoiseDraw draw;
  if (noise_.sigma_mm > 0.0)
    draw.error_mm += noise_.sigma_mm * widening(noise_, tan_incidence) * series_.next(variates_);
  if (noise_.uniform_mm > 0.0)
    draw.error_mm += noise_.uniform_mm * (2.0 * uniform_01(uniform_) - 1.0);
  if (noise_.outlier_fraction > 0.0) {
    const auto error_mm = draw_outlier(noise_, away, [&] { return uniform_01(outliers_); });
    draw.outlier = error_mm.has_value();
    draw.error_mm += error_mm.value_or(0.0);
  }
  return draw;
}

}  // namespace trueaxis::virtual_lathe

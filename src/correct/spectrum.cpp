// SPDX-License-Identifier: Apache-2.0
#include "correct/spectrum.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <ranges>
#include <span>

#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

using Complex = std::complex<double>;

constexpr int max_order = 16;        // amplitudes fall at least like (eccentricity / 2R)^n
constexpr int samples = 64;          // of one revolution: order n is mixed with 64 − n only
constexpr int nodes = 9;             // of the position
constexpr double matters_mm = 1e-9;  // a thousandth of the table's last digit but one
constexpr double reported_mm = 1e-6;
constexpr double rounding_mm = 1e-13;  // of X's of 100 mm, whose differences the amplitudes are

/// Coefficients c_j of Σ c_j T_j(u) through values at the Chebyshev points of the first kind.
std::vector<Complex> chebyshev_series(const std::vector<Complex>& values) {
  std::vector<Complex> series(nodes);
  for (int j = 0; j < nodes; ++j) {
    for (int k = 0; k < nodes; ++k) {
      series[static_cast<std::size_t>(j)] += (j == 0 ? 1.0 : 2.0) / nodes *
                                             values[static_cast<std::size_t>(k)] *
                                             std::cos(std::numbers::pi * j * (k + 0.5) / nodes);
    }
  }
  while (series.size() > 2 && std::abs(series.back()) < rounding_mm) series.pop_back();
  return series;
}

double node_u(int k) { return std::cos(std::numbers::pi * (k + 0.5) / nodes); }

}  // namespace

std::vector<Complex> harmonics_at(const Profile& profile, double position_mm, int highest) {
  std::vector<Complex> amplitude(static_cast<std::size_t>(highest) + 1);
  for (int i = 0; i < samples; ++i) {
    const double psi = two_pi * i / samples;
    const double value =
        profile.at(profile.tool().c_start_rad + profile.tool().sense * psi, position_mm);
    for (int n = 0; n <= highest; ++n) {
      amplitude[static_cast<std::size_t>(n)] +=
          (n == 0 ? 1.0 : 2.0) / samples * value *
          std::polar(1.0, -two_pi * (i * n % samples) / samples);
    }
  }
  return amplitude;
}

std::vector<CorrectionHarmonic> table_harmonics(const Profile& profile, const Actuator& actuator) {
  constexpr int highest = 8;
  const ToolSetup& tool = profile.tool();
  const std::vector<Complex> start = harmonics_at(profile, profile.position_start_mm(), highest);
  const std::vector<Complex> end = harmonics_at(profile, profile.position_end_mm(), highest);
  std::vector<CorrectionHarmonic> harmonics;
  for (int n = 0; n <= highest; ++n) {
    const Complex a = start[static_cast<std::size_t>(n)], b = end[static_cast<std::size_t>(n)];
    if (std::max(std::abs(a), std::abs(b)) < reported_mm) continue;
    // A cos(nψ + arg a) with ψ = sense (C − c_start) is A cos(nC − φ), φ = n c_start − sense arg a.
    const auto phase = [&](const Complex& amplitude) {
      return std::remainder(n * tool.c_start_rad - tool.sense * std::arg(amplitude), two_pi);
    };
    const Complex response = actuator.response(n * tool.speed_rpm / 60.0);
    CorrectionHarmonic harmonic;
    harmonic.order = n;
    harmonic.amplitude_start_mm = n == 0 ? a.real() : std::abs(a);
    harmonic.amplitude_end_mm = n == 0 ? b.real() : std::abs(b);
    harmonic.phase_start_rad = n == 0 ? 0.0 : phase(a);
    harmonic.phase_end_rad = n == 0 ? 0.0 : phase(b);
    harmonic.gain = std::abs(response);
    harmonic.lag_rad = 0.0 - std::arg(response);
    harmonics.push_back(harmonic);
  }
  return harmonics;
}

Spectrum::Spectrum(const Profile& profile)
    : start_mm_(profile.position_start_mm()), end_mm_(profile.position_end_mm()) {
  std::vector<std::vector<Complex>> values(max_order + 1, std::vector<Complex>(nodes));
  for (int k = 0; k < nodes; ++k) {
    const double position = 0.5 * (start_mm_ + end_mm_) + 0.5 * (end_mm_ - start_mm_) * node_u(k);
    const std::vector<Complex> amplitude = harmonics_at(profile, position, max_order);
    for (std::size_t n = 0; n <= max_order; ++n)
      values[n][static_cast<std::size_t>(k)] = amplitude[n];
  }
  for (std::size_t n = 0; n <= max_order; ++n) {
    double largest = 0.0;
    for (const Complex& value : values[n]) largest = std::max(largest, std::abs(value));
    if (largest < matters_mm) continue;
    orders_.push_back(static_cast<int>(n));
    coefficients_.push_back(chebyshev_series(values[n]));
  }
}

void Spectrum::at(double position_mm, std::vector<SlowAmplitude>& amplitudes) const {
  const double u = (2.0 * position_mm - start_mm_ - end_mm_) / (end_mm_ - start_mm_);
  amplitudes.resize(orders_.size());
  for (std::size_t i = 0; i < orders_.size(); ++i) {
    // Clenshaw for Σ c_j T_j(u) and its derivative.
    const std::vector<Complex>& c = coefficients_[i];
    Complex b1, b2, d1, d2;
    for (const Complex& c_j : std::span(c).subspan(1) | std::views::reverse) {
      const Complex d0 = 2.0 * u * d1 - d2 + 2.0 * b1;
      d2 = d1, d1 = d0;
      const Complex b0 = c_j + 2.0 * u * b1 - b2;
      b2 = b1, b1 = b0;
    }
    amplitudes[i].value = c[0] + u * b1 - b2;
    amplitudes[i].slope = (b1 + u * d1 - d2) * (2.0 / (end_mm_ - start_mm_));
  }
}

}  // namespace trueaxis

// SPDX-License-Identifier: Apache-2.0
#include "correct/precompensate.hpp"

#include <cmath>
#include <numbers>

#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

using Complex = std::complex<double>;

}  // namespace

Complex signed_response(const Actuator& actuator, double frequency_hz) {
  return frequency_hz >= 0.0 ? actuator.response(frequency_hz)
                             : std::conj(actuator.response(-frequency_hz));
}

double kept_by_interpolation(int order, int rows_per_revolution) {
  if (order == 0) return 1.0;
  const double x = std::numbers::pi * order / rows_per_revolution;
  return std::pow(std::sin(x) / x, 2);
}

Motion motion_of(const Profile& profile, double speed_rpm) {
  const double revolutions_per_s = speed_rpm / 60.0;
  return {two_pi * revolutions_per_s, profile.feed_mm_per_rev() * revolutions_per_s,
          profile.tool().rows_per_revolution};
}

std::vector<HarmonicPath> harmonic_paths(const Actuator& actuator, const Motion& motion,
                                         const std::vector<int>& orders) {
  constexpr double step_hz = 0.01;  // rounding 1e-14 s, truncation step² / f_n³: both negligible
  std::vector<HarmonicPath> paths;
  for (const int n : orders) {
    const double frequency_hz = n * motion.omega_rad_per_s / two_pi;
    const double kept = kept_by_interpolation(n, motion.rows_per_revolution);
    const Complex slope = (signed_response(actuator, frequency_hz + step_hz) -
                           signed_response(actuator, frequency_hz - step_hz)) /
                          (2.0 * two_pi * step_hz);
    paths.push_back({n, kept * actuator.response(frequency_hz), kept * slope,
                     actuator.between_points(frequency_hz)});
  }
  return paths;
}

Complex commanded(const HarmonicPath& path, const SlowAmplitude& wanted, double position_mm_per_s) {
  const Complex inverse = 1.0 / path.response;
  const Complex inverse_slope = -path.response_slope * inverse * inverse;
  const Complex rate = wanted.slope * position_mm_per_s;
  return inverse * wanted.value - Complex(0.0, 1.0) * inverse_slope * rate;
}

void precompensate(const Spectrum& spectrum, const Actuator& actuator, const Motion& motion,
                   CorrectionRows& rows) {
  const std::vector<HarmonicPath> paths = harmonic_paths(actuator, motion, spectrum.orders());
  const std::size_t per_rev = static_cast<std::size_t>(motion.rows_per_revolution);
  std::vector<Complex> turn(per_rev);
  for (std::size_t i = 0; i < per_rev; ++i) {
    turn[i] = std::polar(1.0, two_pi * static_cast<double>(i) / motion.rows_per_revolution);
  }
  std::vector<SlowAmplitude> wanted;
  for (std::size_t row = 0; row < rows.wanted_mm.size(); ++row) {
    spectrum.at(rows.position_mm[row], wanted);
    const bool stands = rows.position_mm[row] == spectrum.end_mm();  // the feed, at the end
    const double rate_mm_per_s = stands ? 0.0 : motion.position_mm_per_s;
    double lead_mm = 0.0;
    for (std::size_t i = 0; i < paths.size(); ++i) {
      const std::size_t angle = row * static_cast<std::size_t>(paths[i].order) % per_rev;
      const Complex added = commanded(paths[i], wanted[i], rate_mm_per_s) - wanted[i].value;
      lead_mm += (added * turn[angle]).real();
    }
    rows.command_mm[row] = rows.wanted_mm[row] + lead_mm;
  }
}

}  // namespace trueaxis

// SPDX-License-Identifier: Apache-2.0
#include "spindle/second_order.hpp"

#include <cmath>

namespace trueaxis {

double value_at(const Series& series, double angle_rad) {
  const std::complex<double> step = std::polar(1.0, angle_rad);
  std::complex<double> sum = 0.0;
  for (std::size_t n = series.size(); n-- > 0;) sum = sum * step + series[n];
  return sum.real();
}

std::vector<double> second_order(const RunReadings& run, std::size_t sensor, double sensitive_rad,
                                 std::complex<double> eccentricity, const Series& form,
                                 const Series& along, const Series& across) {
  const double R = run.radius_mm, theta = run.angles_rad[sensor];
  const double cosine = std::cos(theta - sensitive_rad), sine = std::sin(theta - sensitive_rad);
  std::vector<double> left(run.c_rad.size());
  for (std::size_t i = 0; i < left.size(); ++i) {
    const double C = run.c_rad[i], psi = C + theta;
    const double a = value_at(along, C), b = value_at(across, C);
    // The part's centre across the sensor's line, to the left of it.
    const double q = b * cosine - a * sine - (eccentricity * std::polar(1.0, psi)).imag();
    const double on_part = psi + run.set_up.reindex_rad;
    const double turned = -std::asin(q / R);
    const double met = R + value_at(form, on_part + turned);
    left[i] = std::sqrt(met * met - q * q) - R - value_at(form, on_part);
  }
  return left;
}

}  // namespace trueaxis

// SPDX-License-Identifier: Apache-2.0
#include "spindle/second_order.hpp"

#include <cmath>

#include "trueaxis/units.hpp"

namespace trueaxis {

double value_at(const Series& series, double angle_rad) {
  const std::complex<double> step = std::polar(1.0, angle_rad);
  std::complex<double> sum = 0.0;
  for (std::size_t n = series.size(); n-- > 0;) sum = sum * step + series[n];
  return sum.real();
}

Series second_order(const RunReadings& run, std::size_t sensor, double sensitive_rad,
                    const PartInRun& part, int order_max) {
  const double R = run.radius_mm, theta = run.angles_rad[sensor];
  const double cosine = std::cos(theta - sensitive_rad), sine = std::sin(theta - sensitive_rad);
  // Products of two series reach twice their order: four points an undulation of those.
  const auto points = static_cast<std::size_t>(8 * order_max);
  Series out(static_cast<std::size_t>(order_max) + 1, 0.0);
  for (std::size_t i = 0; i < points; ++i) {
    const double C = two_pi * static_cast<double>(i) / static_cast<double>(points);
    const double psi = C + theta, on_part = psi + run.set_up.reindex_rad;
    const double a = value_at(part.along, C), b = value_at(part.across, C);
    // The part's centre across the sensor's line, to the left of it.
    const double q = b * cosine - a * sine - (part.eccentricity * std::polar(1.0, psi)).imag();
    const double met = R + value_at(part.form, on_part - std::asin(q / R));
    const double left = std::sqrt(met * met - q * q) - R - value_at(part.form, on_part);
    const std::complex<double> step = std::polar(1.0, -C);
    std::complex<double> turned = 2.0 * left / static_cast<double>(points);
    for (std::complex<double>& one : out) {
      one += turned;
      turned *= step;
    }
  }
  out.front() *= 0.5;
  return out;
}

}  // namespace trueaxis

// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "trueaxis/correction.hpp"
#include "trueaxis/error.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

using Complex = std::complex<double>;

constexpr double most_lead_rad = 0.1;  // a measurement may be off by as much

/// Measured response at a frequency: log gain and unwrapped phase linear between points; below the
/// first point the phase runs to 0 at 0 Hz, beyond the last the gain stays and the phase goes on.
Complex interpolated(const std::vector<ResponsePoint>& points, double frequency_hz) {
  ResponsePoint low{0.0, points.front().gain, 0.0}, high = low;
  double slope = 0.0;
  for (const ResponsePoint& point : points) {
    if (point.frequency_hz <= 0.0) {
      low.gain = high.gain = point.gain;
      continue;
    }
    low = high;
    high = point;
    high.phase_rad = low.phase_rad + std::remainder(point.phase_rad - low.phase_rad, two_pi);
    slope = (high.phase_rad - low.phase_rad) / (high.frequency_hz - low.frequency_hz);
    if (frequency_hz <= point.frequency_hz) break;
  }
  const double phase = high.phase_rad + slope * (frequency_hz - high.frequency_hz);
  if (frequency_hz >= high.frequency_hz) return std::polar(high.gain, phase);
  const double share = (frequency_hz - low.frequency_hz) / (high.frequency_hz - low.frequency_hz);
  return std::polar(low.gain * std::pow(high.gain / low.gain, share), phase);
}

/// Frequency at which the measured gain first falls to 1/sqrt(2); the last point when it does not.
double measured_bandwidth_hz(const std::vector<ResponsePoint>& points) {
  ResponsePoint previous{0.0, points.front().gain, 0.0};
  for (const ResponsePoint& point : points) {
    if (point.gain <= std::numbers::sqrt2 / 2.0) {
      if (previous.gain <= point.gain) return previous.frequency_hz;
      const double share =
          std::log(previous.gain * std::numbers::sqrt2) / std::log(previous.gain / point.gain);
      return previous.frequency_hz +
             std::max(0.0, share) * (point.frequency_hz - previous.frequency_hz);
    }
    previous = point;
  }
  return points.back().frequency_hz;
}

void require(bool holds, const char* quantity, double value, const char* limit) {
  if (holds) return;
  throw ContractViolation(fmt::format("actuator: {} is {:g}, must be {}", quantity, value, limit));
}

}  // namespace

std::complex<double> Actuator::response(double frequency_hz) const {
  Complex mechanics;
  if (measured.empty()) {
    const double ratio = frequency_hz / natural_frequency_hz;
    mechanics = 1.0 / Complex(1.0 - ratio * ratio, 2.0 * damping * ratio);
  } else {
    mechanics = interpolated(measured, frequency_hz);
  }
  const double hold = std::numbers::pi * frequency_hz / sampling_hz;  // ωT/2
  const double sinc = hold == 0.0 ? 1.0 : std::sin(hold) / hold;
  return mechanics * sinc * std::polar(1.0, -(two_pi * frequency_hz * delay_s + hold));
}

double Actuator::bandwidth_hz() const {
  if (!measured.empty()) return measured_bandwidth_hz(measured);
  // |H|² = 1/2: u² + (4ζ² − 2) u − 1 = 0 with u = (f/f_n)².
  const double b = 1.0 - 2.0 * damping * damping;
  const double root = std::hypot(b, 1.0);
  return natural_frequency_hz * std::sqrt(b >= 0.0 ? b + root : 1.0 / (root - b));
}

bool Actuator::leads() const {
  double unwrapped_rad = 0.0;
  for (const ResponsePoint& point : measured) {
    unwrapped_rad += std::remainder(point.phase_rad - unwrapped_rad, two_pi);
    if (unwrapped_rad > most_lead_rad) return true;
  }
  return false;
}

void Actuator::validate() const {
  const auto positive = [](double value) { return std::isfinite(value) && value > 0.0; };
  require(positive(stroke_mm), "stroke [mm]", stroke_mm, "> 0");
  require(positive(natural_frequency_hz), "natural frequency [Hz]", natural_frequency_hz, "> 0");
  require(positive(damping), "damping", damping, "> 0");
  require(std::isfinite(delay_s) && delay_s >= 0.0, "delay [s]", delay_s, ">= 0");
  require(positive(slew_mm_per_s), "slew [mm/s]", slew_mm_per_s, "> 0");
  require(positive(sampling_hz), "sampling [Hz]", sampling_hz, "> 0");
  require(stroke_reserve >= 0.0 && stroke_reserve < 1.0, "stroke reserve", stroke_reserve,
          ">= 0 and < 1");
  require(positive(following_limit_mm), "following limit [mm]", following_limit_mm, "> 0");
  double previous_hz = -1.0;
  for (const ResponsePoint& point : measured) {
    require(std::isfinite(point.frequency_hz) && point.frequency_hz >= 0.0 &&
                point.frequency_hz > previous_hz,
            "measured frequency [Hz]", point.frequency_hz, ">= 0 and above the one before");
    require(positive(point.gain), "measured gain", point.gain, "> 0");
    require(std::isfinite(point.phase_rad), "measured phase [rad]", point.phase_rad, "finite");
    previous_hz = point.frequency_hz;
  }
  require(measured.empty() || previous_hz > 0.0, "last measured frequency [Hz]", previous_hz,
          "> 0");
  require(!leads(), "measured phase [rad]", measured.empty() ? 0.0 : measured.back().phase_rad,
          "a lag, which is negative");
}

}  // namespace trueaxis

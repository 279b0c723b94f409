// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include "trueaxis/correction.hpp"
#include "trueaxis/error.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

using Complex = std::complex<double>;

constexpr double most_lead_rad = 0.1;  // a measurement may be off by as much

/// Log gain and unwrapped phase at a frequency.
struct LogResponse {
  double frequency_hz, log_gain, phase_rad;
};

/// Of a real system: the points and their images at negative frequencies, where the gain is the
/// same and the phase the opposite.
std::vector<LogResponse> both_sides(std::span<const ResponsePoint> points) {
  std::vector<LogResponse> above;
  double phase = 0.0;
  for (const ResponsePoint& point : points) {
    if (point.frequency_hz > 0.0) phase += std::remainder(point.phase_rad - phase, two_pi);
    above.push_back({point.frequency_hz, std::log(point.gain), phase});
  }
  std::vector<LogResponse> all;
  for (std::size_t i = above.size(); i-- > 0;)
    if (above[i].frequency_hz > 0.0)
      all.push_back({-above[i].frequency_hz, above[i].log_gain, -above[i].phase_rad});
  all.insert(all.end(), above.begin(), above.end());
  return all;
}

/// Slope at point i of the parabola through it and its neighbours, at an end through the two next.
double parabola_slope(const std::vector<LogResponse>& at, std::size_t i,
                      double LogResponse::*value) {
  const std::size_t m = std::clamp<std::size_t>(i, 1, at.size() - 2);
  const auto over = [&](std::size_t a, std::size_t b) {
    return (at[b].*value - at[a].*value) / (at[b].frequency_hz - at[a].frequency_hz);
  };
  const double before = over(m - 1, m), after = over(m, m + 1);
  const double bend = (after - before) / (at[m + 1].frequency_hz - at[m - 1].frequency_hz);
  return before + bend * (2.0 * at[i].frequency_hz - at[m - 1].frequency_hz - at[m].frequency_hz);
}

/// Cubic between two points by these slopes (Hermite).
double cubic(const std::vector<LogResponse>& at, std::size_t i, double frequency_hz,
             double LogResponse::*value) {
  const double width = at[i + 1].frequency_hz - at[i].frequency_hz;
  const double s = (frequency_hz - at[i].frequency_hz) / width, r = 1.0 - s;
  return r * r * (1.0 + 2.0 * s) * (at[i].*value) + s * s * (1.0 + 2.0 * r) * (at[i + 1].*value) +
         s * r * width * (r * parabola_slope(at, i, value) - s * parabola_slope(at, i + 1, value));
}

/// Log gain and unwrapped phase linear between points; below the first point the phase runs to 0 at
/// 0 Hz, beyond the last the gain stays and the phase goes on.
Complex by_straight_lines(const std::vector<ResponsePoint>& points, double frequency_hz) {
  ResponsePoint low{.gain = points.front().gain}, high = low;
  for (const ResponsePoint& point : points) {
    if (point.frequency_hz <= 0.0) {
      low.gain = high.gain = point.gain;
      continue;
    }
    low = high;
    high = point;
    high.phase_rad = low.phase_rad + std::remainder(point.phase_rad - low.phase_rad, two_pi);
    if (frequency_hz <= point.frequency_hz) break;
  }
  const double slope = (high.phase_rad - low.phase_rad) / (high.frequency_hz - low.frequency_hz);
  const double phase = high.phase_rad + slope * (frequency_hz - high.frequency_hz);
  if (frequency_hz >= high.frequency_hz) return std::polar(high.gain, phase);
  const double share = (frequency_hz - low.frequency_hz) / (high.frequency_hz - low.frequency_hz);
  return std::polar(low.gain * std::pow(high.gain / low.gain, share), phase);
}

/// Measured response at a frequency: log gain and unwrapped phase as cubics between points, of
/// which those next to it count.
Complex interpolated(const std::vector<ResponsePoint>& points, double frequency_hz) {
  const auto next =
      std::ranges::upper_bound(points, frequency_hz, {}, &ResponsePoint::frequency_hz);
  const auto first = next - std::min<std::ptrdiff_t>(3, next - points.begin());
  const auto last = next + std::min<std::ptrdiff_t>(3, points.end() - next);
  const std::vector<LogResponse> at = both_sides({first, last});
  if (at.size() < 3 || frequency_hz >= points.back().frequency_hz)
    return by_straight_lines(points, frequency_hz);
  const auto above = std::ranges::upper_bound(at, frequency_hz, {}, &LogResponse::frequency_hz);
  const auto i = static_cast<std::size_t>(above - at.begin()) - 1;
  return std::polar(std::exp(cubic(at, i, frequency_hz, &LogResponse::log_gain)),
                    cubic(at, i, frequency_hz, &LogResponse::phase_rad));
}

/// Frequency at which the measured gain first falls to 1/sqrt(2); the last point when it does not.
double measured_bandwidth_hz(const std::vector<ResponsePoint>& points) {
  ResponsePoint previous{.gain = points.front().gain};
  for (const ResponsePoint& point : points) {
    if (point.gain <= std::numbers::sqrt2 / 2.0) {
      if (previous.gain <= point.gain) return previous.frequency_hz;
      const double share =
          std::log(previous.gain * std::numbers::sqrt2) / std::log(previous.gain / point.gain);
      return previous.frequency_hz + share * (point.frequency_hz - previous.frequency_hz);
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

double Actuator::between_points(double frequency_hz) const {
  if (measured.empty()) return 0.0;
  return std::abs(by_straight_lines(measured, frequency_hz) / interpolated(measured, frequency_hz) -
                  1.0);
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

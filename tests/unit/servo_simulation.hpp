// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "correct/profile.hpp"

namespace trueaxis {

/// A second-order servo driven in time: the drive interpolates the table linearly at every sampling
/// tick and holds; the motion between ticks is the exact solution x(t) = u + e^{At} (x0 − u).
/// Shares no formula with the frequency response.
class ServoSimulation {
 public:
  explicit ServoSimulation(const Actuator& actuator)
      : substeps_(std::max(4, static_cast<int>(80e3 / actuator.sampling_hz))), actuator_(actuator) {
    const double wn = 2.0 * std::numbers::pi * actuator.natural_frequency_hz;
    const double t = 1.0 / actuator.sampling_hz / substeps_;
    const double decay = actuator.damping * wn;
    const double wd = wn * std::sqrt(1.0 - actuator.damping * actuator.damping);
    const double e = std::exp(-decay * t), c = e * std::cos(wd * t), s = e * std::sin(wd * t) / wd;
    yy_ = c + s * decay, yv_ = s, vy_ = -s * wn * wn, vv_ = c - s * decay;
  }

  /// Largest |position − profile| of a table run at `rpm`, after `settle_s` and while it is fed;
  /// exact at instants 12.5 µs apart or less.
  double following_mm(const Profile& profile, const std::vector<double>& table, double rpm,
                      double settle_s = 0.03) const {
    const int per_rev = profile.tool().rows_per_revolution;
    const double rows_per_s = rpm / 60.0 * per_rev;
    const double tick_s = 1.0 / actuator_.sampling_hz;
    double position = table.front(), velocity = 0.0, peak = 0.0;
    for (std::size_t tick = 0;; ++tick) {
      const double now_s = static_cast<double>(tick) * tick_s;
      const double row = now_s * rows_per_s;
      if (row + rows_per_s * tick_s >=
          std::min(static_cast<double>(table.size() - 1), profile.turns() * per_rev))
        break;  // a steady run: until the feed stops
      const double late = std::max(0.0, row - actuator_.delay_s * rows_per_s);
      const std::size_t at = static_cast<std::size_t>(late);
      const double held =
          table[at] + (late - static_cast<double>(at)) * (table[at + 1] - table[at]);
      for (int sub = 1; sub <= substeps_; ++sub) {
        const double off = position - held;
        position = held + yy_ * off + yv_ * velocity;
        velocity = vy_ * off + vv_ * velocity;
        const double then_s = now_s + tick_s * sub / substeps_;
        if (then_s < settle_s) continue;
        const double turns = then_s * rpm / 60.0;
        const double wanted = profile.at(
            profile.tool().c_start_rad + profile.tool().sense * 2.0 * std::numbers::pi * turns,
            profile.position_after_mm(turns));
        peak = std::max(peak, std::abs(position - wanted));
      }
    }
    return peak;
  }

 private:
  int substeps_;  // 80 kHz at least: ripple of the hold is seen near its peaks
  Actuator actuator_;
  double yy_, yv_, vy_, vv_;
};

}  // namespace trueaxis

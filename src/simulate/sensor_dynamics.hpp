// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <numbers>

namespace trueaxis::virtual_lathe {

/// First-order low pass T v' + v = x in continuous time: the convolution between two readings is
/// integrated over panels short against T and against a turn.
class LagFilter {
 public:
  LagFilter(double time_constant_s, double omega_rad_per_s) : time_constant_s_(time_constant_s) {
    constexpr double panel_rad = std::numbers::pi / 18.0;
    panel_s_ = 4.0 * time_constant_s;  // seven Gauss points take e^-4 to 1e-10
    if (omega_rad_per_s != 0.0)
      panel_s_ = std::min(panel_s_, panel_rad / std::abs(omega_rad_per_s));
  }

  /// Indication at `t`, from what it was at the call before; input(time) is what the sensor meets.
  /// At the first call the sensor has followed the same motion for long.
  template <class Input>
  double at(double t, const Input& input) {
    const double memory = 40.0 * time_constant_s_;  // e^-40: nothing is left
    double now = started_ ? std::max(now_s_, t - memory) : t - memory;
    double value = started_ && now == now_s_ ? value_mm_ : input(now);
    while (now < t) {
      const double next = std::min(t, now + panel_s_);
      const auto weighted = [&](double time) {
        return std::exp((time - next) / time_constant_s_) * input(time);
      };
      value = value * std::exp((now - next) / time_constant_s_) +
              boost::math::quadrature::gauss<double, 7>::integrate(weighted, now, next) /
                  time_constant_s_;
      now = next;
    }
    started_ = true;
    now_s_ = t;
    return value_mm_ = value;
  }

 private:
  double time_constant_s_, panel_s_ = 0.0;
  bool started_ = false;
  double now_s_ = 0.0, value_mm_ = 0.0;
};

/// A pointer with play b: it stays until what it follows has moved by b the other way. It goes in
/// steps of half a degree of the spindle; an extreme in a step is that of the parabola through its
/// ends and its middle.
class PlayFilter {
 public:
  /// @param turning_rad of the spindle per unit of `at`'s argument
  PlayFilter(double play_mm, double turning_rad) : half_mm_(0.5 * play_mm) {
    constexpr double step_rad = std::numbers::pi / 360.0;
    if (turning_rad == 0.0) return;
    step_ = step_rad / std::abs(turning_rad);
    before_ = 2.0 * std::numbers::pi / std::abs(turning_rad);
  }

  /// Indication at `when`, after what it was at the call before. At the first call it has followed
  /// the same motion for a revolution, or for one unit if the spindle is at rest.
  template <class Input>
  double at(double when, const Input& input) {
    if (!started_) now_ = when - before_, met_mm_ = value_mm_ = input(now_);
    started_ = true;
    while (now_ < when) {
      const double next = std::min(when, now_ + step_);
      const double middle = input(0.5 * (now_ + next)), end = input(next);
      const double slope = 0.5 * (end - met_mm_), bend = met_mm_ - 2.0 * middle + end;
      if (std::abs(slope) < std::abs(bend)) follow(middle - 0.5 * slope * slope / bend);
      follow(end);
      now_ = next, met_mm_ = end;
    }
    return value_mm_;
  }

 private:
  void follow(double x) { value_mm_ = std::clamp(value_mm_, x - half_mm_, x + half_mm_); }

  double half_mm_, step_ = 0.05, before_ = 1.0;
  bool started_ = false;
  double now_ = 0.0, met_mm_ = 0.0, value_mm_ = 0.0;
};

}  // namespace trueaxis::virtual_lathe

// SPDX-License-Identifier: Apache-2.0
#include "live/motion.hpp"

#include <algorithm>
#include <cmath>

namespace trueaxis {
namespace {

constexpr double share = 1.0 / 64.0;     // of a new step in the mean of the last ones
constexpr double standing_rad = 1e-6;    // a reading
constexpr double turned_mm = 5e-3;       // what counts as feed, as in passes
constexpr double steps_of_speed = 0.05;  // of its logarithm: a latency is that of its speed
constexpr std::uint32_t speeds = 4096;

}  // namespace

int turning_of(std::uint32_t motion) { return static_cast<int>(motion / 3 % 3) - 1; }
int feed_of(std::uint32_t motion) { return static_cast<int>(motion % 3) - 1; }

std::uint32_t Motion::at(double c_rad, double z_mm, double time_s) {
  if (!started_) c_ = c_rad, z_turned_ = z_mm, time_ = time_s;
  const bool second = started_ && c_step_ == 0.0 && time_step_ == 0.0;
  const double weight = second ? 1.0 : share;
  c_step_ += weight * (c_rad - c_ - c_step_);
  time_step_ += weight * (time_s - time_ - time_step_);
  c_ = c_rad, time_ = time_s, started_ = true;
  if (std::abs(z_mm - z_turned_) > turned_mm) {
    feed_ = z_mm > z_turned_ ? 2 : 0;
    z_turned_ = z_mm;
  }
  const std::uint32_t turning = std::abs(c_step_) < standing_rad ? 1 : c_step_ > 0.0 ? 2 : 0;
  std::uint32_t speed = 0;
  if (turning != 1 && time_step_ > 0.0) {
    const double steps = std::log(std::abs(c_step_) / time_step_) / steps_of_speed;
    speed =
        static_cast<std::uint32_t>(std::clamp(std::round(steps) + speeds / 2, 0.0, speeds - 1.0));
  }
  return (speed * 3 + turning) * 3 + feed_;
}

}  // namespace trueaxis

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace trueaxis {

/// Senses of a motion: −1, 0, +1.
int turning_of(std::uint32_t motion);
int feed_of(std::uint32_t motion);

/// How spindle and slide move at a reading, as one number: senses of C and Z, and the speed of C in
/// steps of 5 %.
class Motion {
 public:
  /// @param time_s that of a stream without times is 0
  std::uint32_t at(double c_rad, double z_mm, double time_s);

 private:
  bool started_ = false;
  double c_ = 0.0, time_ = 0.0, z_turned_ = 0.0;  ///< of the reading before; Z at the last turn
  double c_step_ = 0.0, time_step_ = 0.0;         ///< means of the last readings
  std::uint32_t feed_ = 1;
};

}  // namespace trueaxis

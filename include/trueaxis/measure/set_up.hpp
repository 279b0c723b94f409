// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace trueaxis {

/// What was done to part and probe before the readings of a set-up, as the stream states it
/// (`setup.2.reindex: 70 deg`, …). All of it is against the part as it was first clamped.
struct SetUp {
  int number = 1;                  ///< as in the column `setup`
  double reindex_rad = 0.0;        ///< the part turned about its own axis, in the sense of C
  double z_shift_mm = 0.0;         ///< the part moved along Z
  bool rear = false;               ///< probed at the smaller X
  double x_jog_mm = 0.0;           ///< slide moved in X, sensor and machine still adding up to X_M
  double clamp_force_ratio = 1.0;  ///< over the force of the first clamping

  /// Whether the part stands in the chuck as in `other`: side and jog do not move the part.
  bool clamped_as(const SetUp& other) const {
    return reindex_rad == other.reindex_rad && z_shift_mm == other.z_shift_mm &&
           clamp_force_ratio == other.clamp_force_ratio;
  }
  /// Whether the part was taken out, shifted or clamped anew: it then has an axis of its own.
  bool moved() const { return !clamped_as(SetUp{}); }

  bool operator==(const SetUp&) const = default;
};

}  // namespace trueaxis

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trueaxis/correction.hpp"
#include "trueaxis/surface.hpp"

namespace trueaxis {

/// The wanted correction as a function of the spindle angle and the machine position. It is where
/// the centre of the tool's nose must be for the target surface about the target axis, minus that
/// for the same surface about the spindle axis. The motions of the machine that are to be followed
/// are added. Exact at the tool's height, mm.
class Profile {
 public:
  /// @throws ContractViolation naming the quantity of the target or tool that cannot be.
  Profile(const Axis& axis, const TargetSurface& target, const ToolSetup& tool,
          std::vector<RepeatingMotion> motions = {});

  /// X_fts at (C, Z), positive away from the spindle axis; for a face Z_fts at (C, X), positive
  /// along +Z. `position_mm` is that of the nose's centre.
  /// @throws Refusal where the tool's line or nose does not meet the target surface.
  double at(double c_rad, double position_mm) const;

  /// Where the centre of the nose is programmed: X for the surface about the spindle axis at Z, of
  /// a face Z for the face at X.
  double programmed_mm(double position_mm) const;

  /// Where the programmed path of the nose's centre starts and ends: the contact with the surface
  /// about the spindle axis then runs over the target from its start to its end, with run-in and
  /// overrun.
  double position_start_mm() const { return start_mm_; }
  double position_end_mm() const { return end_mm_; }
  /// Along the feed, mm per revolution, with the sign of the direction.
  double feed_mm_per_rev() const { return feed_mm_per_rev_; }
  /// Revolutions until the feed reaches the end.
  double turns() const { return turns_; }
  /// The turns of the table: whole ones, the last of them at the end.
  std::size_t revolutions() const { return revolutions_; }
  std::size_t rows() const {
    return revolutions_ * static_cast<std::size_t>(tool_.rows_per_revolution);
  }
  /// Where the feed is after so many revolutions: at the end it stops.
  double position_after_mm(double turns) const;
  /// Running spindle angle then, in the sense of rotation when cutting.
  double c_after_rad(double turns) const;
  double position_mm(std::size_t row) const { return position_after_mm(turns_to(row)); }
  double c_rad(std::size_t row) const { return c_after_rad(turns_to(row)); }
  const ToolSetup& tool() const { return tool_; }

 private:
  double turns_to(std::size_t row) const {
    return static_cast<double>(row) / tool_.rows_per_revolution;
  }
  /// Z of the nose's centre when it touches the surface about the spindle axis at `z_mm`.
  double centre_over_mm(double z_mm) const;
  /// Eq. 109.
  double nose_centre_mm(const Revolved& surface, double c_rad, double z_mm) const;
  /// Eq. 110.
  double face_mm(double c_rad, double x_mm) const;

  TargetSurface target_;
  ToolSetup tool_;
  std::vector<RepeatingMotion> motions_;
  Revolved about_target_, about_spindle_;
  double start_mm_ = 0.0, end_mm_ = 0.0, feed_mm_per_rev_ = 0.0, turns_ = 0.0;
  std::size_t revolutions_ = 0;
};

/// m at spindle angle C and height Z of a surface whose section has the slope dX/dZ, mm.
double motion_mm(const RepeatingMotion& motion, double c_rad, double z_mm, double dx_dz);

/// +1: a tool on the probe's side of the spindle, −1: on the other side, 0: elsewhere.
int side_of_tool(double angle_from_probe_rad);

}  // namespace trueaxis

// SPDX-License-Identifier: Apache-2.0
#include "correct/profile.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "base/angle.hpp"
#include "trueaxis/error.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {

namespace {

void validate(const TargetSurface& target, const ToolSetup& tool) {
  const bool face = target.kind == TargetKind::face;
  expects(std::isfinite(tool.nose_radius_mm) && tool.nose_radius_mm >= 0.0, "nose radius >= 0 mm");
  expects(std::isfinite(tool.height_mm), "a finite tool height");
  expects(std::isfinite(tool.angle_from_probe_rad) && std::isfinite(tool.c_start_rad),
          "finite angles of the tool and of the first row");
  expects(std::isfinite(tool.speed_rpm) && tool.speed_rpm > 0.0, "spindle speed > 0 rpm");
  expects(tool.sense == 1 || tool.sense == -1, "sense of rotation +1 or -1");
  expects(std::isfinite(tool.feed_mm_per_rev) && tool.feed_mm_per_rev > 0.0, "feed > 0 mm/rev");
  expects(tool.rows_per_revolution >= 8, "8 rows per revolution or more");
  expects(std::isfinite(target.run_in_mm) && target.run_in_mm >= 0.0 &&
              std::isfinite(target.overrun_mm) && target.overrun_mm >= 0.0,
          "run-in and overrun >= 0 mm");
  if (face) {
    expects(!target.bore, "a face cannot be a bore");
    expects(std::isfinite(target.z_face_mm), "a finite Z of the face");
    expects(target.radius_start_mm != target.radius_end_mm, "a face with two different radii");
  } else {
    expects(target.z_start_mm != target.z_end_mm, "a cut with two different ends in Z");
    expects(std::isfinite(target.radius_mm) && target.radius_mm > 0.0, "target radius > 0 mm");
    expects(std::isfinite(target.tan_half_angle), "a finite half angle of the target");
    expects(target.kind == TargetKind::cone || target.tan_half_angle == 0.0,
            "half angle 0 of a target cylinder");
  }
}

[[noreturn]] void refuse_miss(const char* what, double c_rad, double z_mm) {
  throw Refusal(
      fmt::format("{} at C = {:g} deg, Z = {:g} mm: a correction cannot be computed there", what,
                  within_turn(c_rad) / rad_per_deg, z_mm));
}

/// The nose, a circle about its centre, stays on the target's side of a shoulder.
void check_shoulder(const TargetSurface& target, const ToolSetup& tool, double start_mm,
                    double end_mm) {
  if (!target.shoulder_mm) return;
  const bool face = target.kind == TargetKind::face;
  const char along = face ? 'X' : 'Z';
  const auto [low, high] = std::minmax({target.start_mm(), target.end_mm()});
  const double shoulder = *target.shoulder_mm;
  if (low < shoulder && shoulder < high)
    throw Refusal(
        fmt::format("the shoulder at {} = {:.6g} mm lies on the target, which is cut "
                    "from {:.6g} to {:.6g} mm: give the place of the shoulder, or end "
                    "the target before it",
                    along, shoulder, target.start_mm(), target.end_mm()));
  const double side = shoulder >= high ? 1.0 : -1.0;
  const double reach = side * std::max(side * start_mm, side * end_mm) + side * tool.nose_radius_mm;
  const double past_mm = side * (reach - shoulder);
  if (!(past_mm > 1e-9)) return;
  const bool at_end = side * end_mm > side * start_mm;
  const double extra_mm = at_end ? target.overrun_mm : target.run_in_mm;
  throw Refusal(fmt::format(
      "the nose of the tool reaches {} = {:.6g} mm, {:.4g} mm past the shoulder at {:.6g} mm: {}{} "
      "the target at {:.6g} mm",
      along, reach, past_mm, shoulder,
      extra_mm > 0.0 ? fmt::format("lower {}, or ", at_end ? "overrun_mm" : "run_in_mm") : "",
      at_end ? "end" : "start", (at_end ? target.end_mm() : target.start_mm()) - side * past_mm));
}

}  // namespace

Profile::Profile(const Axis& axis, const TargetSurface& target, const ToolSetup& tool,
                 std::vector<RepeatingMotion> motions)
    : target_(target), tool_(tool), motions_(std::move(motions)) {
  validate(target, tool);
  const bool face = target.kind == TargetKind::face;
  expects(motions_.empty() || (!face && side_of_tool(tool.angle_from_probe_rad) != 0),
          "a motion seen along X only for a tool along X");
  const double z_ref = face ? target.z_face_mm : target.z_start_mm;
  const auto [x, y] = axis.at(z_ref);
  about_target_ = {
      {x, y, axis.slope_x, axis.slope_y, z_ref}, target.radius_mm, target.tan_half_angle};
  about_spindle_ = {{0.0, 0.0, 0.0, 0.0, z_ref}, target.radius_mm, target.tan_half_angle};

  start_mm_ = face ? target.path_start_mm() : centre_over_mm(target.path_start_mm());
  end_mm_ = face ? target.path_end_mm() : centre_over_mm(target.path_end_mm());
  const double travel = end_mm_ - start_mm_;
  if (!face && !(travel * (target.z_end_mm - target.z_start_mm) > 0.0))
    refuse_miss("the tool's nose does not fit the target surface", tool.c_start_rad, start_mm_);
  check_shoulder(target, tool, start_mm_, end_mm_);
  feed_mm_per_rev_ = std::copysign(tool.feed_mm_per_rev, travel);
  turns_ = std::abs(travel) / tool.feed_mm_per_rev;
  const double revolutions = std::ceil(turns_ - 1e-9) + 1.0;
  expects(revolutions * tool.rows_per_revolution <= 2e8, "a table of 2e8 rows or fewer");
  revolutions_ = static_cast<std::size_t>(revolutions);
}

double Profile::position_after_mm(double turns) const {
  return turns < turns_ - 1e-9 ? start_mm_ + feed_mm_per_rev_ * turns : end_mm_;
}

double Profile::c_after_rad(double turns) const {
  return tool_.c_start_rad + tool_.sense * two_pi * turns;
}

double Profile::at(double c_rad, double position_mm) const {
  if (target_.kind == TargetKind::face) return face_mm(c_rad, position_mm);
  double followed = 0.0;
  for (const RepeatingMotion& motion : motions_)
    followed += motion_mm(motion, c_rad, position_mm, target_.tan_half_angle);
  return nose_centre_mm(about_target_, c_rad, position_mm) -
         nose_centre_mm(about_spindle_, c_rad, position_mm) +
         side_of_tool(tool_.angle_from_probe_rad) * followed;
}

double Profile::programmed_mm(double position_mm) const {
  return target_.kind == TargetKind::face ? target_.z_face_mm + tool_.nose_radius_mm
                                          : nose_centre_mm(about_spindle_, 0.0, position_mm);
}

// A face is touched at the X of the nose's centre: its section has no slope.
double Profile::centre_over_mm(double z_mm) const {
  const Intersection hit = intersect(about_spindle_, 0.0, z_mm, tool_.height_mm);
  if (!hit.hit) refuse_miss("the tool's line misses the target surface", 0.0, z_mm);
  const double nose = target_.bore ? -tool_.nose_radius_mm : tool_.nose_radius_mm;
  return z_mm - nose * hit.dx_dz / std::sqrt(1.0 + hit.dx_dz * hit.dx_dz);
}

// The tool's line in its own frame is Y = height; that frame is the probe's turned by the angle
// from probe to tool. In the rake plane the nose circle touches the section X(z) at z_c:
//   X_centre = X(z_c) ± r_n/√(1+s²),  Z_centre = z_c ∓ r_n s/√(1+s²),  s = ∂X/∂z  (bore: lower
//   signs).
double Profile::nose_centre_mm(const Revolved& surface, double c_rad, double z_mm) const {
  const double c_part = c_rad + tool_.angle_from_probe_rad;
  const double nose = target_.bore ? -tool_.nose_radius_mm : tool_.nose_radius_mm;
  double z_contact = z_mm;
  for (int i = 0; i < 60; ++i) {
    const Intersection hit = intersect(surface, c_part, z_contact, tool_.height_mm);
    if (!hit.hit) refuse_miss("the tool's line misses the target surface", c_rad, z_contact);
    const double secant = std::sqrt(1.0 + hit.dx_dz * hit.dx_dz);
    // A straight section needs one correction; contraction is r_n times the section's curvature.
    const double next = z_mm + nose * hit.dx_dz / secant;
    const double moved = next - z_contact;
    if (std::abs(moved) < 1e-11) return hit.x_mm + hit.dx_dz * moved + nose / secant;
    z_contact = next;
  }
  refuse_miss("the tool's nose does not fit the target surface", c_rad, z_mm);
}

// Z(X) of the plane through the axis point at z_face, perpendicular to the axis, on the tool's
// line: a straight line of slope −(slope_x cos C + slope_y sin C); the nose's centre lies r_n
// √(1+slope²) above it in Z, r_n above the nominal face.
double Profile::face_mm(double c_rad, double x_mm) const {
  const double c_part = c_rad + tool_.angle_from_probe_rad;
  const Axis& axis = about_target_.axis;
  const double cos_c = std::cos(c_part), sin_c = std::sin(c_part);
  const double px = x_mm * cos_c - tool_.height_mm * sin_c - axis.x_mm;
  const double py = x_mm * sin_c + tool_.height_mm * cos_c - axis.y_mm;
  const double slope = axis.slope_x * cos_c + axis.slope_y * sin_c;
  const double raised = slope * slope / (1.0 + std::sqrt(1.0 + slope * slope));  // √(1+s²) − 1
  return -(axis.slope_x * px + axis.slope_y * py) + tool_.nose_radius_mm * raised;
}

double motion_mm(const RepeatingMotion& motion, double c_rad, double z_mm, double dx_dz) {
  static constexpr double zero = 0.0, one = 1.0;
  const std::span<const double> none(&zero, 1);
  TermContext at{};
  at.c_rad = {&c_rad, 1};
  at.z_mm = {&z_mm, 1};
  at.dx_dz = {&dx_dz, 1};
  at.time_s = at.speed_rad_per_s = at.velocity_mm_per_s = at.x_mm = at.sensed_mm = at.dx_dc = none;
  at.theta_rad = at.theta_chuck_rad = at.s_mm = none;
  at.clamp_force_ratio = {&one, 1};
  at.z_mid_mm = motion.z_mid_mm;
  at.z_half_mm = motion.z_half_mm;
  constexpr std::size_t most = 32;
  std::array<double, most> value{};
  std::array<double*, most> columns{};
  const std::vector<double>& linear = motion.term.linear;
  expects(linear.size() <= most, "a motion of 32 parameters or fewer");
  for (std::size_t j = 0; j < most; ++j) columns[j] = &value[j];
  fill_columns(motion.term.effect->term, at, motion.term.shape,
               std::span(columns).first(linear.size()));
  double sum = 0.0;
  for (std::size_t j = 0; j < linear.size(); ++j) sum += linear[j] * value[j];
  return sum;
}

int side_of_tool(double angle_from_probe_rad) {
  constexpr double aligned = 1.0 - 1e-6;  // 0.08°: the residual is 1e-6 of the motion
  const double cosine = std::cos(angle_from_probe_rad);
  return cosine > aligned ? 1 : cosine < -aligned ? -1 : 0;
}

}  // namespace trueaxis

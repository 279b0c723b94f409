// SPDX-License-Identifier: Apache-2.0
#include "simulate/axis_at_end.hpp"

#include <cmath>

#include "simulate/body.hpp"

namespace trueaxis::virtual_lathe {
namespace {

constexpr int sections = 1000;  // the nearest line of a parabola is off by 1e-6 of its sagitta

/// A point of the part in the spindle's frame.
Vec3 spindle_from_part(const RigidFrame& frame, const Vec3& p) {
  return frame.origin + p.x * frame.ex + p.y * frame.ey + p.z * frame.ez;
}

/// Sums over the sections for the straight line of a coordinate over z.
struct Course {
  double of_z = 0.0, of_value = 0.0, zz = 0.0, zv = 0.0;
  void add(double z, double value) { of_z += z, of_value += value, zz += z * z, zv += z * value; }
  double slope() const { return (zv - of_z * of_value / sections) / (zz - of_z * of_z / sections); }
  double at_zero() const { return (of_value - slope() * of_z) / sections; }
};

}  // namespace

std::optional<StraightAxis> axis_at_end(const Scenario& scenario, const Chucking& setup,
                                        double low_mm, double high_mm, double end_s) {
  const Chain chain = make_chain(scenario.effects);
  if (chain.bend.empty() && chain.step.empty()) return std::nullopt;
  const RigidFrame frame = part_frame(scenario.part, setup);
  PartStep moved;
  for (const auto& term : chain.step) {
    const PartStep step = term(end_s);
    moved.turn_rad += step.turn_rad;
    moved.dx_mm += step.dx_mm, moved.dy_mm += step.dy_mm, moved.dz_mm += step.dz_mm;
    moved.tilt_x_rad += step.tilt_x_rad, moved.tilt_y_rad += step.tilt_y_rad;
  }
  const RigidFrame seat = RigidFrame::about({moved.dx_mm, moved.dy_mm, moved.dz_mm},
                                            moved.tilt_x_rad, moved.tilt_y_rad);
  const SpindleAngle turn(moved.turn_rad);
  const SpindleAngle reindexed(-setup.reindex_rad);  // as the part carries its bow
  Course x, y;
  for (int i = 0; i < sections; ++i) {
    const double z = low_mm + (high_mm - low_mm) * (i + 0.5) / sections - setup.z_shift_mm;
    Vec3 p{0.0, 0.0, z};
    for (const auto& bend : chain.bend) p = p + reindexed.spindle_from_machine(bend(z));
    const Vec3 now =
        turn.spindle_from_machine(spindle_from_part(seat, spindle_from_part(frame, p)));
    x.add(now.z, now.x);
    y.add(now.z, now.y);
  }
  const double n = 1.0 / std::hypot(1.0, x.slope(), y.slope());
  return StraightAxis{x.at_zero(), y.at_zero(), n * x.slope(), n * y.slope()};
}

}  // namespace trueaxis::virtual_lathe

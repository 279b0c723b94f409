// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "compensate/largest_on_way.hpp"
#include "compensate/nominal_way.hpp"
#include "job/machine/machine_job_steps.hpp"
#include "machine/algebra.hpp"

namespace trueaxis::machine_job {
namespace {

using Eigen::Vector3d;

/// A block, a curve on which axes go evenly, or a chord of an arc: by the parabola through its ends
/// and the middle of its arc.
class WayBefore {
 public:
  WayBefore(const MachineModel& model, const ProgramEnd& from, const ProgramEnd& to,
            const RigidFit::Body& part)
      : model_(model),
        from_(from),
        to_(to),
        part_(part),
        bed_from_program_(rigid::motion(to.setting.bed_from_program)),
        start_(nominal_tip(from.commanded)),
        line_(nominal_tip(to.commanded) - start_),
        by_axes_(!to.middle && !to.along_tip && means_own_way(from.commanded, to.commanded)) {
    if (to.middle) bow_ = 4.0 * (nominal_tip(*to.middle) - start_ - 0.5 * line_);
  }

  double off_mm(double s) const {
    AxisPositions axes = mix(from_.commanded, to_.commanded, s);
    const Vector3d point =
        by_axes_ ? nominal_tip(axes) : Vector3d(start_ + s * line_ + s * (1.0 - s) * bow_);
    if (to_.middle && s == 0.5) axes = *to_.middle;
    if (to_.along_tip)
      axes = axes_for_tip(model_, rigid::array(point), axes, to_.setting).value_or(axes);
    const Vector3d tip = rigid::eigen(model_.actual(axes, to_.setting).tip_mm);
    const Vector3d of_part = bed_from_program_.R.transpose() * part_.at(bed_from_program_ * point);
    if (!by_axes_ && !to_.middle) return off_line_mm(tip - of_part);
    return across_mm(tip - of_part - point, tangent(s, point));
  }

  double largest_mm(double of_interest_mm) const {
    if (to_.middle) return std::max({off_mm(0.0), off_mm(0.5), off_mm(1.0)});
    double turn = 0.0;
    for (std::size_t k = 3; k < axis_count; ++k)
      turn += std::abs(to_.commanded[k] - from_.commanded[k]);
    const auto parts =
        2 * static_cast<std::size_t>(std::ceil(std::min(turn / even_turn_rad, 250.0)) + 1);
    const auto off = [this](double s) { return off_mm(s); };
    return LargestOnWay(off, parts).value(of_interest_mm);
  }

 private:
  Vector3d nominal_tip(const AxisPositions& axes) const {
    return rigid::eigen(model_.nominal(axes, to_.setting).tip_mm);
  }
  double off_line_mm(const Vector3d& tip) const {
    const Vector3d off = tip - start_;
    const double square = line_.squaredNorm();
    const double along = square > 0.0 ? std::clamp(off.dot(line_) / square, 0.0, 1.0) : 0.0;
    return (off - along * line_).norm();
  }
  Vector3d tangent(double s, const Vector3d& point) const {
    constexpr double ahead = 1e-4;
    if (!by_axes_) return line_ + (1.0 - 2.0 * s) * bow_;
    return nominal_tip(mix(from_.commanded, to_.commanded, s + ahead)) - point;
  }
  static double across_mm(const Vector3d& off, const Vector3d& tangent) {
    const double square = tangent.squaredNorm();
    return square > 0.0 ? (off - off.dot(tangent) / square * tangent).norm() : off.norm();
  }

  const MachineModel& model_;
  const ProgramEnd &from_, &to_;
  const RigidFit::Body& part_;
  rigid::Motion bed_from_program_;
  Vector3d start_, line_, bow_ = Vector3d::Zero();
  bool by_axes_;
};

}  // namespace

LargestInProgram off_between_before(const MachineModel& model, const std::vector<ProgramEnd>& ends,
                                    const RigidFit::Body& part) {
  LargestInProgram largest;
  for (std::size_t i = 1; i < ends.size(); ++i) {
    if (ends[i].rapid || !ends[i].continues) continue;
    const double off_mm = WayBefore(model, ends[i - 1], ends[i], part).largest_mm(largest.value);
    if (largest.line == 0 || off_mm > largest.value) largest = {off_mm, ends[i].line};
  }
  return largest;
}

}  // namespace trueaxis::machine_job

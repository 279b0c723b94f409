// SPDX-License-Identifier: Apache-2.0
#include "simulate/machine/measure.hpp"

#include <cmath>

#include "simulate/machine/linear_axes.hpp"
#include "simulate/variates.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis::virtual_machine {
namespace {

constexpr std::uint32_t reading_noise = 31;  // purpose of the random numbers

Vector3 minus(const Vector3& a, const Vector3& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

/// Plays a plan, row by row: where the axes come from and how long it took is remembered.
class Session {
 public:
  Session(const Machine& machine, const ErrorModel& errors, const MeasurementPlan& plan)
      : machine_(machine), errors_(errors), plan_(plan), bits_(plan.seed, reading_noise) {
    for (const MachineAxis& axis : machine.axes)
      if (!is_rotary(axis.name)) linear_.push_back(index_of(axis.name));
  }

  std::vector<MeasuredRow> ball() {
    for (const AxisPositions& rotary : plan_.positions) {
      for (std::size_t b = 0; b < plan_.balls_mm.size(); ++b) {
        MeasuredRow row = at(rotary, b);
        approach(row.axes = following(World::nominal, rotary, b, {}));
        if (plan_.centred)
          row.axes = following(World::real, row.axes, b, {});
        else
          row.deviation_mm = deviation(World::real, row.axes, b);
        read(row, plan_.centred);
      }
    }
    return std::move(rows_);
  }

  std::vector<MeasuredRow> bar() {
    for (const AxisPositions& rotary : plan_.positions) {
      for (std::size_t b = 0; b < plan_.balls_mm.size(); ++b) {
        for (const Vector3& to_tip : plan_.bar_mm) {
          MeasuredRow row = at(rotary, b);
          approach(row.axes = following(World::nominal, rotary, b, to_tip));
          const Vector3 d = deviation(World::real, row.axes, b);
          row.length_mm = std::hypot(d[0], d[1], d[2]) + noise();
          keep(row);
        }
      }
    }
    return std::move(rows_);
  }

  std::vector<MeasuredRow> array() {
    const Vector3& first = plan_.balls_mm.front();
    for (std::size_t b = 0; b < plan_.balls_mm.size(); ++b) {
      MeasuredRow row = at(plan_.positions.front(), b);
      approach(row.axes = following(World::nominal, row.axes, b, {}));
      row.axes = following(World::real, row.axes, b, {});
      const Vector3 from_first = minus(plan_.balls_mm[b], first);
      row.along_mm = std::hypot(from_first[0], from_first[1], from_first[2]);
      read(row, true);
    }
    return std::move(rows_);
  }

  std::vector<MeasuredRow> axis() {
    for (const AxisPositions& position : plan_.positions) {
      MeasuredRow row = at(position, 0);
      row.axes = position;
      approach(position);
      const double q = position[index_of(plan_.axis)];
      row.actual =
          q + own_error(machine_, errors_, plan_.axis, q) + lost_[index_of(plan_.axis)] + noise();
      keep(row);
    }
    return std::move(rows_);
  }

 private:
  MeasuredRow at(const AxisPositions& rotary, std::size_t ball) const {
    MeasuredRow row;
    row.ball = static_cast<int>(ball) + 1;
    row.axes = rotary;
    row.time_s = plan_.pace_s * static_cast<double>(rows_.size());
    return row;
  }

  double noise() { return plan_.noise_mm * virtual_lathe::normal_variate(bits_); }

  enum class World { nominal, real };  ///< without or with errors, lost motion, drift and slip

  /// Ball centre − tip, in M.
  Vector3 deviation(World world, const AxisPositions& axes, std::size_t ball) const {
    Vector3 centre = plan_.balls_mm[ball];
    if (world == World::nominal) {
      const Ends at = ends(machine_, {}, axes);
      return minus(transformed(at.bed_from_table, centre),
                   tip_mm(machine_, at, plan_.tool_length_mm));
    }
    const Disturbance& by = plan_.disturbance;
    const bool slipped = by.slip_after > 0 && rows_.size() >= by.slip_after;
    for (std::size_t i = 0; slipped && i < 3; ++i) centre[i] += by.slip_mm[i];
    const Ends at = ends(machine_, errors_, axes, lost_);
    Vector3 d =
        minus(transformed(at.bed_from_table, centre), tip_mm(machine_, at, plan_.tool_length_mm));
    const double time_s = plan_.pace_s * static_cast<double>(rows_.size());
    for (std::size_t i = 0; i < 3; ++i) d[i] += by.drift_mm_per_s[i] * time_s;
    return d;
  }

  /// The linear axes that put the tip `to_tip` off the ball; the rotary ones stay.
  AxisPositions following(World world, AxisPositions axes, std::size_t ball,
                          const Vector3& to_tip) const {
    const auto off_mm = [&](const AxisPositions& at) {
      Vector3 off = deviation(world, at, ball);
      for (std::size_t i = 0; i < 3; ++i) off[i] += to_tip[i];
      return off;
    };
    if (!follow_with_linear_axes(machine_, off_mm, axes))
      throw InputError(machine_.name,
                       "the linear axes cannot follow a ball in space: a measurement of a ball "
                       "needs three of them");
    return axes;
  }

  void approach(const AxisPositions& to) {
    if (!rows_.empty()) take_lost_motion(plan_.disturbance.reversal, from_, to, lost_);
    from_ = to;
  }

  /// Noise on what is read: the axes where the ball was centred, else the deviation.
  void read(MeasuredRow& row, bool centred) {
    for (std::size_t i = 0; i < 3; ++i) {
      if (centred)
        row.axes[linear_[i]] += noise();
      else
        row.deviation_mm[i] += noise();
    }
    keep(row);
  }

  void keep(const MeasuredRow& row) { rows_.push_back(row); }

  const Machine& machine_;
  const ErrorModel& errors_;
  const MeasurementPlan& plan_;
  virtual_lathe::Xoshiro bits_;
  std::vector<std::size_t> linear_;
  std::vector<MeasuredRow> rows_;
  AxisPositions from_{}, lost_{};
};

}  // namespace

std::vector<MeasuredRow> measure(const Machine& machine, const ErrorModel& errors,
                                 const MeasurementPlan& plan) {
  Session session(machine, errors, plan);
  switch (plan.kind) {
    case MeasurementKind::ball:
      return session.ball();
    case MeasurementKind::bar:
      return session.bar();
    case MeasurementKind::array:
      return session.array();
    case MeasurementKind::axis:
      return session.axis();
  }
  return {};
}

}  // namespace trueaxis::virtual_machine

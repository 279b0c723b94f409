// SPDX-License-Identifier: Apache-2.0
#include "simulate/machine/bodies.hpp"

#include <algorithm>
#include <cmath>
#include <complex>

namespace trueaxis::virtual_machine {
namespace {

double evaluated(const ConstantError& error, double) { return error.value; }

double evaluated(const PolynomialError& error, double q) {
  double sum = 0.0;
  for (std::size_t i = error.coefficients.size(); i-- > 0;)
    sum = sum * (q - error.origin) / error.scale + error.coefficients[i];
  return sum;
}

double evaluated(const FourierError& error, double q) {
  std::complex<double> sum = 0.0;  // a cos + b sin is the real part of (a − ib) e^{i…}
  for (const FourierError::Term& term : error.terms)
    sum +=
        std::complex(term.cos, -term.sin) * std::polar(1.0, two_pi * term.order * q / error.period);
  return sum.real();
}

double evaluated(const TableError& error, double q) {
  const double first = error.at.front(), last = error.at.back();
  if (error.periodic) q -= std::floor((q - first) / (last - first)) * (last - first);
  q = std::clamp(q, first, last);
  std::size_t k = 1;
  while (k + 1 < error.at.size() && error.at[k] < q) ++k;
  if (error.at.size() == 1) return error.values.front();
  const double share = (q - error.at[k - 1]) / (error.at[k] - error.at[k - 1]);
  return std::lerp(error.values[k - 1], error.values[k], share);
}

/// Errors of a body along X Y Z and about them: those of its place, and of its motion.
struct BodyErrors {
  Vector3 shift{}, tilt{}, along{}, turn{};
};

/// @param position of the body's axis
BodyErrors of_body(const ErrorModel& errors, std::size_t body, double position) {
  BodyErrors out;
  for (const ErrorTerm& term : errors.terms) {
    const ErrorName& name = term.name;
    if (name.body != body) continue;
    Vector3& turn = name.component ? out.turn : out.tilt;
    Vector3& along = name.component ? out.along : out.shift;
    const double at = name.component ? position : 0.0;
    (name.direction < 3 ? along[name.direction] : turn[name.direction - 3]) +=
        std::visit([&](const auto& f) { return evaluated(f, at); }, term.function);
  }
  return out;
}

Vector3 negative(const Vector3& v) { return {-v[0], -v[1], -v[2]}; }

Vector3 plus(const Vector3& a, const Vector3& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }

/// The motion, and then a translation.
Homogeneous then(Homogeneous motion, const Vector3& by_mm) {
  for (std::size_t i = 0; i < 3; ++i) motion[i][3] += by_mm[i];
  return motion;
}

/// The motion after a translation.
Homogeneous after(const Vector3& by_mm, Homogeneous motion) {
  const Vector3 at = transformed(motion, by_mm);
  for (std::size_t i = 0; i < 3; ++i) motion[i][3] = at[i];
  return motion;
}

Homogeneous about(const Vector3& point, const Homogeneous& turn) {
  return then(after(negative(point), turn), point);
}

/// A body against its neighbour nearer to the bed: +1 on the tool's side, −1 on the workpiece's.
Homogeneous moved(const MachineAxis& axis, const ErrorModel& errors, double q, double lost) {
  const std::size_t body = index_of(axis.name), letter = body % 3;
  const bool rotary = is_rotary(axis.name);
  const double sense = axis.carries_workpiece ? -1.0 : 1.0;
  auto [shift, tilt, along, turn] = of_body(errors, body, q);
  double& own = rotary ? tilt[letter] : shift[letter];
  const double at = sense * (q + own + lost);
  own = 0.0;
  Vector3 direction = transformed(rotation(tilt), axis.direction);
  Homogeneous error = then(rotation(turn), along);
  if (axis.carries_workpiece && errors.sign == ErrorSign::tool_minus_workpiece)
    error = inverse(error);
  if (!rotary) {
    for (double& component : direction) component *= at;
    return then(about(errors.reference_mm[body], error), direction);
  }
  const Vector3 point = plus(axis.point_mm, shift);
  return then(product(error, after(negative(point), rotation(direction, at))), point);
}

}  // namespace

Homogeneous inverse(const Homogeneous& m) {
  Homogeneous out{};
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t column = 0; column < 3; ++column) {
      out[row][column] = m[column][row];
      out[row][3] -= m[column][row] * m[column][3];
    }
  }
  out[3][3] = 1.0;
  return out;
}

Homogeneous product(const Homogeneous& left, const Homogeneous& right) {
  Homogeneous out{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 4; ++j)
      out[i][j] = left[i][0] * right[0][j] + left[i][1] * right[1][j] + left[i][2] * right[2][j];
    out[i][3] += left[i][3];
  }
  out[3][3] = 1.0;
  return out;
}

Vector3 transformed(const Homogeneous& to_from, const Vector3& point_mm) {
  Vector3 out{};
  for (std::size_t i = 0; i < 3; ++i)
    out[i] = to_from[i][0] * point_mm[0] + to_from[i][1] * point_mm[1] +
             to_from[i][2] * point_mm[2] + to_from[i][3];
  return out;
}

Homogeneous translation(const Vector3& by_mm) {
  return {{{1, 0, 0, by_mm[0]}, {0, 1, 0, by_mm[1]}, {0, 0, 1, by_mm[2]}, {0, 0, 0, 1}}};
}

Homogeneous rotation(const Vector3& unit_axis, double angle_rad) {
  // By the unit quaternion of half the angle.
  const double w = std::cos(0.5 * angle_rad), s = std::sin(0.5 * angle_rad);
  const double x = s * unit_axis[0], y = s * unit_axis[1], z = s * unit_axis[2];
  return {{{1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w), 0},
           {2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w), 0},
           {2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y), 0},
           {0, 0, 0, 1}}};
}

Homogeneous rotation(const Vector3& w_rad) {
  const double angle = std::hypot(w_rad[0], w_rad[1], w_rad[2]);
  if (angle == 0.0) return translation({});
  return rotation({w_rad[0] / angle, w_rad[1] / angle, w_rad[2] / angle}, angle);
}

Ends ends(const Machine& machine, const ErrorModel& errors, const AxisPositions& axes,
          const AxisPositions& lost) {
  Ends out{translation({}), translation({})};
  // `axes` run from the workpiece to the tool: those of the workpiece are met last to first.
  for (auto axis = machine.axes.rbegin(); axis != machine.axes.rend(); ++axis) {
    const std::size_t i = index_of(axis->name);
    if (axis->carries_workpiece)
      out.bed_from_table = product(out.bed_from_table, moved(*axis, errors, axes[i], lost[i]));
  }
  for (const MachineAxis& axis : machine.axes) {
    const std::size_t i = index_of(axis.name);
    if (!axis.carries_workpiece)
      out.bed_from_spindle = product(out.bed_from_spindle, moved(axis, errors, axes[i], lost[i]));
  }
  const Vector3& gauge = machine.tool.gauge_point_mm;
  const BodyErrors held = of_body(errors, spindle_body, 0.0);
  const Homogeneous spindle = then(about(gauge, rotation(held.tilt)), held.shift);
  out.bed_from_spindle = product(out.bed_from_spindle, spindle);
  return out;
}

double own_error(const Machine& machine, const ErrorModel& errors, AxisName name, double position) {
  const MachineAxis& axis = *machine.find(name);
  const std::size_t body = index_of(name);
  // A carriage under the part that goes along with the tool's way takes it back from the tool.
  const bool back = axis.carries_workpiece && errors.sign == ErrorSign::moving_part;
  const BodyErrors all = of_body(errors, body, position);
  const Vector3& error = is_rotary(name) ? all.turn : all.along;
  double along = 0.0;
  for (std::size_t i = 0; i < 3; ++i) along += axis.direction[i] * error[i];
  return (back ? -along : along) + (is_rotary(name) ? all.tilt : all.shift)[body % 3];
}

Homogeneous part_on_table(const ErrorModel& errors) {
  const BodyErrors held = of_body(errors, workpiece_body, 0.0);
  return then(rotation(held.tilt), held.shift);
}

void take_lost_motion(const AxisPositions& reversal, const AxisPositions& from,
                      const AxisPositions& to, AxisPositions& lost) {
  for (std::size_t i = 0; i < axis_count; ++i)
    if (to[i] != from[i]) lost[i] = to[i] < from[i] ? reversal[i] : 0.0;
}

Vector3 tip_mm(const Machine& machine, const Ends& ends, double tool_length_mm) {
  Vector3 tip = machine.tool.gauge_point_mm;
  for (std::size_t i = 0; i < 3; ++i) tip[i] -= tool_length_mm * machine.tool.direction[i];
  return transformed(ends.bed_from_spindle, tip);
}

}  // namespace trueaxis::virtual_machine

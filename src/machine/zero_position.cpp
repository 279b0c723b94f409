// SPDX-License-Identifier: Apache-2.0
#include "machine/zero_position.hpp"

#include <algorithm>
#include <cmath>

#include "machine/algebra.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis {
namespace {

using Eigen::Vector3d;
using rigid::Motion;

Motion row_motion(const DenavitHartenbergRow::Numbers& row) {
  const Motion about_z{rigid::turn(Vector3d::UnitZ(), row.theta_rad), {0.0, 0.0, row.d_mm}};
  const Motion about_x{rigid::turn(Vector3d::UnitX(), row.alpha_rad), {row.a_mm, 0.0, 0.0}};
  return about_z * about_x;
}

bool has_errors(const DenavitHartenbergRow& row) {
  const auto& [theta, d, a, alpha] = row.errors;
  return theta != 0.0 || d != 0.0 || a != 0.0 || alpha != 0.0;
}

struct Frames {
  std::array<Motion, axis_count> before;  ///< frame i − 1 of the joint of every axis
  Motion last;
};

Frames frames_of(const DenavitHartenbergChain& chain, bool with_errors) {
  Frames frames;
  frames.last.t = rigid::eigen(chain.part_translation_mm);
  for (const DenavitHartenbergRow& row : chain.rows) {
    if (row.axis) frames.before[index_of(*row.axis)] = frames.last;
    DenavitHartenbergRow::Numbers numbers = row.nominal;
    if (with_errors) {
      numbers.theta_rad += row.errors.theta_rad;
      numbers.d_mm += row.errors.d_mm;
      numbers.a_mm += row.errors.a_mm;
      numbers.alpha_rad += row.errors.alpha_rad;
    }
    frames.last = frames.last * row_motion(numbers);
  }
  return frames;
}

/// The rotation vector w with w[own] = 0 that turns u into v, by Newton's method from w = 0: the
/// rest is turned by its own rotation vector, as far as the two free components can.
Vector3d tilt_between(const Vector3d& u, const Vector3d& v, Eigen::Index own, char letter) {
  Vector3d w = Vector3d::Zero();
  const Eigen::Index first = (own + 1) % 3, second = (own + 2) % 3;
  for (int i = 0;; ++i) {
    const Vector3d now = rigid::exponential(w) * u;
    const Vector3d left = v - now;
    if (i > 8 || left.norm() == 0.0) break;
    Eigen::Matrix<double, 3, 2> J;
    J.col(0) = Vector3d::Unit(first).cross(now);
    J.col(1) = Vector3d::Unit(second).cross(now);
    const Eigen::Matrix2d normal = J.transpose() * J;
    if (!(normal.determinant() > 1e-6)) break;
    const Eigen::Vector2d step = normal.inverse() * (J.transpose() * left);
    w[first] += step[0];
    w[second] += step[1];
  }
  if ((rigid::exponential(w) * u - v).norm() < 4e-15) return w;  // rounding
  throw InputError("dh",
                   std::string("errors of the rows before axis ") + letter +
                       " cannot be expressed as location errors: its line is not along its letter");
}

void add(ErrorModel& errors, std::size_t body, const Vector3d& values, bool angular) {
  for (std::size_t i = 0; i < 3; ++i) {
    const double value = values[static_cast<Eigen::Index>(i)];
    if (value != 0.0)
      errors.terms.push_back({{false, i + (angular ? 3 : 0), body}, ConstantError{value}});
  }
}

/// Letters' directions come out of sines with the rounding of π; a component below it is 0.
Vector3d cleaned(Vector3d v, double size) {
  for (double& component : v)
    if (std::abs(component) < 1e-15 * size) component = 0.0;
  return v;
}

}  // namespace

void to_zero_position(const DenavitHartenbergChain& chain, Machine& machine) {
  const Frames frames = frames_of(chain, false);
  for (MachineAxis& axis : machine.axes) {
    const Motion& before = frames.before[index_of(axis.name)];
    axis.direction = rigid::array(cleaned(before.R.col(2), 1.0).normalized());
    if (is_rotary(axis.name)) axis.point_mm = rigid::array(before.t);
  }
  machine.tool.gauge_point_mm = rigid::array(frames.last.t);
  machine.tool.direction = rigid::array(Vector3d(-cleaned(frames.last.R.col(2), 1.0).normalized()));
  machine.tool.length_mm = chain.tool_length_mm;
}

ErrorModel parameter_errors(const DenavitHartenbergChain& chain, const Machine& machine) {
  ErrorModel errors;
  if (std::ranges::none_of(chain.rows, has_errors)) return errors;
  const Frames nominal = frames_of(chain, false), actual = frames_of(chain, true);
  for (const MachineAxis& axis : machine.axes) {
    const std::size_t body = index_of(axis.name);
    const Motion &from = nominal.before[body], &to = actual.before[body];
    const auto own = static_cast<Eigen::Index>(body % 3);
    add(errors, body, tilt_between(from.R.col(2), to.R.col(2), own, letter_of(axis.name)), true);
    if (!is_rotary(axis.name)) continue;
    const Vector3d along = to.R.col(2), shift = to.t - from.t;
    add(errors, body, shift - along.dot(shift) * along, false);
  }
  // S = A N⁻¹ in the frame of the part, seen from the gauge point N.t: turned there and moved.
  const Eigen::Matrix3d R = actual.last.R * nominal.last.R.transpose();
  add(errors, spindle_body, actual.last.t - nominal.last.t, false);
  add(errors, spindle_body, rigid::rotation_vector(R), true);
  return errors;
}

}  // namespace trueaxis

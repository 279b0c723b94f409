// SPDX-License-Identifier: Apache-2.0
#include "machine/component_errors.hpp"

#include "machine/error_function.hpp"

namespace trueaxis {
namespace {

double& entry(ComponentErrors& errors, std::size_t direction) {
  return direction < 3 ? errors.shift[static_cast<Eigen::Index>(direction)]
                       : errors.rotation[static_cast<Eigen::Index>(direction - 3)];
}

}  // namespace

rigid::Motion ComponentErrors::motion(const Joint& joint) const {
  rigid::Motion e{Eigen::Matrix3d::Identity(), shift};
  if (!joint.turns) {
    if (joint.inverted) e.t = -shift;
    return e;
  }
  e.R = rigid::exponential(rotation);
  if (joint.inverted) e = e.inverse();
  return rigid::about(joint.actual_pivot, e.R, e.t);
}

ComponentErrors component_errors(const Joint& joint, double position) {
  ComponentErrors errors;
  FirstWave wave;
  for (const Joint::Component& one : joint.components)
    entry(errors, one.direction) += value_at(one.function, position, wave);
  return errors;
}

ComponentErrorsAndSlopes component_errors_and_slopes(const Joint& joint, double position) {
  ComponentErrorsAndSlopes both;
  FirstWave wave;
  for (const Joint::Component& one : joint.components) {
    const ValueAndSlope at = value_and_slope(one.function, position, wave);
    entry(both.errors, one.direction) += at.value;
    entry(both.slopes, one.direction) += at.slope;
  }
  return both;
}

}  // namespace trueaxis

// SPDX-License-Identifier: Apache-2.0
#include "compensate/single_errors.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "machine/component_errors.hpp"

namespace trueaxis {

using Eigen::Vector3d;

namespace {

/// |E p − p| and |E⁻¹ p − p| of one component error: a shift, or a turn about the pivot, whose
/// chord is 2 r sin(φ/2) at the distance r from its axis.
double moved_by(const Joint& joint, const ComponentErrors& errors, const Vector3d& point) {
  const double angle = errors.rotation.norm();
  if (angle == 0.0) return errors.shift.norm();
  const double radius = errors.rotation.cross(point - joint.pivot).norm() / angle;
  return 2.0 * radius * std::sin(0.5 * angle);
}

ComponentErrors only(const ComponentErrors& errors, std::size_t direction) {
  ComponentErrors out;
  const auto i = static_cast<Eigen::Index>(direction % 3);
  if (direction < 3)
    out.shift[i] = errors.shift[i];
  else
    out.rotation[i] = errors.rotation[i];
  return out;
}

}  // namespace

SingleErrors SingleErrors::of_names(const MachineModel& model) {
  SingleErrors out(model);
  out.whole_ = true;
  const std::vector<ErrorTerm>& terms = model.errors().terms;
  for (auto term = terms.begin(); term != terms.end(); ++term) {
    const auto same = [&](const ErrorTerm& other) { return other.name == term->name; };
    if (std::find_if(terms.begin(), term, same) != term) continue;
    std::vector<ErrorTerm> of_name;
    std::ranges::copy_if(terms, std::back_inserter(of_name), same);
    out.add(term->name, std::move(of_name));
  }
  return out;
}

void SingleErrors::add(const ErrorName& name, std::vector<ErrorTerm> terms) {
  ErrorModel errors = all_.errors();
  errors.terms = std::move(terms);
  std::size_t joint = name.body == spindle_body ? of_spindle : of_workpiece;
  if (name.body < axis_count) {
    const auto& joints = all_.compiled().joints;
    const auto found = std::ranges::find(joints, name.body, &Joint::axis);
    joint = static_cast<std::size_t>(found - joints.begin());
  }
  errors_.push_back({MachineModel(all_.machine(), errors), joint, name.component, name.direction});
  names_.push_back(to_string(name));
}

void SingleErrors::tip_mm(const AxisPositions& axes, const Setting& setting,
                          std::span<double> out) const {
  const auto& joints = all_.compiled().joints;
  // The tip seen from the far side of each joint, and from its near side.
  std::array<Vector3d, axis_count> far, near;
  const Vector3d tip = all_.compiled().tip(setting);
  Vector3d point = tip;
  for (std::size_t k = joints.size(); k-- > 0;) {
    far[k] = point;
    point = joints[k].nominal(rigid::Motion{}, joints[k].position(axes)) * point;
    near[k] = point;
  }
  std::array<ComponentErrors, axis_count> together;
  for (std::size_t k = 0; whole_ && k < joints.size(); ++k)
    together[k] = component_errors(joints[k], joints[k].position(axes));
  const Vector3d in_part = rigid::motion(setting.bed_from_program).inverse() * point;
  for (std::size_t i = 0; i < errors_.size(); ++i) {
    const One& one = errors_[i];
    const MachineModel::Compiled& alone = one.model.compiled();
    if (one.joint == of_spindle) {
      out[i] = (alone.spindle * tip - tip).norm();
    } else if (one.joint == of_workpiece) {
      out[i] = (alone.workpiece.inverse() * in_part - in_part).norm();
    } else {
      const Joint& joint = alone.joints[one.joint];
      const double position = joint.position(axes);
      if (one.component) {
        out[i] = moved_by(
            joint,
            whole_ ? only(together[one.joint], one.direction) : component_errors(joint, position),
            joint.errors_first ? near[one.joint] : far[one.joint]);
      } else {
        out[i] =
            (joint.actual(rigid::Motion{}, position) * far[one.joint] - near[one.joint]).norm();
      }
    }
  }
}

}  // namespace trueaxis

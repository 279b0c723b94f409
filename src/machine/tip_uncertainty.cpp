// SPDX-License-Identifier: Apache-2.0
#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "machine/screw.hpp"
#include "machine/uncertainty.hpp"
#include "math/covariance.hpp"
#include "math/linear_algebra.hpp"

namespace trueaxis {
namespace {

using Eigen::Index;
using Eigen::Matrix3Xd;
using Eigen::MatrixXd;
using Eigen::VectorXd;

}  // namespace

TipUncertainty::TipUncertainty(const MachineModel& model) : model_(model) {
  const ErrorModel& errors = model.errors();
  const auto& correlated = errors.covariance.names();
  if (!correlated.empty()) {
    const linear::PivotedRoot root = linear::pivoted_root(matrix_of(errors.covariance));
    for (const int i : root.order) {
      const UncertainAmount& amount = correlated[static_cast<std::size_t>(i)];
      add(amount.name, amount.unit());
    }
    root_ = root.lower.cast<float>();
  }
  std::vector<double> u;
  for (const ErrorTerm& term : errors.terms) {
    if (!(term.u > 0.0) || without_effect(term.name)) continue;
    add(term.name, ConstantError{1.0});
    u.push_back(term.u);
  }
  u_ = Eigen::Map<const VectorXd>(u.data(), static_cast<Index>(u.size()));
}

void TipUncertainty::add(const ErrorName& name, ErrorFunction function) {
  const auto& joints = model_.compiled().joints;
  std::size_t joint = joints.size() + (name.body == workpiece_body ? 1 : 0);
  if (name.body < axis_count)
    joint = static_cast<std::size_t>(std::ranges::find(joints, name.body, &Joint::axis) -
                                     joints.begin());
  amounts_.push_back({joint, name.direction + (name.component ? 0 : 6), std::move(function)});
}

Matrix3Xd TipUncertainty::moved(const AxisPositions& axes, const Setting& setting) const {
  const auto& compiled = model_.compiled();
  const std::vector<UnitTips> units = unit_tips(compiled, axes, setting);
  Matrix3Xd out(3, static_cast<Index>(amounts_.size()));
  for (std::size_t i = 0; i < amounts_.size(); ++i) {
    const Amount& one = amounts_[i];
    const double position =
        one.joint < compiled.joints.size() ? compiled.joints[one.joint].position(axes) : 0.0;
    out.col(static_cast<Index>(i)) =
        value_at(one.function, position) * units[one.joint].col(static_cast<Index>(one.column));
  }
  return out;
}

Matrix3Xd TipUncertainty::causes(const AxisPositions& axes, const Setting& setting) const {
  Matrix3Xd all = moved(axes, setting);
  all.rightCols(u_.size()) *= u_.asDiagonal();
  const Index n = root_.rows();
  const Eigen::MatrixXd root = root_.triangularView<Eigen::Lower>().toDenseMatrix().cast<double>();
  if (n > 0) all.leftCols(n) = linear::product(all.leftCols(n), root);
  return all;
}

Matrix3 TipUncertainty::covariance_mm2(const AxisPositions& axes, const Setting& setting) const {
  const Matrix3Xd all = moved(axes, setting);
  const Matrix3Xd alone = all.rightCols(u_.size()) * u_.asDiagonal();
  Eigen::Matrix3d sum = alone * alone.transpose();
  const Index n = root_.rows();
  const Eigen::MatrixX3f together = all.leftCols(n).transpose().cast<float>();
  for (Index j = 0; j < n; ++j) {
    const auto below = root_.col(j).tail(n - j);
    const Eigen::Vector3d one(together.col(0).tail(n - j).dot(below),
                              together.col(1).tail(n - j).dot(below),
                              together.col(2).tail(n - j).dot(below));
    sum += one * one.transpose();
  }
  return rigid::rows(sum);
}

double TipUncertainty::u_mm(const AxisPositions& axes, const Setting& setting) const {
  const Matrix3 covariance = covariance_mm2(axes, setting);
  return std::sqrt(covariance[0][0] + covariance[1][1] + covariance[2][2]);
}

}  // namespace trueaxis

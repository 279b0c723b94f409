// SPDX-License-Identifier: Apache-2.0
#include "machine/correction_step.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "math/linear_algebra.hpp"

namespace trueaxis {
namespace {

using Eigen::Index;
using Eigen::Vector3d;

/// y of M y + c with the components of `at` that are not free held there: of least length.
SmallVector least_with_held(const SmallMatrix& M, const Vector3d& c, const SmallVector& at,
                            const Eigen::Array<bool, Eigen::Dynamic, 1, 0, 6, 1>& free) {
  Vector3d rest = c;
  Eigen::MatrixXd columns(3, 0);
  for (Index i = 0; i < M.cols(); ++i) {
    if (free[i]) {
      columns.conservativeResize(3, columns.cols() + 1);
      columns.col(columns.cols() - 1) = M.col(i);
    } else {
      rest += at[i] * M.col(i);
    }
  }
  SmallVector y = at;
  if (columns.cols() == 0) return y;
  const Eigen::VectorXd solved = linear::least_squares(columns, Eigen::VectorXd(-rest), 1e-13);
  for (Index i = 0, k = 0; i < M.cols(); ++i)
    if (free[i]) y[i] = solved[k++];
  return y;
}

bool inside(const SmallVector& y, const SmallVector& bound) {
  for (Index i = 0; i < y.size(); ++i)
    if (std::abs(y[i]) > bound[i] * (1.0 + 1e-12)) return false;
  return true;
}

/// Two columns far from parallel: their normal equations, which is nearly every position.
bool solved_at_once(const SmallMatrix& M, const Vector3d& c, SmallVector& y) {
  if (M.cols() != 2) return false;
  const Vector3d a = M.col(0), b = M.col(1);
  const double aa = a.squaredNorm(), bb = b.squaredNorm(), ab = a.dot(b);
  const double det = aa * bb - ab * ab;
  if (!(det > 1e-4 * aa * bb)) return false;
  const double ca = -c.dot(a), cb = -c.dot(b);
  y.resize(2);
  y << (bb * ca - ab * cb) / det, (aa * cb - ab * ca) / det;
  return true;
}

/// The least on the border of a rectangle: on each of its four sides the other variable is the
/// least one of its line, or an end of it.
SmallVector least_on_border(const SmallMatrix& M, const Vector3d& c, const SmallVector& bound) {
  SmallVector best(2);
  double least = INFINITY;
  for (const Index held : {Index{0}, Index{1}}) {
    for (const double side : {1.0, -1.0}) {
      const Vector3d rest = c + side * bound[held] * M.col(held), other = M.col(1 - held);
      const double square = other.squaredNorm(), limit = bound[1 - held];
      SmallVector y(2);
      y[held] = side * bound[held];
      y[1 - held] = square > 0.0 ? std::clamp(-rest.dot(other) / square, -limit, limit) : 0.0;
      const double size = (rest + y[1 - held] * other).norm();
      if (size < least) {
        least = size;
        best = y;
      }
    }
  }
  return best;
}

}  // namespace

SmallVector bounded_least_squares(const SmallMatrix& M, const Vector3d& c,
                                  const SmallVector& bound) {
  const Index n = M.cols();
  SmallVector y = SmallVector::Zero(n);
  Eigen::Array<bool, Eigen::Dynamic, 1, 0, 6, 1> free(n);
  free.setConstant(true);
  if (!solved_at_once(M, c, y)) y = least_with_held(M, c, y, free);
  if (inside(y, bound)) return y;
  if (n == 2 && bound.allFinite()) return least_on_border(M, c, bound);
  SmallVector best = SmallVector::Zero(n);
  double least = INFINITY;
  int choices = 1;
  for (Index i = 0; i < n; ++i) choices *= std::isfinite(bound[i]) ? 3 : 1;
  for (int choice = 1; choice < choices; ++choice) {  // 0 is the one with none on its bound
    SmallVector at = SmallVector::Zero(n);
    for (Index i = 0, digits = choice; i < n; ++i) {
      if (!std::isfinite(bound[i])) continue;
      const Index digit = digits % 3;
      digits /= 3;
      free[i] = digit == 0;
      at[i] = digit == 1 ? bound[i] : digit == 2 ? -bound[i] : 0.0;
    }
    const SmallVector tried = least_with_held(M, c, at, free);
    if (!inside(tried, bound)) continue;
    const double size = (M * tried + c).norm();
    const bool better = size < least * (1.0 - 1e-12);
    if (better || (size <= least * (1.0 + 1e-12) && tried.norm() < best.norm())) {
      least = size;
      best = tried;
    }
  }
  return best;
}

namespace {

constexpr double spanning = 1e-3;  ///< volume of the linear axes' directions that spans space
constexpr double weak = 0.05;      ///< turn of the direction over that of the axes: near a pole

}  // namespace

CorrectionStep::CorrectionStep(const MachineModel::Compiled& machine, const ToolMotion& motion,
                               const HeldAxes& held) {
  const Vector3d direction = motion.direction(machine);
  const auto add = [&](const Joint& joint, Columns& columns) {
    const Screw& screw = motion.axes[joint.axis];
    columns.add({joint.axis, screw.of_point(motion.tool.t), screw.w.cross(direction)});
  };
  for (const Joint& joint : machine.joints)
    if (!joint.rotary) add(joint, linear_);
  if (linear_.count == 3) {
    Eigen::Matrix3d tip;
    tip << linear_.all[0].tip, linear_.all[1].tip, linear_.all[2].tip;
    spans_ = std::abs(tip.determinant()) > spanning;
    if (spans_) tip_inverse_ = tip.inverse();
  }
  for (const Joint& joint : machine.joints)
    if (joint.rotary && !(spans_ && held.holds(joint.axis))) add(joint, rotary_);
  if (spans_) weigh();
}

/// Directions in which the tool turns, by how far a turn of the axes turns it: where that is little
/// the correction is bounded by what it gains.
void CorrectionStep::weigh() {
  // The linear axes take the tip along: their turning the tool is what their errors do.
  Eigen::Matrix3d turning;
  turning << linear_.all[0].direction, linear_.all[1].direction, linear_.all[2].direction;
  by_tip_ = turning * tip_inverse_;
  const std::size_t n = rotary_.count;
  turning_.resize(3, static_cast<Index>(n));
  for (std::size_t i = 0; i < n; ++i)
    turning_.col(static_cast<Index>(i)) = rotary_.all[i].direction - by_tip_ * rotary_.all[i].tip;
  if (n == 0) return;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(
      Eigen::Matrix3d(turning_ * turning_.transpose()));
  worth_.setZero();
  // The tool's own direction, which nothing turns, is the weakest; one axis turns one other way.
  for (Index i = 0; i < 3; ++i) {
    const double worth = std::clamp(axes.eigenvalues()[i] / (weak * weak), 0.0, 1.0);
    const Vector3d way = axes.eigenvectors().col(i);
    worth_ += worth * way * way.transpose();
    if (worth < 1.0 && i >= (n == 1 ? 2 : 1)) near_pole_ = true;
  }
}

AxisPositions CorrectionStep::total(const AxisPositions& change, const Left& left,
                                    double largest_rad) const {
  return spans_ ? by_rotary(change, left, largest_rad) : of_tip(change, left, largest_rad);
}

AxisPositions CorrectionStep::by_rotary(const AxisPositions& change, const Left& left,
                                        double largest_rad) const {
  const auto n = static_cast<Index>(rotary_.count);
  AxisPositions total = change;
  Vector3d tip = left.tip;
  if (n > 0) {
    Vector3d c = left.direction - by_tip_ * left.tip;
    for (Index i = 0; i < n; ++i)
      c -= change[rotary_.all[static_cast<std::size_t>(i)].axis] * turning_.col(i);
    if (near_pole_) c = worth_ * c;
    const SmallVector y = bounded_least_squares(turning_, c, SmallVector::Constant(n, largest_rad));
    for (Index i = 0; i < n; ++i) {
      const Column& column = rotary_.all[static_cast<std::size_t>(i)];
      tip += (y[i] - change[column.axis]) * column.tip;
      total[column.axis] = y[i];
    }
  }
  const Vector3d step = -(tip_inverse_ * tip);
  for (Index i = 0; i < 3; ++i) total[linear_.all[static_cast<std::size_t>(i)].axis] += step[i];
  return total;
}

AxisPositions CorrectionStep::of_tip(const AxisPositions& change, const Left& left,
                                     double largest_rad) const {
  const auto n = static_cast<Index>(linear_.count + rotary_.count);
  SmallMatrix M(3, n);
  SmallVector bound(n), now(n);
  Index i = 0;
  const auto each = [&](const auto& act) {
    i = 0;
    for (std::size_t k = 0; k < linear_.count; ++k) act(linear_.all[k], 1.0, INFINITY);
    for (std::size_t k = 0; k < rotary_.count; ++k) act(rotary_.all[k], rad_per_deg, largest_rad);
  };
  each([&](const Column& column, double unit, double largest) {
    M.col(i) = unit * column.tip;
    bound[i] = largest / unit;
    now[i++] = change[column.axis] / unit;
  });
  const SmallVector y = bounded_least_squares(M, left.tip - M * now, bound);
  AxisPositions total = change;
  each([&](const Column& column, double unit, double) { total[column.axis] = unit * y[i++]; });
  return total;
}

}  // namespace trueaxis

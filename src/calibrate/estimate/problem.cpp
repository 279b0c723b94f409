// SPDX-License-Identifier: Apache-2.0
#include "calibrate/estimate/problem.hpp"

#include "calibrate/estimate/place.hpp"
#include "machine/screw.hpp"

namespace trueaxis::calibrate_detail {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

struct RowMotion {
  rigid::Motion workpiece;
  Vector3d tip;
};

RowMotion motion_of(const MachineModel& model, const Row& row) {
  const auto& compiled = model.compiled();
  const ChainEnds ends = actual_ends(compiled, row.axes);
  Setting setting;
  setting.tool_length_mm = row.tool_length_mm;
  return {ends.workpiece, ends.tool * compiled.tip(setting)};
}

}  // namespace

Vector3d Target::point(const double* place, double s) const {
  const Vector3d p(place[0], place[1], place[2]);
  if (!line) return p;
  return p + s * (direction + place[3] * across[0] + place[4] * across[1]).normalized();
}

Eigen::Matrix<double, 3, Eigen::Dynamic> Target::jacobian(const double* place, double s) const {
  Eigen::Matrix<double, 3, Eigen::Dynamic> out(3, unknowns());
  out.leftCols<3>().setIdentity();
  if (!line) return out;
  const Vector3d along = direction + place[3] * across[0] + place[4] * across[1];
  const Vector3d e = along.normalized();
  for (int k = 0; k < 2; ++k)
    out.col(3 + k) = s / along.norm() * (across[k] - e * e.dot(across[k]));
  return out;
}

VectorXd Problem::residuals(const ErrorModel& errors, const VectorXd& at) const {
  const MachineModel model(*machine, errors);
  VectorXd out(equations);
  for (const Row& row : rows) {
    const RowMotion motion = motion_of(model, row);
    const Target& target = targets[row.target];
    const Vector3d ball = motion.workpiece * target.point(at.data() + target.first, row.along_mm);
    const Vector3d apart = ball - motion.tip;
    if (row.kind == MeasurementKind::bar)
      out[row.first] = row.observed[0] - apart.norm();
    else
      out.segment<3>(row.first) = row.observed - apart;
  }
  return out;
}

MatrixXd Problem::places_jacobian(const ErrorModel& errors, const VectorXd& at) const {
  const MachineModel model(*machine, errors);
  MatrixXd out = MatrixXd::Zero(equations, places);
  for (const Row& row : rows) {
    const RowMotion motion = motion_of(model, row);
    const Target& target = targets[row.target];
    const double* const place = at.data() + target.first;
    const MatrixXd moved = motion.workpiece.R * target.jacobian(place, row.along_mm);
    if (row.kind == MeasurementKind::bar) {
      const Vector3d apart = motion.workpiece * target.point(place, row.along_mm) - motion.tip;
      out.block(row.first, target.first, 1, target.unknowns()) =
          apart.normalized().transpose() * moved;
    } else {
      out.block(row.first, target.first, 3, target.unknowns()) = moved;
    }
  }
  return out;
}

MatrixXd Problem::jacobian(const ErrorModel& errors, std::span<const Unknown> unknowns,
                           const VectorXd& at) const {
  MatrixXd out(equations, static_cast<Eigen::Index>(unknowns.size()));
  for (std::size_t j = 0; j < unknowns.size(); ++j) {
    const double h = unknowns[j].step();
    ErrorModel moved = errors;
    moved.terms.push_back(unknowns[j].unit);
    moved.terms.back().function = scaled(unknowns[j].unit.function, h);
    const VectorXd up = residuals(moved, at);
    moved.terms.back().function = scaled(unknowns[j].unit.function, -h);
    out.col(static_cast<Eigen::Index>(j)) = (residuals(moved, at) - up) / (2.0 * h);
  }
  return out;
}

Problem make_problem(const Machine& machine, std::span<const MachineMeasurement> data,
                     const ErrorModel& given) {
  Problem problem = gather(machine, data);
  const MachineModel model(machine, given);
  std::vector<std::vector<Sight>> sights(problem.targets.size());
  for (const Row& row : problem.rows) {
    const RowMotion motion = motion_of(model, row);
    const rigid::Motion back = motion.workpiece.inverse();
    const bool bar = row.kind == MeasurementKind::bar;
    sights[row.target].push_back({back * (motion.tip + (bar ? Vector3d::Zero() : row.observed)),
                                  row.along_mm, bar ? row.observed[0] : 0.0});
  }
  problem.start = VectorXd::Zero(problem.places);
  for (std::size_t t = 0; t < sights.size(); ++t) {
    Target& target = problem.targets[t];
    const Vector3d point = target.line ? place_line(sights[t], target) : place_ball(sights[t]);
    problem.start.segment<3>(target.first) = point;
  }
  return problem;
}

}  // namespace trueaxis::calibrate_detail

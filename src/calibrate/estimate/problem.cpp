// SPDX-License-Identifier: Apache-2.0
#include "calibrate/estimate/problem.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "calibrate/estimate/read_out_rows.hpp"
#include "machine/screw.hpp"
#include "math/linear_algebra.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis::calibrate_detail {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// Where a target was met in one row, seen from the workpiece: at `point` (a bar: at `length_mm`
/// from it).
struct Sight {
  Eigen::Vector3d point;
  double along_mm = 0.0, length_mm = 0.0;
};

Vector3d mean(std::span<const Sight> sights) {
  Vector3d sum = Vector3d::Zero();
  for (const Sight& one : sights) sum += one.point;
  return sum / static_cast<double>(sights.size());
}

/// Gauss-Newton on the lengths; returns the sum of squares.
double refine(std::span<const Sight> sights, Vector3d& centre) {
  double square = 0.0;
  for (int step = 0; step < 20; ++step) {
    Matrix3d normal = 1e-9 * Matrix3d::Identity();
    Vector3d right = Vector3d::Zero();
    square = 0.0;
    for (const Sight& one : sights) {
      const Vector3d apart = centre - one.point, g = apart.normalized();
      const double r = one.length_mm - apart.norm();
      normal += g * g.transpose();
      right += g * r;
      square += r * r;
    }
    const Vector3d move = linear::solve_normal(normal, right);
    centre += move;
    if (move.norm() < 1e-10) break;
  }
  return square;
}

// |c − x|² = L²: linear in c − m and |c − m|² once x is taken from its mean m (Eq. 173).
Vector3d trilaterate(std::span<const Sight> sights) {
  const Vector3d m = mean(sights);
  const auto n = static_cast<Index>(sights.size());
  MatrixXd left(n, 3);
  VectorXd right(n);
  double mean_square = 0.0;
  for (Index i = 0; i < n; ++i) {
    const Sight& one = sights[static_cast<std::size_t>(i)];
    left.row(i) = 2.0 * (one.point - m).transpose();
    right[i] = (one.point - m).squaredNorm() - one.length_mm * one.length_mm;
    mean_square -= right[i] / static_cast<double>(n);
  }
  right.array() += mean_square;
  const linear::SingularSystem system = linear::singular_system(left, right, 1e-3);
  const Vector3d flat = system.x;
  if (system.rank == 3) {
    Vector3d centre = m + flat;
    refine(sights, centre);
    return centre;
  }
  Vector3d normal = system.right.col(2);
  if (normal[2] < 0.0) normal = -normal;
  const double height = std::sqrt(std::max(0.0, mean_square - flat.squaredNorm()));
  Vector3d above = m + flat + height * normal, below = m + flat - height * normal;
  const double up = refine(sights, above), down = refine(sights, below);
  return up <= down * (1.0 + 1e-6) ? above : below;
}

/// A ball's centre: the mean, or of a bar's lengths the point that has them (Eq. 173); of two that
/// lie mirrored about the plane of the tips the one towards +Z.
Vector3d place_ball(std::span<const Sight> sights) {
  return sights.front().length_mm > 0.0 ? trilaterate(sights) : mean(sights);
}

/// The point at s = 0 of the line through the balls; its direction goes to `target`.
Vector3d place_line(std::span<const Sight> sights, Target& target) {
  const Vector3d centre = mean(sights);
  double along = 0.0;
  for (const Sight& one : sights) along += one.along_mm / static_cast<double>(sights.size());
  Vector3d direction = Vector3d::Zero();
  for (const Sight& one : sights) direction += (one.along_mm - along) * (one.point - centre);
  target.direction = direction.normalized();
  Index least = 0;
  target.direction.cwiseAbs().minCoeff(&least);
  target.across[0] = target.direction.cross(Vector3d::Unit(least)).normalized();
  target.across[1] = target.direction.cross(target.across[0]);
  return centre - along * target.direction;
}

std::size_t target_of(Problem& problem, const MachineMeasurement& file, std::size_t number,
                      std::size_t row) {
  const bool line = file.kind == MeasurementKind::array;
  const int ball = line ? 0 : file.ball[row];
  const auto found = std::ranges::find_if(problem.targets, [&](const Target& t) {
    return t.file == number && t.setup == file.setup[row] && t.ball == ball;
  });
  if (found != problem.targets.end())
    return static_cast<std::size_t>(found - problem.targets.begin());
  Target target;
  target.file = number;
  target.setup = file.setup[row];
  target.ball = ball;
  target.line = line;
  target.first = problem.places;
  problem.places += target.unknowns();
  problem.targets.push_back(target);
  return problem.targets.size() - 1;
}

void add_rows(Problem& problem, const MachineMeasurement& file, std::size_t number) {
  for (std::size_t i = 0; i < file.rows(); ++i) {
    Row row;
    row.file = number;
    row.row = i;
    row.kind = file.kind;
    row.axes = file.axes[i];
    row.target = target_of(problem, file, number, i);
    row.tool_length_mm =
        file.tool_length_mm.empty() ? problem.machine->tool.length_mm : file.tool_length_mm[i];
    if (!file.time_s.empty()) row.time_s = file.time_s[i];
    if (file.kind == MeasurementKind::ball) row.observed = rigid::eigen(file.deviation_mm[i]);
    if (file.kind == MeasurementKind::bar) row.observed[0] = file.length_mm[i];
    if (file.kind == MeasurementKind::array) row.along_mm = file.along_mm[i];
    row.sigma_mm = file.noise_mm.value_or(unstated_noise_mm);
    row.first = problem.equations;
    problem.equations += row.equations();
    problem.rows.push_back(row);
  }
  problem.noise_stated = problem.noise_stated && file.noise_mm;
}

/// A ball wants two positions, of bars four to be placed by, a line three balls.
void check(const Problem& problem, std::span<const MachineMeasurement> data) {
  std::vector<Diagnostic> wrong;
  for (std::size_t t = 0; t < problem.targets.size(); ++t) {
    const Target& target = problem.targets[t];
    if (target.zero) continue;
    const MachineMeasurement& file = data[target.file];
    std::vector<std::vector<double>> different;
    for (const Row& row : problem.rows) {
      if (row.target != t) continue;
      std::vector<double> at(row.axes.begin(), row.axes.end());
      at.push_back(row.tool_length_mm);
      if (target.line) at = {row.along_mm};
      if (std::ranges::find(different, at) == different.end()) different.push_back(std::move(at));
    }
    const std::size_t needed = target.line ? 3 : file.kind == MeasurementKind::bar ? 4 : 2;
    if (different.size() >= needed) continue;
    const std::string setup = "setup " + std::to_string(target.setup);
    wrong.push_back({file.source, 0, 0,
                     target.line ? setup + " has " + std::to_string(different.size()) +
                                       " balls of the array: a line needs three"
                                 : "ball " + std::to_string(target.ball) + " of " + setup +
                                       " was measured at " + std::to_string(different.size()) +
                                       (different.size() == 1 ? " position" : " positions") +
                                       " only: they show only its own place; give " +
                                       std::to_string(needed) + " or more"});
  }
  if (!wrong.empty()) throw InputError(std::move(wrong));
}

/// The rows of all files and their targets, unplaced. @throws InputError as `make_problem` does
Problem gather(const Machine& machine, std::span<const MachineMeasurement> data) {
  Problem problem;
  problem.machine = &machine;
  const bool alone = read_outs_alone(data);
  for (std::size_t number = 0; number < data.size(); ++number)
    if (data[number].kind != MeasurementKind::axis)
      add_rows(problem, data[number], number);
    else if (alone || is_along(machine, *data[number].axis))
      add_read_out(problem, data[number], number, !alone);
  check(problem, data);
  if (alone) check_directions(machine, data);
  problem.weights.resize(problem.equations);
  for (const Row& row : problem.rows)
    problem.weights.segment(row.first, row.equations()).setConstant(1.0 / row.sigma_mm);
  return problem;
}

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

double Problem::rms_mm(const VectorXd& of_equations_mm) const {
  double square = 0.0, count = 0.0;
  for (const Row& row : rows) {
    if (row.angle() || (row.read_out && !read_outs())) continue;
    square += of_equations_mm.segment(row.first, row.equations()).squaredNorm();
    count += static_cast<double>(row.equations());
  }
  return std::sqrt(square / count);
}

VectorXd Problem::residuals(const ErrorModel& errors, const VectorXd& at) const {
  const MachineModel model(*machine, errors);
  VectorXd out(equations);
  for (const Row& row : rows) {
    const Target& target = targets[row.target];
    if (target.zero) {
      out[row.first] = row.observed[0] - at[target.first] - read_out_error(*machine, errors, row);
      if (target.two_ways) out[row.first] -= row.sense * at[target.first + 1];
      continue;
    }
    const RowMotion motion = motion_of(model, row);
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
    const Target& target = targets[row.target];
    if (target.zero) {
      out(row.first, target.first) = 1.0;
      if (target.two_ways) out(row.first, target.first + 1) = row.sense;
      continue;
    }
    const RowMotion motion = motion_of(model, row);
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
    if (row.read_out) {
      const double left = row.observed[0] - read_out_error(machine, given, row);
      sights[row.target].push_back({Vector3d::UnitX() * left});
      continue;
    }
    const RowMotion motion = motion_of(model, row);
    const rigid::Motion back = motion.workpiece.inverse();
    const bool bar = row.kind == MeasurementKind::bar;
    sights[row.target].push_back({back * (motion.tip + (bar ? Vector3d::Zero() : row.observed)),
                                  row.along_mm, bar ? row.observed[0] : 0.0});
  }
  problem.start = VectorXd::Zero(problem.places);
  for (std::size_t t = 0; t < sights.size(); ++t) {
    Target& target = problem.targets[t];
    if (target.zero) {
      problem.start[target.first] = mean(sights[t])[0];
      continue;
    }
    const Vector3d point = target.line ? place_line(sights[t], target) : place_ball(sights[t]);
    problem.start.segment<3>(target.first) = point;
  }
  return problem;
}

}  // namespace trueaxis::calibrate_detail

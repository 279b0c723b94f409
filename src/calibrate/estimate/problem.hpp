// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <optional>
#include <span>
#include <vector>

#include "calibrate/estimate/unknown.hpp"
#include "machine/algebra.hpp"
#include "trueaxis/calibration.hpp"

namespace trueaxis::calibrate_detail {

/// What the tip is compared with, in the workpiece's body (M, zero position): a ball's centre, or
/// the straight line that the balls of a bar lie on; of a read-out its zero. Its place is unknown.
struct Target {
  std::size_t file = 0;
  int setup = 0, ball = 0;
  bool line = false, zero = false;  ///< zero: where a read-out has its 0, one number
  bool two_ways = false;            ///< of a zero: and its reversal value
  std::vector<int> orders;          ///< of a turn that a read-out was read all around
  Eigen::Vector3d direction = Eigen::Vector3d::Zero(), across[2] = {direction, direction};
  Index first = 0;  ///< of its unknowns among all places

  Index unknowns() const { return zero ? (two_ways ? 2 : 1) : line ? 5 : 3; }
  /// The ball at s; `place` are the target's own unknowns.
  Eigen::Vector3d point(const double* place, double s) const;
  /// Its derivatives, a column an unknown.
  Eigen::Matrix<double, 3, Eigen::Dynamic> jacobian(const double* place, double s) const;
};

struct Row {
  std::size_t file = 0, row = 0, target = 0;
  MeasurementKind kind = MeasurementKind::ball;
  AxisPositions axes{};
  double tool_length_mm = 0.0, along_mm = 0.0, time_s = 0.0, sigma_mm = 0.0;
  /// ball: the deviation; bar: L first; read-out: actual less command first, mm or rad
  Eigen::Vector3d observed = Eigen::Vector3d::Zero();
  std::optional<AxisName> read_out{};  ///< the axis that alone was read
  double sense = 0.0;                  ///< of a read-out: ±0.5 by the side that it came from
  Index first = 0;                     ///< of its equations

  Index equations() const {
    return kind == MeasurementKind::bar || kind == MeasurementKind::axis ? 1 : 3;
  }
  bool of_tip() const { return !read_out; }
  bool angle() const { return read_out && is_rotary(*read_out); }
};

/// Rows of all files in order, and what they are compared with. A reading of a read-out is a row
/// that observes the position error of its axis itself (Eq. 328).
struct Problem {
  const Machine* machine = nullptr;
  std::vector<Target> targets;
  std::vector<Row> rows;
  Index equations = 0, places = 0;
  bool noise_stated = true;  ///< in every file
  VectorXd start;            ///< places from the machine with the errors that were given
  VectorXd weights;          ///< 1/σ of every equation

  /// Whether of nothing else.
  bool read_outs() const { return !targets.empty() && std::ranges::all_of(targets, &Target::zero); }
  /// Whether a row says where an axis was while the tip, or with read-outs alone that axis, was
  /// read.
  bool tells_of(const Row& row, AxisName axis) const {
    return !row.read_out || (read_outs() && *row.read_out == axis);
  }
  bool has_read_out(AxisName axis) const {
    return std::ranges::find(rows, axis, &Row::read_out) != rows.end();
  }
  /// RMS of the tip's numbers, with read-outs alone of those of linear axes (none: NaN).
  double rms_mm(const VectorXd& of_equations_mm) const;
  /// Observed − predicted, mm, a row three equations (a bar's or a read-out's one). Eqs. 170, 171.
  VectorXd residuals(const ErrorModel& errors, const VectorXd& places) const;
  /// Derivatives of the prediction by the places. Eq. 172.
  MatrixXd places_jacobian(const ErrorModel& errors, const VectorXd& places) const;
  /// The same by unknowns of the machine, by central differences.
  MatrixXd jacobian(const ErrorModel& errors, std::span<const Unknown> unknowns,
                    const VectorXd& places) const;
};

inline bool read_outs_alone(std::span<const MachineMeasurement> data) {
  return std::ranges::all_of(
      data, [](const MachineMeasurement& file) { return file.kind == MeasurementKind::axis; });
}

/// σ of files that state none; what is estimated from the residuals replaces it.
inline constexpr double unstated_noise_mm = 1e-3, unstated_noise_rad = 5e-6;

/// @throws InputError with every ball that was measured at one position only, and bars of fewer
/// than three balls
Problem make_problem(const Machine& machine, std::span<const MachineMeasurement> data,
                     const ErrorModel& given);

}  // namespace trueaxis::calibrate_detail

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "calibrate/estimate/problem.hpp"

namespace trueaxis::calibrate_detail {

inline constexpr double whole_turn =
    300.0 * rad_per_deg;                     ///< from here on harmonics can be determined
inline constexpr double least_range = 1e-6;  ///< of an axis that moved
inline constexpr double least_move = 1e-9;   ///< between two rows

/// All that rows and places give the columns of terms.
struct Geometry {
  MatrixXd unit_errors;  ///< 6 columns an axis of `machine.axes`: E.. of size 1 at every row
  MatrixXd tip_shift;    ///< 3: the tip moved along X Y Z of M
  MatrixXd part_shift;   ///< 3: the part moved along its own X Y Z
  MatrixXd places;       ///< as `Problem::places_jacobian`
};
Geometry geometry_of(const Problem& problem, const ErrorModel& errors, const VectorXd& places);

/// Columns times a function of the row.
template <class Function>
MatrixXd times_rows(const Problem& problem, MatrixXd columns, const Function& value) {
  for (const Row& row : problem.rows) columns.middleRows(row.first, row.equations()) *= value(row);
  return columns;
}

/// The column of a component error that is a function of the position of an axis, its own unless
/// said.
VectorXd error_column(const Problem& problem, const Geometry& geometry, const ErrorTerm& error,
                      std::optional<AxisName> of = {});

/// The positions of an axis in all rows that tell of it.
std::vector<double> positions_of(const Problem& problem, AxisName axis);

/// When the read-outs of an axis were read.
struct TimeSpan {
  double begin_s = 0.0, end_s = 0.0;
  double share(double time_s) const { return (time_s - begin_s) / (end_s - begin_s); }
};
TimeSpan times_of(const Problem& problem, AxisName axis);
/// When the tip was, with read-outs alone these.
TimeSpan times_of_tip(const Problem& problem);

/// The range of those positions.
struct AxisRange {
  double low = 0.0, high = 0.0;
  double length() const { return high - low; }
};
AxisRange axis_range(const Problem& problem, AxisName axis);

/// From where to where the rows tell of a component error. None: it holds everywhere (a constant,
/// orders of a turn that was measured all around), or its axis moved less than 1 mm or 1°.
std::optional<std::array<double, 2>> measured_over(const Problem& problem, const ErrorTerm& error);

}  // namespace trueaxis::calibrate_detail

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "calibrate/problem.hpp"
#include "trueaxis/machine_diagnosis.hpp"

namespace trueaxis::calibrate_detail {

/// Where on an axis a local pattern is, that can be moved to its place.
struct PatternPlace {
  enum class Kind { bump, step } kind = Kind::bump;
  std::size_t axis = 0;  ///< of `machine.axes`
  double at = 0.0, width = 0.0;
};

/// A hypothesis: columns of the readings, each per mm or rad.
struct Term {
  std::string effect;
  Eigen::MatrixXd columns;
  std::vector<std::string> parameters;  ///< a name each column
  std::vector<ErrorTerm> errors;        ///< of which each column is; empty: no error of the machine
  std::string formula;
  std::vector<MachineShape> shape;
  bool angle = false;
  bool pattern = false;               ///< no effect, only what is left over
  bool barred = false;                ///< a pattern that an effect makes at these rows
  double tests = 1.0;                 ///< how many places of it were tried
  std::size_t target = 0, row = 0;    ///< ball.slip: of which target, from which row on
  std::size_t unit = 0;               ///< of a pattern: the column that its functions multiply
  std::string letters;                ///< of the axes that it is a function of; t: of the time
  std::optional<PatternPlace> place;  ///< of a local pattern
};

inline constexpr double whole_turn = 300.0 * rad_per_deg;  ///< from here on harmonics can be told

/// All that rows and places give the columns of terms.
struct Geometry {
  Eigen::MatrixXd unit_errors;  ///< 6 columns an axis of `machine.axes`: E.. of size 1 at every row
  Eigen::MatrixXd tip_shift;    ///< 3: the tip moved along X Y Z of M
  Eigen::MatrixXd part_shift;   ///< 3: the part moved along its own X Y Z
  Eigen::MatrixXd places;       ///< as `Problem::places_jacobian`
};
Geometry geometry_of(const Problem& problem, const ErrorModel& errors,
                     const Eigen::VectorXd& places);

/// The column of a component error of axis k that is a function of its position.
Eigen::VectorXd error_column(const Problem& problem, const Geometry& geometry, std::size_t k,
                             const ErrorTerm& error);

/// Every effect of docs/calibration.md for this machine and these rows: polynomials and harmonics
/// of the errors of the axes, reversal, drift where there are times, slips of the balls at some
/// rows.
std::vector<Term> effect_terms(const Problem& problem, const Geometry& geometry, bool timed);

/// The slip of a target from a row on.
Term slip_term(const Problem& problem, const Geometry& geometry, std::size_t target,
               std::size_t row);

/// The range of an axis over all rows.
struct AxisRange {
  double low = 0.0, high = 0.0;
  double length() const { return high - low; }
};
AxisRange axis_range(const Problem& problem, AxisName axis);

}  // namespace trueaxis::calibrate_detail

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "trueaxis/machine.hpp"
#include "trueaxis/units.hpp"

/// Errors of a machine from measurements on it (calibration.md). Inside mm, rad and s.
namespace trueaxis {

enum class MeasurementKind {
  ball,   ///< ball's centre − tip in machine axes, at many positions
  bar,    ///< length from a ball's centre to the tip
  array,  ///< axis positions at which the tip is at the balls of a straight bar
  axis    ///< actual against commanded position of one axis
};
const char* to_string(MeasurementKind kind);

/// One file of a measurement, as long as its rows in every column that it has.
struct MachineMeasurement {
  std::string source, input_hash;
  MeasurementKind kind = MeasurementKind::ball;
  std::optional<double> noise_mm;      ///< σ of one read-out as stated; of a rotary axis rad
  std::optional<AxisName> axis;        ///< of kinds array and axis
  std::optional<int> gear_ratio{};     ///< of kind axis: turns of its gear per turn of the axis
  std::vector<int> setup, ball;        ///< numbers of this file
  std::vector<AxisPositions> axes;     ///< commanded
  std::vector<Vector3> deviation_mm;   ///< ball: centre − tip, directions of M
  std::vector<double> length_mm;       ///< bar
  std::vector<double> along_mm;        ///< array: s
  std::vector<double> actual;          ///< axis: mm or rad
  std::vector<double> tool_length_mm;  ///< empty: the machine's own
  std::vector<double> time_s;          ///< empty: not known

  std::size_t rows() const { return axes.size(); }
};

/// A parameter that was estimated: a location error, or a coefficient of a component error.
struct CalibratedParameter {
  std::string name;      ///< X0C; EXX.poly2
  Estimate estimate;     ///< mm or rad, from the errors that were given
  double u_noise = 0.0;  ///< of u, were there no component errors; 0: not told apart
};

/// A component error that the fit has in addition to its parameters, at its plausible size.
struct CalibratedComponent {
  std::string name;  ///< EXC
  Estimate rms;      ///< of what the data show of it, over the axis' travel or a turn; mm or rad
  double plausible = 0.0;  ///< RMS that machines as this one have
  bool shown = false;      ///< some number of it is three u and more
  bool beyond = false;  ///< less 2 u ten times what machines have (docs/reference/calibration.md)
};

/// What the measurement does not tell: at its largest plausible size it moves the readings by less
/// than their noise once the rest is fitted. The first of the class is held at what it was.
struct NotDetermined {
  std::vector<std::string> members;  ///< "ball": the centres
  std::string why;
};

/// The place of a ball, or of the point at s = 0 of a bar, on the workpiece's body: in M, zero
/// position, with what is held.
struct PlacedBall {
  std::size_t file = 0;
  int setup = 0, ball = 0;           ///< ball 0: a bar
  Vector3 centre_mm{}, direction{};  ///< direction of a bar's line
};

/// Position error of an axis from its read-out (Eq. 177).
struct AxisReadOut {
  AxisName axis = AxisName::X;
  std::size_t readings = 0;
  double period = 0.0;   ///< mm or rad; 0: nothing periodic was found
  bool repeats = false;  ///< a rotary axis read all around: its errors are periodic everywhere
  struct Order {
    int order = 1;
    Estimate cos, sin;  ///< mm or rad
    double amplitude() const;
  };
  std::vector<Order> orders;         ///< of the period, those that were found
  std::vector<Estimate> polynomial;  ///< Legendre coefficients over the range, degree 0 first
  /// Reversal value (ISO 230-2): error after a positive approach less that after a negative one, mm
  /// or rad. None: the positions were not approached from both sides.
  std::optional<Estimate> reversal;
  double low = 0.0, high = 0.0;  ///< range of the commanded positions
  double rms_before = 0.0, rms_after = 0.0;
  double noise = 0.0;         ///< σ of a reading as the residuals show it, mm or rad
  double stated_noise = 0.0;  ///< the same as the file states it; 0: it does not
  double freedom = 0.0;       ///< of the residuals
};

struct CalibrationOptions {
  ErrorModel errors;  ///< what is known of the machine already; the estimate adds to it
  double largest_length_mm = 0.1;  ///< largest plausible size of a location error
  double largest_angle_rad = 0.2e-3;
  double coverage_factor = 2.0;  ///< k of U = k u in the result
  int max_orders = 24;           ///< of a period in an axis' read-out
  /// The covariance of `errors` counts the location errors that are held, too: they are as large as
  /// machines have them (Eq. 330). Parameters and their u presuppose what is held either way.
  bool counts_held = false;
  /// Errors of rotary axes that may be a polynomial over what was read as well as harmonics.
  std::vector<ErrorName> polynomials;
};

enum class NoiseBasis { none, stated, residuals };
const char* to_string(NoiseBasis basis);

struct Calibration {
  bool converged = false;
  std::string message;  ///< why not
  std::vector<std::string> sources, input_hashes;
  std::vector<CalibratedParameter> parameters;
  Covariance covariance;  ///< of `parameters`, mm and rad
  std::vector<CalibratedComponent> components;
  double size_of_components = 1.0;  ///< of this machine's, against those of machines in good order
  std::vector<PlacedBall> balls;
  std::vector<NotDetermined> not_determined;
  std::string gauge;  ///< what was held, in words
  std::vector<AxisReadOut> read_outs;
  ErrorModel errors;  ///< given and found together, component errors too, with their covariance
  std::size_t equations = 0, unknowns = 0;
  /// For balls, bars and arrays; without them, for the read-outs of linear axes.
  double rms_before_mm = 0.0, rms_after_mm = 0.0;
  double rms_parameters_mm = 0.0;  ///< with the parameters alone, without component errors
  double noise_mm = 0.0;           ///< σ of one number that u is made of
  NoiseBasis noise_basis = NoiseBasis::none;  ///< what σ was had from
  double coverage_factor = 2.0;               ///< k of U = k u, as the options have it
  double stated_noise_mm = 0.0;               ///< σ that the files state; 0: one of them does not
};

/// Files given together are one measurement, in order. All location errors of the axes, X0S Y0S
/// Z0S, A0S and B0S, every ball's centre and every bar's line are estimated together by
/// Levenberg-Marquardt through the exact chain (Eqs. 170-176); of an array's axis its three
/// straightness and position errors as polynomials too; an axis' read-out gives its position error.
/// Then all component errors are random at their plausible size (Eqs. 210-215): u is what noise and
/// they leave unknown, and what the data show of them is part of the errors.
/// @throws InputError where there is too little to estimate from
Calibration calibrate(const Machine& machine, std::span<const MachineMeasurement> data,
                      const CalibrationOptions& options = {});

/// Why a calibration cannot be right: a size that, less 2 u, is fifty times the largest plausible
/// one, as of inches for mm or a wrong tool length. Empty: nothing speaks against it.
std::string implausible(const Calibration& found, const CalibrationOptions& options);

/// The location error that, less 2 u, is furthest beyond the largest plausible length: a tool
/// length or a point of the machine file that is wrong by as much reads the same. Empty: none.
std::string beyond_plausible(const Calibration& found, const CalibrationOptions& options);

/// The component errors that are `beyond`, with what to check: the model has them in the place of
/// something else. Empty: none.
std::string components_beyond_plausible(const Calibration& found);

/// The mistake in the columns that a measurement most likely has, and what to write: exchanged
/// columns, wrong signs, radians as degrees or a tool of another length, if the right ones leave
/// half of the RMS at most and 20 µm. Also readings that scatter thirty times less than stated and
/// than few degrees of freedom allow, or that leave more than machines do and thirty times more
/// than stated. Empty: the data show no mistake. They show that all deviations are negated only if
/// the axes were off the ball by more than its errors. @param left_by_all_mm RMS of the readings
/// after all errors, those that a diagnosis found too
std::string likely_mistake(const Machine& machine, std::span<const MachineMeasurement> data,
                           const CalibrationOptions& options, const Calibration& found,
                           double left_by_all_mm);

}  // namespace trueaxis

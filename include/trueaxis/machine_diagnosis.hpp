// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "trueaxis/calibration.hpp"
#include "trueaxis/inference.hpp"

/// What the model of a machine gets wrong, from measurements of balls, bars and arrays, or from
/// read-outs alone
/// (docs/reference/calibration.md).
namespace trueaxis {

/// A number that says of what form a term is: an order, a degree, a range, a row.
struct MachineShape {
  std::string name;
  double value = 0.0;
  std::string unit;  ///< mm, rad, s or 1
};

/// A component error that is a function of the position of an axis: a column a function. Of its own
/// axis it is an error of the machine; `of` says another.
struct ErrorOfPosition {
  ErrorName error{};
  std::vector<ErrorFunction> functions;
  std::optional<AxisName> of{};
  bool periodic = false;  ///< cos and sin of a period that is found
};
/// + or − half its size along an axis, of a rotary one about it, by the side that it came from.
struct ErrorOfSense {
  AxisName axis = AxisName::X;
};
/// The tip against the bed along X, Y or Z of M, linear in time.
struct TipDrift {
  std::size_t direction = 0;
};
/// A ball that is elsewhere on the workpiece's body from a row on.
struct BallStep {};
/// The zero of a read-out of an axis, linear in time.
struct ZeroDrift {
  AxisName axis = AxisName::X;
};
/// The zero of a read-out of an axis that is elsewhere from a row on.
struct ZeroStep {
  AxisName axis = AxisName::X;
};
/// The scale of a read-out itself: what it says over the range in addition to what the axis does.
struct ZeroScale {
  AxisName axis = AxisName::X;
};
/// How an effect is computed; monostate: it is not.
using MachineTerm = std::variant<std::monostate, ErrorOfPosition, ErrorOfSense, TipDrift, BallStep,
                                 ZeroDrift, ZeroStep, ZeroScale>;

/// Whether it is an error of the machine as a function of its axes, which programs are corrected
/// by.
bool is_machine_error(const MachineTerm& term);

/// Whether the readings hold the form of it. Errors of a rotary axis are harmonics (Eq. 210): over
/// a part of a revolution a polynomial is the nearest form, and others fit as well.
bool form_is_sure(const MachineTerm& term);

/// The axis whose position, sense or read-out it is a function of; none: of the time or the row.
std::optional<AxisName> axis_of(const MachineTerm& term);

/// An entry of the catalogue of a machine: all that diagnosis, job, report and command know of an
/// effect.
struct MachineEffect {
  std::string id;     ///< EXC.harmonic2, reversal.Y
  std::string title;  ///< in words
  MachineTerm term{};
  std::vector<std::string> parameters{};  ///< a name each column
  std::string formula{};                  ///< of the term in its parameters
  std::vector<MachineShape> shape{};
  std::string unit = "mm";       ///< of its size: mm or rad
  double low = 0.0, high = 0.0;  ///< 95 % of its sizes lie between; 0: none is known
  std::string consequence{};     ///< what it means and what to do
  std::string why_not{};         ///< why these rows cannot show it; empty: they may
};

struct MachineFinding : NamedFinding {
  MachineEffect cause;                          ///< the entry of the best explanation
  std::vector<CalibratedParameter> parameters;  ///< cos and sin, legendre, x y z …; mm or rad
  std::vector<ErrorTerm> errors;  ///< as errors of the machine; empty: reversal, drift, slip
  Covariance covariance;          ///< of `parameters`
  bool likely_order = true;       ///< its order is 95 % likely among its aliases, 1/n² an order n
  std::vector<std::array<std::string, 2>> pairs;  ///< of effects that together are not told from it
  double size = 0.0;                              ///< amplitude, mm or rad

  const std::string& effect() const { return cause.id; }
  std::vector<std::string> members() const { return members_beside(effect()); }
};

struct MachineUnexplained : UnnamedPattern {
  std::string pattern;           ///< in words
  bool may_have_a_name = false;  ///< it has the form of an effect, together with something unknown
  double left = 0.0;  ///< of the amplitude, in the readings less `MachineDiagnosis::errors`
  std::vector<CalibratedParameter> parameters{};
  Covariance covariance{};  ///< of `parameters`
  MachineTerm term{};       ///< of which error it is; monostate: of the tip or of one reading
};

/// An effect that these rows do not show. What shows it: `separate_with`.
struct MachineNotObservable : UnseenEffect {
  std::vector<ErrorTerm> errors;  ///< of size 1; empty: no error of the machine, or not tested
  double hidden = 0.0;            ///< size that could hide: detectable, the largest plausible

  std::vector<std::string> plans() const;  ///< those after which it is seen, the one to take first
};

/// Where a further measurement goes.
struct PlannedVisit {
  int setup = 1, ball = 1;
  Vector3 ball_mm{};  ///< centre on the workpiece's body, in M, zero position
  double tool_length_mm = 0.0;
  AxisPositions axes{};
};

/// A further measurement and what it would show.
struct MachinePlan {
  std::string code;  ///< RV, L2, B2, AC
  std::string what;
  double minutes = 0.0;
  std::vector<std::string> shows;      ///< effects that are not observable without it
  std::vector<std::string> separates;  ///< causes whose class it tells apart
  MeasurementKind kind = MeasurementKind::ball;
  std::optional<AxisName> axis{};    ///< of a read-out
  std::vector<PlannedVisit> visits;  ///< in order
  Covariance covariance;             ///< of `MachineDiagnosis::uncertain` with it
};

/// A number that the tip depends on, before the measurement of a plausible size.
struct UncertainParameter {
  std::string effect;
  ErrorTerm unit;      ///< of size 1 mm or 1 rad
  double prior = 0.0;  ///< mm or rad
};

struct MachineDiagnosis : Conclusion {
  Calibration baseline;                       ///< what is always fitted
  std::vector<CalibratedParameter> extended;  ///< its parameters together with all causes
  /// To predict the tip with: given, always fitted and found together. If something is unexplained,
  /// those of `calibrate` instead, which count what they do not fit.
  ErrorModel errors;
  std::vector<MachineFinding> findings;  ///< the most significant first
  std::vector<MachineUnexplained> unexplained;
  /// What is found in less than nine of ten such measurements at its typical size.
  std::vector<MachineNotObservable> not_observable;
  std::vector<MachineEffect> effects;  ///< the catalogue of what was looked for
  std::vector<MachinePlan> plans;
  std::string next_plan;  ///< the one to take next; empty: none is needed
  double noise_mm = 0.0;  ///< σ of one number as the residuals show it
  Explained gain;
  std::size_t blocks = 0;  ///< of rotary positions, excluded in turn
  double typical_length_mm = 0.0, typical_angle_rad = 0.0;  ///< what was looked for
  /// Location errors, what was found and what these rows do not show, with their covariance after
  /// the measurement (Eq. 189); only where `covariances` is asked for.
  std::vector<UncertainParameter> uncertain;
  Covariance covariance;

  bool of_read_outs() const { return baseline.balls.empty() && !baseline.read_outs.empty(); }
  /// The plan to take next; nullptr: none is needed.
  const MachinePlan* next() const;
};

struct MachineDiagnoseOptions {
  CalibrationOptions calibration;
  double false_alarm = 0.01;  ///< per measurement, over all hypotheses
  std::size_t max_findings = 6;
  double typical_length_mm = 0.01, typical_angle_rad = 50e-6;  ///< that must be seen
  double planned_noise_mm = 1e-3;                              ///< σ of a reading of a first plan
  bool covariances = false;  ///< of what a program's tip depends on, with every plan
  /// Further effects that may be found, with ids that the catalogue does not have.
  std::span<const MachineEffect> own_effects = {};
};

/// Tests every effect in addition to what is always fitted (places, location errors): an exact F
/// test with Bonferroni's correction (Eqs. 178-187). @throws InputError as `calibrate`
MachineDiagnosis diagnose_machine(const Machine& machine, std::span<const MachineMeasurement> data,
                                  const MachineDiagnoseOptions& options = {});

/// The plan for a machine that was not measured yet, what it does not show, and what would. It is a
/// ball at a grid of rotary positions and back (plan B1, readings of the planned noise). @throws
/// InputError for a machine without a rotary axis or three linear ones
MachineDiagnosis plan_machine(const Machine& machine, const MachineDiagnoseOptions& options = {});

}  // namespace trueaxis

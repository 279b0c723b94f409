// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "trueaxis/calibration.hpp"

/// What the model of a machine gets wrong, from measurements of balls, bars and arrays
/// (docs/calibration.md). Effects have names such as EXC.harmonic2, reversal.Y, drift.Z, ball.slip.
namespace trueaxis {

/// An effect that explains a finding as well, or nearly.
struct MachineRival {
  std::string effect;
  double distance = 0.0;  ///< d of the finding's prediction from the rival's best fit, in σ
  double likelihood_ratio = 0.0;  ///< 2 ln(L_finding/L_rival), parameters paid for
  double probability = 0.0;       ///< among the class
};

/// A number that says of what form a term is: an order, a degree, a range, a row.
struct MachineShape {
  std::string name;
  double value = 0.0;
  std::string unit;  ///< mm, rad, s or 1
};

struct MachineFinding {
  std::string effect;                           ///< of the best explanation
  std::vector<MachineRival> rivals;             ///< the rest of its class, the most probable first
  std::vector<CalibratedParameter> parameters;  ///< cos and sin, legendre, x y z …; mm or rad
  std::vector<ErrorTerm> errors;  ///< as errors of the machine; empty: reversal, drift, slip
  std::string formula;            ///< of the term in its parameters
  std::vector<MachineShape> shape;
  std::vector<double> covariance;  ///< of `parameters` by rows
  std::string alias;               ///< orders that these positions cannot tell from it
  bool likely_order = true;        ///< its order is 95 % likely among them, 1/n² an order n
  std::vector<std::array<std::string, 2>> pairs;  ///< of effects that together are not told from it
  double size = 0.0;                              ///< amplitude, mm or rad
  double p_value = 1.0;                           ///< family-wise
  double probability = 0.0;                       ///< of the named effect in its class
  double rms_mm = 0.0;        ///< of what it does to the readings beside what is always fitted
  std::string separate_with;  ///< plan that tells the class apart best; empty: none is needed

  std::vector<std::string> members() const;  ///< the class, the named one first
};

struct MachineUnexplained {
  std::string pattern;  ///< in words
  Estimate amplitude;   ///< mm or rad
  double p_value = 1.0;
  std::vector<CalibratedParameter> parameters;
  std::vector<double> covariance;  ///< of `parameters` by rows
};

/// A check of the data's quality: never a name for an error.
struct MachineCheck {
  std::string name;
  bool found = false;
  std::string text;
};

struct MachineNotObservable {
  std::string effect;
  std::string why;
  std::optional<double> detectable;  ///< size found with power ½; none: no size
  std::string unit;                  ///< mm or rad
  std::vector<std::string> plans;    ///< those after which it is seen
  std::vector<ErrorTerm> errors;     ///< of size 1; empty: no error of the machine, or not tested
  double hidden = 0.0;               ///< size that could hide: detectable, the largest plausible
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
  std::vector<std::string> separates;  ///< findings whose class it tells apart
  MeasurementKind kind = MeasurementKind::ball;
  std::vector<PlannedVisit> visits;  ///< in order
  std::vector<double> covariance;    ///< of `MachineDiagnosis::uncertain` with it
};

/// A number that the tip depends on, before the measurement of a plausible size.
struct UncertainParameter {
  std::string effect;
  ErrorTerm unit;      ///< of size 1 mm or 1 rad
  double prior = 0.0;  ///< mm or rad
};

struct HeldOut {
  double value_mm = 0.0, low_mm = 0.0, high_mm = 0.0;  ///< RMS, interval of about 95 %
};

enum class MachineVerdict { ideal, effects, unexplained };
const char* to_string(MachineVerdict verdict);

struct MachineDiagnosis {
  MachineVerdict verdict = MachineVerdict::ideal;
  Calibration baseline;                       ///< what is always fitted
  std::vector<CalibratedParameter> extended;  ///< its parameters beside all findings
  /// To predict the tip with: given, always fitted and found together; where something is
  /// unexplained those of `calibrate` instead, which count what they do not fit.
  ErrorModel errors;
  std::vector<MachineFinding> findings;  ///< the most significant first
  std::vector<MachineUnexplained> unexplained;
  std::vector<MachineNotObservable> not_observable;
  std::vector<std::string> remarks;  ///< what might be taken for certain and is not
  std::vector<MachineCheck> checks;
  std::vector<MachinePlan> plans;
  std::string next_plan;  ///< that shows and separates most a minute; empty: none is needed
  double noise_mm = 0.0;  ///< σ of one number as the residuals show it
  double rms_before_mm = 0.0, rms_after_mm = 0.0;
  HeldOut held_out_before, held_out_after;
  std::size_t blocks = 0;  ///< of rotary positions, left out in turn
  std::size_t hypotheses = 0;
  double effective_hypotheses = 0.0;  ///< independent tests that those of effects are worth
  double false_alarm = 0.01, threshold = 0.0;               ///< p of one test that is a finding
  double typical_length_mm = 0.0, typical_angle_rad = 0.0;  ///< what was looked for
  /// Location errors, what was found and what these rows do not show, with their covariance after
  /// the measurement by rows (Eq. 189); only where `covariances` is asked for.
  std::vector<UncertainParameter> uncertain;
  std::vector<double> covariance;
};

struct MachineDiagnoseOptions {
  CalibrationOptions calibration;
  double false_alarm = 0.01;  ///< per measurement, over all hypotheses
  std::size_t max_findings = 6;
  double typical_length_mm = 0.01, typical_angle_rad = 50e-6;  ///< that must be seen
  bool covariances = false;  ///< of what a program's tip depends on, with every plan
};

/// Every effect is tested beside what is always fitted (places, location errors): an exact F test
/// with Bonferroni's correction (Eqs. 178-187). @throws InputError as `calibrate`
MachineDiagnosis diagnose_machine(const Machine& machine, std::span<const MachineMeasurement> data,
                                  const MachineDiagnoseOptions& options = {});

/// The plan of a machine that was not measured yet: a ball at a grid of rotary positions and back
/// (plan B1, 1 µm), what it does not show, and what would. @throws InputError for a machine without
/// a rotary axis or three linear ones
MachineDiagnosis plan_machine(const Machine& machine, const MachineDiagnoseOptions& options = {});

}  // namespace trueaxis

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "trueaxis/covariance.hpp"
#include "trueaxis/units.hpp"

/// A machine of three to six axes as a chain from the workpiece to the tool, and the errors of its
/// axes (machine.md). From these follow where the tool is in the part, and the axis positions that
/// put it where it should be. Inside mm and rad. M is a frame fixed to the bed; with all axes at 0
/// (zero position) the frames of all bodies coincide with M.
namespace trueaxis {

using Vector3 = std::array<double, 3>;
using Matrix3 = std::array<Vector3, 3>;  ///< rows

/// In the order of the words of a program, which is that of every array by axis.
enum class AxisName { X, Y, Z, A, B, C };
inline constexpr std::size_t axis_count = 6;
constexpr std::size_t index_of(AxisName axis) { return static_cast<std::size_t>(axis); }
constexpr bool is_rotary(AxisName axis) { return axis >= AxisName::A; }
constexpr char letter_of(AxisName axis) { return "XYZABC"[index_of(axis)]; }

/// A position of every axis by `index_of`: mm of X Y Z, rad of A B C. What is there for an axis
/// that the machine has not is not read, and 0 in what is returned.
using AxisPositions = std::array<double, axis_count>;

/// x_to = rotation · x_from + origin.
struct RigidTransform {
  Matrix3 rotation{{{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}}};
  Vector3 origin_mm{};
};

/// Rz(c) Ry(b) Rx(a) of {a, b, c}: turned about the fixed axes x, y, z in this order.
Matrix3 rotation_zyx(const Vector3& angles_rad);

struct MachineAxis {
  AxisName name = AxisName::X;
  bool carries_workpiece = false;  ///< between w and b: a prime in the chain
  Vector3 direction{};  ///< unit, in M: in which the tool moves against the workpiece for + (ISO
                        ///< 841); of a rotary axis by the right hand
  Vector3 point_mm{};   ///< of a rotary axis' line, in M, zero position
  double low = -std::numeric_limits<double>::infinity();  ///< limits of the position: mm, rad
  double high = std::numeric_limits<double>::infinity();
};

/// Tip = gauge point − length · direction, in M, zero position.
struct MachineTool {
  Vector3 gauge_point_mm{};
  Vector3 direction{0.0, 0.0, 1.0};  ///< unit, from the tip to the holder
  double length_mm = 0.0;
};

inline constexpr std::size_t work_offset_count = 6;  ///< G54 … G59

struct WorkOffset {
  RigidTransform bed_from_program;  ///< W0, in the zero position
  AxisPositions zero{};             ///< axis positions where the words are 0
};

/// What the words of a program say.
enum class ProgramMode {
  axes,  ///< axis positions: q = word + zero, + length along the tool while G43 is on
  tip    ///< X Y Z are the tip in W0; of a rotary axis q = word + zero
};

struct Machine {
  std::string name;
  std::string chain;              ///< as it was given, "w C' A' Y' b X Z t"
  std::vector<MachineAxis> axes;  ///< from the workpiece to the tool, without the bed
  MachineTool tool;
  std::map<int, double> tool_lengths_mm;                                  ///< by the number T
  std::array<std::optional<WorkOffset>, work_offset_count> work_offsets;  ///< as far as given
  ProgramMode mode = ProgramMode::axes;
  std::array<std::optional<double>, axis_count> start;  ///< words in force before the first block
  double max_rotary_change_rad = 0.5 * rad_per_deg;     ///< of a compensation, at a pole

  const MachineAxis* find(AxisName axis) const;  ///< null: it has none of this name
  std::size_t linear_count() const;
  std::size_t rotary_count() const;
};

/// One part of a chain's text that is wrong, with the character (from 0) at which it begins.
struct ChainTrouble {
  std::size_t at = 0;
  std::string message;
};

/// The axes of a chain of ISO 10791-6 from workpiece to tool, with the directions of their letters:
/// one `w` first, one bed `b`, one `t` last, three to six of X Y Z A B C once each, primes exactly
/// between w and b; brackets and spindles in parentheses, `(C1)`, are skipped. What is wrong is
/// added to `troubles`.
std::vector<MachineAxis> parse_chain(std::string_view chain, std::vector<ChainTrouble>& troubles);

/// The body that an error belongs to: an axis (by `index_of`), the spindle or the workpiece.
inline constexpr std::size_t spindle_body = 6, workpiece_body = 7, body_count = 8;

/// EXX … ECC (component errors, functions of the commanded position of the axis that is the last
/// letter), X0X … C0C (location errors of an axis), X0S … C0S (spindle), X0W … C0W (workpiece).
struct ErrorName {
  bool component = false;     ///< E.. rather than .0.
  std::size_t direction = 0;  ///< 0 … 2: along X Y Z; 3 … 5: about them
  std::size_t body = 0;

  bool angular() const { return direction >= 3; }
  bool operator==(const ErrorName&) const = default;
};
std::string to_string(const ErrorName& name);
std::optional<ErrorName> parse_error_name(std::string_view text);

/// An error that moves the line of a linear axis along itself or turns it about itself (Y0X, A0X):
/// it has no effect.
bool without_effect(const ErrorName& name);

// The kinds of error: a value (mm or rad) as a function of the position q (mm or rad) of an axis.

struct ConstantError {
  double value = 0.0;
};
/// Σ cᵢ sⁱ, s = (q − origin)/scale.
struct PolynomialError {
  std::vector<double> coefficients;
  double origin = 0.0, scale = 1.0;
};
/// Σ a cos(2πnq/P) + b sin(2πnq/P).
struct FourierError {
  struct Term {
    double order = 1.0, cos = 0.0, sin = 0.0;
  };
  std::vector<Term> terms;
  double period = two_pi;
};
/// Linear between `at`, which ascend; the end values held, or the table repeated over its length.
struct TableError {
  std::vector<double> at, values;
  bool periodic = false;
};
using ErrorFunction = std::variant<ConstantError, PolynomialError, FourierError, TableError>;

double value_at(const ErrorFunction& function, double position);

struct ErrorTerm {
  ErrorName name;
  ErrorFunction function;
  double u = 0.0;  ///< standard uncertainty of a constant added to it, mm or rad; 0: not stated
  /// From where to where on its axis it was measured, mm or rad; none: it holds everywhere.
  std::optional<std::array<double, 2>> known_over{};
};

/// Of component errors of the workpiece side.
enum class ErrorSign {
  moving_part,          ///< the carriage's own deviation
  tool_minus_workpiece  ///< of the tool against the table (a laser between them): inverted
};

/// A number by which an error is uncertain: it multiplies a function of size 1 mm or 1 rad.
struct UncertainAmount {
  enum class Shape {
    constant,
    legendre,  ///< P_order over `low` … `high`
    cosine,    ///< cos(2π order q/period), period = high − low
    sine
  };
  ErrorName name;
  Shape shape = Shape::constant;
  int order = 0;
  double low = 0.0, high = 0.0;  ///< mm or rad

  ErrorFunction unit() const;
  bool operator==(const UncertainAmount&) const = default;
};
std::string to_string(const UncertainAmount& amount);  ///< X0C, EXX.poly2, EYC.cos1

using ErrorCovariance = CovarianceOf<UncertainAmount>;  ///< mm and rad; each amount once

struct ErrorModel {
  ErrorSign sign = ErrorSign::moving_part;
  std::array<Vector3, 3> reference_mm{};  ///< of X Y Z: pivot of their angular errors, in M
  std::vector<ErrorTerm> terms;           ///< those of one name add
  ErrorCovariance covariance;  ///< in addition to u of terms: u of a constant is in one of the two

  double value(const ErrorName& name, const AxisPositions& axes) const;
};

/// Program frame and tool in force: they change in a program, the chain does not.
struct Setting {
  RigidTransform bed_from_program;  ///< W0
  double tool_length_mm = 0.0;
};

/// G54, or the program frame M where none is given, and the machine's own tool length.
Setting first_setting(const Machine& machine);

/// The tool in the part (the program frame in force).
struct ToolPose {
  Vector3 tip_mm{};
  Vector3 direction{};  ///< unit, from the tip to the holder
  Matrix3 rotation{};   ///< part_from_tool; identity in the zero position where W0 is not turned
};

/// A small displacement of the tool in the part: the tip's, and the rotation vector.
struct ToolDisplacement {
  Vector3 tip_mm{};
  Vector3 rotation_rad{};
};

/// `actual` against `nominal`: the difference of the tips, and the rotation vector of
/// actual · nominalᵀ.
ToolDisplacement displacement(const ToolPose& actual, const ToolPose& nominal);

/// The angle between two directions, exact for small ones.
double angle_between_rad(const Vector3& a, const Vector3& b);

/// The rotation about the tool's own direction in actual · nominalᵀ (swing-twist decomposition).
double about_tool_axis_rad(const ToolPose& actual, const ToolPose& nominal);

/// Columns of axes by `index_of`, 0 of those that are not there: tip in mm, rotation in rad, in the
/// part, per mm or rad of the axis.
using ToolJacobian = std::array<ToolDisplacement, axis_count>;

/// A machine with its errors, made ready to be asked for many positions. Immutable: threads share
/// it. A copy is cheap and shares what it holds.
class MachineModel {
 public:
  /// @throws InputError for errors of an axis that the machine does not have, and for those without
  /// effect that are not 0.
  explicit MachineModel(const Machine& machine, const ErrorModel& errors = {});

  const Machine& machine() const;
  const ErrorModel& errors() const;

  ToolPose nominal(const AxisPositions& axes, const Setting& setting) const;
  ToolPose actual(const AxisPositions& axes, const Setting& setting) const;

  /// For the nominal chain, by the product of exponentials.
  ToolJacobian jacobian(const AxisPositions& axes, const Setting& setting) const;
  /// What the errors do at commanded `axes`, linear in all of them (their total differential): L.
  ToolDisplacement linear_error(const AxisPositions& axes, const Setting& setting) const;

  struct Compiled;
  const Compiled& compiled() const { return *compiled_; }

 private:
  std::shared_ptr<const Compiled> compiled_;
};

/// Where the tool shall be in the part.
struct ToolTarget {
  Vector3 tip_mm{};
  Vector3 direction{0.0, 0.0, 1.0};  ///< unit
};

/// All axis positions of the nominal machine that put the tool at a target.
struct InverseKinematics {
  std::vector<AxisPositions> solutions;  ///< within the limits, the nearest first
  std::string why_none;                  ///< where there is none
};

/// Every solution within the limits, a rotary axis in every turn that its limits allow (without
/// limits: in the nearest one); first the one whose rotary axes are nearest to `near`. If an axis
/// may be anywhere (a pole), it stays as `near` has it; of three rotary axes the one next to the
/// workpiece does.
InverseKinematics axes_for(const MachineModel& model, const ToolTarget& target,
                           const AxisPositions& near, const Setting& setting);

/// The linear axes that put the tip of the nominal machine at `tip_mm`, the rotary ones as `axes`
/// has them; nothing for a machine whose linear axes do not span space. Limits are not asked.
std::optional<AxisPositions> axes_for_tip(const MachineModel& model, const Vector3& tip_mm,
                                          const AxisPositions& axes, const Setting& setting);

enum class CompensationStatus {
  compensated,  ///< as far as the axes of the machine can: see the parts that are left
  singular,     ///< near a pole: tip exact, of the direction what is not worth a rotary change left
  outside,      ///< an axis would leave its limits
  unreachable   ///< the tip cannot be put there
};

struct CompensatedPosition {
  AxisPositions axes{};  ///< to command
  CompensationStatus status = CompensationStatus::compensated;
  double tip_left_mm = 0.0;          ///< distance of the actual tip from the nominal one
  double direction_left_rad = 0.0;   ///< angle between the directions
  double about_tool_axis_rad = 0.0;  ///< residual about the tool's own axis
  std::string why;                   ///< outside, unreachable: which axis, by how much
};

/// Axis positions at which the actual machine has the tip and direction that the nominal one has at
/// `commanded`, nearest to those; by Newton, to rounding. Rotary axes change by
/// `machine.max_rotary_change_rad` at most, and near a pole by twenty times at most what this turns
/// the tool. With fewer than two rotary axes the tip is exact and the angle least; with fewer than
/// three linear ones only the tip is looked at.
CompensatedPosition compensate_exactly(const MachineModel& model, const AxisPositions& commanded,
                                       const Setting& setting);

/// The same for a target that no position need be commanded for, the nearest to `near`.
CompensatedPosition compensate_exactly(const MachineModel& model, const ToolPose& target,
                                       const AxisPositions& near, const Setting& setting);

/// Δq = −J⁻¹ L (Bohez 2002, the total differential): J nominal, L linear in all errors, at the
/// commanded position; exactly proportional to the errors. The same rule at poles.
CompensatedPosition compensate_by_differential(const MachineModel& model,
                                               const AxisPositions& commanded,
                                               const Setting& setting);

}  // namespace trueaxis

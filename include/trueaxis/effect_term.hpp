// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "trueaxis/probe_stream.hpp"

namespace trueaxis {

/// The geometry of every reading, one entry each, as the ideal fit predicts it; lengths mm.
/// Pass a block of the stream at a time: nothing here depends on the other readings. A face is
/// probed along Z at (C, X): X below is then its Z, and Z its X.
struct TermContext {
  std::span<const double> c_rad, z_mm, time_s;        ///< as recorded
  std::span<const double> speed_rad_per_s;            ///< of the spindle, signed like C
  std::span<const double> velocity_mm_per_s;          ///< of Z, signed
  std::span<const double> x_mm;                       ///< predicted X
  std::span<const double> sensed_mm;                  ///< predicted X without the jogs of the slide
  std::span<const double> dx_dc, dx_dz;               ///< mm per rad, mm per mm
  std::span<const double> d2x_dc2;                    ///< mm per rad²; probe.lag, probe.hysteresis
  std::span<const double> dx_dy;                      /**< across the probe, mm per mm: of a face;
      else it follows from dx_dc */
  std::span<const double> theta_rad, theta_chuck_rad; /**< polar angle of the contact about the
      part's axis, fixed to the part and to the chuck (θ_chuck = θ + re-indexing) */
  std::span<const double> s_mm;                       /**< of the contact, along the part's axis; of
      a face its distance from the axis */
  std::span<const double> clamp_force_ratio;          ///< against the first set-up

  double z_mid_mm = 0.0, z_half_mm = 1.0;  ///< u = (z − z_mid)/z_half, −1 … 1 when probed
  double height_mm = 0.0;                  ///< of the probe line
  double tan_half_angle = 0.0;             ///< signed like the surface's
  bool bore = false, rear = false;         ///< inside a bore; at the smaller X
  bool face = false;                       ///< probed along Z
  /// Whether the surface is that of the readings, which a play has turned, and not of the part.
  bool as_read = false;
  /// Whether X grew (1) or fell (−1) where a play was last taken up, as it is known of X with all
  /// that it has; or empty.
  std::span<const double> play_side{};

  std::size_t size() const { return c_rad.size(); }
};

/// Parameters in which a term is not linear. A term reads those that its kind names.
struct TermShape {
  double order = 2.0;              ///< of a harmonic; jaws of a chuck; κ of an asynchronous motion
  double lever_from_mm = 0.0;      ///< Z of the bearing, s of the jaws
  double decay_length_mm = 100.0;  ///< L of exp(−|s − s_jaw|/L), and of FormAtEnds
  int degree = 2;                  ///< highest Legendre degree of slide.z_straightness
  double period_mm = 1.0;          ///< wavelength, feed, pitch, period of the scale
  double frequency_hz = 50.0;
  double time_constant_s = 600.0;  ///< of thermal.drift; of probe.lag the T to linearise at
  double onset_s = 0.0;            ///< instant of a slip, or its start
  double duration_s = 0.0;         ///< of a slip; 0: it is a step
  double settling_s = 0.0;         ///< time constant τ of a slip that dies out; 0: it is even
  double reference_x_mm = 0.0;     ///< X_ref of the sensor
  double range_mm = 1.0;           ///< that v of probe.nonlinearity is 1 at
  double play_mm = 0.0;            ///< of probe.hysteresis: the play to linearise at
  double ball_radius_mm = 0.0;     ///< what no wave of the surface is read sharper than; 0: unknown

  bool operator==(const TermShape&) const = default;
};

/// What a term's value moves. The derivative of the reading along it is the chain rule's other
/// factor, for X and for a face's Z.
enum class TermPort {
  x,       ///< machine X: 1; of a face −∂Z/∂X
  normal,  ///< the surface along its normal, away from the part's axis, of a face towards +Z: ∂X/∂ρ
  c,       ///< argument C: ∂X/∂C
  z,       ///< argument Z: ∂X/∂Z; of a face −1
  reading  ///< what the probe indicates: 1
};

/// cos, sin (n angle) × envelope along Z (Eqs. 39, 40).
struct Harmonic {
  enum class Angle { part, chuck, spindle };
  enum class Envelope {
    constant,  ///< 1
    growing,   ///< 1 and u
    lever,     ///< Z − Z_bearing, and 1: a tilt and a radial motion, each with its own phase
    jaws,      ///< exp(−|s − s_jaw|/L) × force; orders n and 2n
    parabola,  ///< u² cos α; of n = 1 u² − 1/3: an axis bent about its nearest line
    square     ///< (s/s_end)²: a warped face
  };
  Angle angle = Angle::spindle;
  Envelope envelope = Envelope::constant;
  TermPort port = TermPort::x;
  double fixed_order = 0.0;  ///< 0: the shape's
};

/// P_first … P_last(u); last 0: up to the shape's degree. `plain`: Z itself instead (Eq. 42), of a
/// face X from the middle of what was probed. `dish`: (s/s_end)² less its mean before them (Eq.
/// 135).
struct PolynomialInZ {
  int first = 1, last = 1;
  TermPort port = TermPort::x;
  bool plain = false;
  bool dish = false;
};

/// cos, sin (2π z/period − turns θ) (Eq. 43).
struct PeriodicInZ {
  TermPort port = TermPort::normal;
  double turns = 0.0;
};

/// exp(−d²/2L²) of the distance d from the lower and from the upper end of what was probed (Eq.
/// 43a).
struct FormAtEnds {};

/// cos, sin (2π f t), in X (Eq. 44).
struct PeriodicInTime {};

/// t and 1 − exp(−t/τ), in X (Eq. 45).
struct GrowthInTime {};

/// At an instant, or over a duration, evenly or as exp(−t/τ), the part moved, turned, tilted, and
/// changed its radius and taper (Eq. 46); `seat`: moved along Z and tilted (Eq. 136). The surface
/// is where it is afterwards.
struct PartStep {
  bool seat = false;
};

/// Constant shifts of the arguments (Eqs. 47, 48).
struct ArgumentShift {
  enum class By {
    angle,    ///< C' = C + c
    delay,    ///< C' = C − ω τ, Z' = Z − v τ
    backlash  ///< Z' = Z − sign(v) b/2; X + sign(v) c/2
  };
  By by = By::angle;
};

/// Geometry of the probe: line Y = h, its tilt in X-Z, its ball (Eq. 49).
struct ProbeLine {
  enum class Of { height, tilt, ball };
  Of of = Of::height;
};

/// Functions of what the sensor meets (Eq. 50).
struct Response {
  enum class Of {
    gain,          ///< X − X_ref
    zero,          ///< 1
    nonlinearity,  ///< v², v³ with v = (X − X_ref)/range
    cyclic,        ///< cos, sin (2π X/period)
    pretravel,     ///< into the material: 1; and cos, sin (n ψ) × tilt of the normal
    lag,           ///< first order, at T
    hysteresis     ///< what X must go back before the reading does, at a play
  };
  Of of = Of::gain;
};

using EffectTerm =
    std::variant<std::monostate, Harmonic, PolynomialInZ, PeriodicInZ, FormAtEnds, PeriodicInTime,
                 GrowthInTime, PartStep, ArgumentShift, ProbeLine, Response>;

/// A parameter in which X_M is linear, near zero. Two that follow each other are the factors of cos
/// and sin of one size: NAME_cos, NAME_sin. a cos(n θ − φ) has (a cos φ, a sin φ), a cos(k z + φ)
/// (a cos φ, −a sin φ).
struct LinearParameter {
  enum class Factor { itself, cosine, sine };
  std::string name;
  std::string unit;
  std::string size = {};  ///< the name of its size, where that is another
  Factor factor = Factor::itself;

  std::string_view size_name() const { return size.empty() ? name : size; }
};

/// The linear parameters of a term, in the order of its columns.
std::vector<LinearParameter> linear_parameters(const EffectTerm& term, const TermShape& shape);

/// Writes ∂X_M/∂(linear parameter) at zero amplitude over the readings of `context`;
/// `columns[j]` has room for context.size() values. What a term needs of the context must be there.
/// Eq. 37.
/// @throws ContractViolation when a column is missing or their number is not that of
/// linear_parameters.
void fill_columns(const EffectTerm& term, const TermContext& context, const TermShape& shape,
                  std::span<double* const> columns);

/// The names of the shape parameters that a term reads.
std::vector<std::string> shape_parameters(const EffectTerm& term);

/// Whether the part is elsewhere after the term: a slip, at once or over its duration. No value of
/// a step predicts another.
bool is_step(const EffectTerm& term);

/// Whether the term has two orders, the one twice the other: the lobes of jaws.
bool has_two_orders(const EffectTerm& term);

/// Value of a shape parameter by the name that shape_parameters gives it.
/// @throws ContractViolation for another name.
double shape_value(const TermShape& shape, std::string_view name);
void set_shape_value(TermShape& shape, std::string_view name, double value);

}  // namespace trueaxis

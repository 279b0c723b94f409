// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "trueaxis/probe_stream.hpp"

namespace trueaxis {

/// The geometry of every reading, one entry each, as the ideal surface predicts it; lengths mm.
/// Pass a block of the stream at a time: nothing here depends on the other readings. A face is
/// probed along Z at (C, X): X below is then its Z, and Z its X.
struct TermContext {
  std::span<const double> c_rad, z_mm, time_s;        ///< as recorded
  std::span<const double> speed_rad_per_s;            ///< of the spindle, signed like C
  std::span<const double> velocity_mm_per_s;          ///< of Z, signed
  std::span<const double> x_mm;                       ///< predicted X
  std::span<const double> sensed_mm;                  ///< predicted X without the jogs of the slide
  std::span<const double> dx_dc, dx_dz;               ///< mm per rad, mm per mm
  std::span<const double> d2x_dc2;                    ///< mm per rad², for probe.lag only
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

  std::size_t size() const { return c_rad.size(); }
};

/// Parameters in which a term is not linear. A term reads those that its kind names.
struct TermShape {
  double order = 2.0;              ///< of a harmonic; jaws of a chuck; κ of an asynchronous motion
  double lever_from_mm = 0.0;      ///< Z of the bearing, s of the jaws
  double decay_length_mm = 100.0;  ///< L of exp(−|s − s_jaw|/L)
  int degree = 2;                  ///< highest Legendre degree of slide.z_straightness
  double period_mm = 1.0;          ///< wavelength, feed, pitch, period of the scale
  double frequency_hz = 50.0;
  double time_constant_s = 600.0;  ///< of thermal.drift; of probe.lag the T to linearise at
  double onset_s = 0.0;            ///< instant of a slip
  double reference_x_mm = 0.0;     ///< X_ref of the sensor
  double range_mm = 1.0;           ///< that v of probe.nonlinearity is 1 at
};

/// What a term's value moves. The derivative of the reading along it is the chain rule's other
/// factor: of X, and of a face's Z.
enum class Port {
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
  Port port = Port::x;
  double fixed_order = 0.0;  ///< 0: the shape's
};

/// P_first … P_last(u); last 0: up to the shape's degree. `plain`: Z itself instead (Eq. 42), of a
/// face X from the middle of what was probed. `dish`: (s/s_end)² less its mean before them (Eq.
/// 135).
struct PolynomialInZ {
  int first = 1, last = 1;
  Port port = Port::x;
  bool plain = false;
  bool dish = false;
};

/// cos, sin (2π z/period − turns θ) (Eq. 43).
struct PeriodicInZ {
  Port port = Port::normal;
  double turns = 0.0;
};

/// cos, sin (2π f t), in X (Eq. 44).
struct PeriodicInTime {};

/// t and 1 − exp(−t/τ), in X (Eq. 45).
struct GrowthInTime {};

/// At an instant the part moved, turned, tilted, and changed its radius and taper (Eq. 46); `seat`:
/// moved along Z and tilted (Eq. 136). The surface is where it is afterwards.
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
    nonlinearity,  ///< v², v³ with v = (X − X_ref)/range
    cyclic,        ///< cos, sin (2π X/period)
    pretravel,     ///< into the material: 1; and cos, sin (n ψ) × tilt of the normal
    lag            ///< first order, at T
  };
  Of of = Of::gain;
};

using Term = std::variant<std::monostate, Harmonic, PolynomialInZ, PeriodicInZ, PeriodicInTime,
                          GrowthInTime, PartStep, ArgumentShift, ProbeLine, Response>;

/// A parameter in which X_M is linear, near zero.
struct LinearParameter {
  std::string name;
  std::string unit;
};

/// The linear parameters of a term, in the order of its columns. A pair NAME_cos, NAME_sin are the
/// factors of cos and sin: a cos(n θ − φ) has (a cos φ, a sin φ), a cos(k z + φ) (a cos φ, −a sin
/// φ).
std::vector<LinearParameter> linear_parameters(const Term& term, const TermShape& shape);

/// Writes ∂X_M/∂(linear parameter) at zero amplitude over the readings of `context`;
/// `columns[j]` has room for context.size() values. What a term needs of the context must be there.
/// Eq. 37.
/// @throws ContractViolation when a column is missing or their number is not that of
/// linear_parameters.
void fill_columns(const Term& term, const TermContext& context, const TermShape& shape,
                  std::span<double* const> columns);

/// The names of the shape parameters that a term reads.
std::vector<std::string> shape_parameters(const Term& term);

/// Where an effect enters the measuring chain (C, Z, t) → A → B → C → D → E → X_M.
enum class Slot {
  arguments,   ///< A: C' = C + δC, Z' = Z + δZ
  probe_line,  ///< B: height, tilt, ball
  part,        ///< C: the part's surface, along its normal
  machine,     ///< D: added to X
  sensor,      ///< E: response
  noise        ///< ε
};

/// What an effect is fixed to: what re-chucking, reversal, another speed or a return pass does.
enum class Frame { part, chuck, spindle, machine, probe, time };

/// A parameter with the sizes that machines show: priors, not limits. Both 0: no typical size.
struct EffectParameter {
  std::string_view name;
  std::string_view unit;  ///< mm, rad, s, Hz, 1 and quotients of them
  double low = 0.0, high = 0.0;
  std::string_view meaning;
  std::string_view of = {};     ///< shape or linear parameter that it tells, where named otherwise
  double share_of_range = 0.0;  ///< share of shape.range_mm that `high` is at most; 0: any
  double least = -1e300, most = 1e300;  ///< of a linear one; what is beyond is no such effect
};

/// What a stream must have for an effect to be seen in it.
struct Requirement {
  bool time = false;                      ///< t of every reading
  bool length = false;                    ///< positions along Z
  bool cone = false;                      ///< an angle to the axis, by which X changes along Z
  bool cylinder = false;                  ///< no half angle of the surface, which would be the same
  bool both_feeds = false;                ///< passes in +Z and in −Z
  std::optional<StreamKind> stream = {};  ///< what is probed, where another has no such effect
};

/// Values of a parameter of the shape, in what a stream has.
struct ShapeValues {
  enum class In {
    itself,        ///< the parameter's own unit
    half_lengths,  ///< a place: the middle of the probed length plus so many halves of it
    per_length,    ///< a wavelength: the probed length over the value
    per_swing,     ///< a wavelength: the range of what the probe senses over the value
    duration,      ///< a time: share of what the measurement lasts
    instant        ///< when so large a share of the readings was taken
  };
  double TermShape::*parameter = nullptr;
  std::vector<double> values = {};
  In in = In::itself;
  std::size_t alone = 0;  ///< index of the value that is taken where only one is tried
};

/// Parameters that are free together, at some shapes.
struct Form {
  std::vector<std::size_t> free = {};  ///< linear parameters; empty: all
  ShapeValues starts = {};             ///< shapes to start from; none: the typical one
  int degrees = 0;                     ///< Legendre degrees along Z that the stream must tell
  std::string_view told = {};          ///< not empty: limits of the plan are told of it apart
};

/// What a search tries of an effect one by one, beside the lines that it scans for.
struct SearchRange {
  enum class When {
    always,      ///< in every step
    told_apart,  ///< so once re-chucking or the rear side tells frames; before, as `at_orders`
    at_orders,   ///< at those undulations per revolution that stand out
    scanned      ///< by a scan alone: as a line, or a step between any two readings
  } when = When::always;
  std::vector<Form> forms = std::vector<Form>(1);
  int highest_order = 0;   ///< of a harmonic of free order; 0: what the sampling tells
  int highest_degree = 0;  ///< of a polynomial of free degree
  int lowest_degree = 0;   ///< of such a one; 0: its first
  double tests = 0.0;  ///< what the choice counts as, for an order; 0: the forms × their starts
};

/// A line of unknown frequency, which a periodogram finds. Its phase φ is that of cos(2π f x + φ).
struct Line {
  enum class In {
    angle,   ///< C; frequencies are orders
    time,    ///< t: Hz
    length,  ///< s of the part: 1/mm, as of the following
    slide,   ///< Z of the machine
    spiral,  ///< s, with turns of θ
    sensed   ///< X as the sensor meets it
  } in = In::length;
  double low = 0.0, high = 0.0;
  double least_cycles = 0.0;  ///< over what the stream has
};

/// A shape parameter that is refined: how a step d moves it, on a scale where 1 is its range.
struct Refinement {
  enum class By {
    factor,    ///< times exp(range d)
    sum,       ///< plus range d
    duration,  ///< plus what the measurement lasts times d, within it
    lever  ///< κ plus d, κ the half length over the distance of the middle: what data show of it
  };
  double TermShape::*parameter = nullptr;
  By by = By::factor;
  double range = 1.0, low = 0.0, high = 1e300;
  std::optional<std::size_t> reader = {};  ///< the linear parameter that reads it; none: all
};

/// A measurement that tells causes apart.
struct Separator {
  std::string_view code, what;
};

/// How a measurement separates this effect from its confounders.
struct Separation {
  std::string_view code, how;
};

/// Largest shift of the identified axis over Z when the effect is left out, per unit of its
/// parameter; R = 40 mm, tan α = 0.1, e = 0.2 mm, tilt 1 mrad, Z 0-60 mm. Depends on the plan.
struct AxisBias {
  double value = 0.0;
  std::string_view unit, text;
};

/// What a check of the data looks for.
enum class Check {
  interruption,
  saturation,
  quantisation,
  incidence_noise,
  correlated_noise,
  stated_noise,
  outliers
};

/// An entry of the catalogue: data that the engine, the report and the command line read.
struct Effect {
  std::string_view id = {};
  std::string_view title = {};
  Slot slot = Slot::part;
  Frame frame = Frame::part;
  Term term = {};                 ///< how it is computed; monostate for a check
  std::string_view formula = {};  ///< the term as text
  std::vector<EffectParameter> parameters = {};
  std::string_view signature = {};
  std::vector<std::string_view> confounders = {};  ///< ids
  std::string_view absorbed_by = {};               ///< parameters of the surface that take it in
  std::vector<Separation> separations = {};
  std::optional<AxisBias> axis_bias = {};
  std::string_view source = {};
  std::optional<Check> check = {};  ///< quality of the data: never a name for a form

  Requirement needs = {};
  std::vector<ShapeValues> typical = {};  ///< shape: the first of the values each
  SearchRange search = {};
  std::optional<Line> line = {};
  std::optional<Refinement> refinement = {};
  std::string_view second_order_twin = {};  ///< id: one in the first order, told in the second
  int between_passes = 0;  ///< place among those that show from pass to pass, beside which the
                           ///< noise is judged, as many as it can bear; 0: none of them
  bool repeats_at_tool = false;  ///< a motion that the tool meets as the probe did
  /// How much wider than their range its sizes spread: above 1 what wears, below what is set by
  /// hand and would be seen.
  double size_spread = 1.0;
  /// Line of the budget (an Influence) by which a user states its u; empty: none.
  std::string_view stated_as = {};
  bool same_in_cut = false;  ///< the cut meets it as the probe did: the axis it cuts is the same
};

/// A pattern of no cause, along the normal of the part or along X: cos, sin of
/// (order × angle − 2π ν s) × a Legendre polynomial, or a local bump (Eqs. 73–75).
struct Pattern {
  enum class Kind {
    fourier_legendre,  ///< order × Legendre degree along s or time
    line,              ///< turns along s or time with a frequency
    bump               ///< exp(−v²/2 − w²/2), v in angle and w along s
  } kind = Kind::fourier_legendre;
  double order = 0.0;    ///< undulations per revolution
  bool spindle = false;  ///< angle C instead of the part's θ
  int degree = 0;        ///< Legendre, along s or time
  bool in_time = false;
  double frequency = 0.0;  ///< ν of a line: cycles per mm along s, or per second
  double angle_rad = 0.0, position_mm = 0.0, width_rad = 0.0, length_mm = 0.0;  ///< of a bump
};

/// The one representation of a term beside the surface, from the search to JSON, lathe, correction
/// and report: an effect of the catalogue with its shape, or a pattern; its linear amplitudes and
/// their covariance once they are fitted.
struct TermValue {
  const Effect* effect = nullptr;  ///< of a catalogue that outlives this; nullptr: a pattern
  TermShape shape;                 ///< of an effect
  std::vector<std::size_t> free;   ///< which linear parameters are free; empty: all
  Pattern pattern;                 ///< of no effect

  /// Amplitudes in the order of linear_parameters(effect->term, shape), 0 where not free; of a
  /// pattern the factors of cos and sin, or of the bump. mm, rad, s. Empty: not fitted.
  std::vector<double> linear;
  std::vector<double> covariance;  ///< of `linear`, row-major; empty: not fitted

  std::size_t columns() const;  ///< how many are free
  std::string id() const { return effect ? std::string(effect->id) : "unexplained"; }
};

/// Whether the term is a step at an instant: no value of its shape predicts another, and the part
/// stands elsewhere afterwards.
bool is_step(const Term& term);

/// Whether the term has two orders, the one twice the other: the lobes of jaws.
bool has_two_orders(const Term& term);

/// Whether the undulations per revolution are a parameter of the shape.
bool has_free_order(const Effect& effect);

/// The parameter that tells a linear or shape parameter; nullptr: it is told by its own name, or
/// not at all.
const EffectParameter* parameter_for(const Effect& effect, std::string_view name);

/// The parameter whose typical sizes are those of a linear one: of its name, or as amplitude of
/// amplitude_cos; nullptr: none.
const EffectParameter* size_for(const Effect& effect, std::string_view linear);

/// Value of a shape parameter by the name that shape_parameters gives it.
/// @throws ContractViolation for another name.
double shape_value(const TermShape& shape, std::string_view name);
void set_shape_value(TermShape& shape, std::string_view name, double value);

/// All effects and checks, family by family.
std::span<const Effect> effect_catalogue();

/// nullptr when there is none with this id.
const Effect* find_effect(std::string_view id);

/// The known ids most like a misspelt one, best first.
std::vector<std::string_view> nearest_effects(std::string_view id, std::size_t count = 3);

std::span<const Separator> separators();

std::string_view to_string(Slot slot);
std::string_view to_string(Frame frame);

}  // namespace trueaxis

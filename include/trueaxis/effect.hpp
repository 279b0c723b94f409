// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "trueaxis/covariance.hpp"
#include "trueaxis/effect_term.hpp"
#include "trueaxis/influence.hpp"
#include "trueaxis/probe_stream.hpp"

namespace trueaxis {

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
enum class EffectFrame { part, chuck, spindle, machine, probe, time };

/// A parameter with the sizes that machines show: priors, not limits. Both 0: no typical size.
struct EffectParameter {
  std::string_view name;
  std::string_view unit;  ///< mm, rad, s, Hz, 1 and quotients of them
  double low = 0.0, high = 0.0;
  std::string_view meaning;
  std::string_view of = {};  ///< shape or linear parameter that it tells, where named otherwise
  /// The share of `share_of`, a parameter of the shape, that `high` is at most; 0: any.
  double share = 0.0;
  double least = -1e300, most = 1e300;  ///< of a linear one; what is beyond is not such an effect
  double TermShape::*share_of = &TermShape::range_mm;
};

/// What a stream must have for an effect to be seen in it.
struct Requirement {
  bool time = false;                      ///< t of every reading
  bool length = false;                    ///< positions along Z
  bool cone = false;                      ///< an angle to the axis, by which X changes along Z
  bool cylinder = false;                  ///< no half angle of the surface, which would be the same
  bool both_feeds = false;                ///< passes in +Z and in −Z
  bool turning = false;                   ///< read while the part turns, not by hand at few angles
  std::optional<StreamKind> stream = {};  ///< what is probed, where another has no such effect
};

/// Values of a parameter of the shape, in what a stream has.
struct ShapeValues {
  enum class In {
    itself,        ///< the parameter's own unit
    half_lengths,  ///< a place: the middle of the probed length plus so many halves of it
    per_length,    ///< a wavelength: the probed length over the value
    turns,         ///< a reach at an end: what so many turns of the longest pass go along
    per_swing,     ///< a wavelength: the range of what the probe senses over the value
    duration,      ///< a time: share of what the measurement lasts
    instant        ///< when so large a share of the readings is recorded
  };
  double TermShape::*parameter = nullptr;
  std::vector<double> values = {};
  In in = In::itself;
  std::size_t alone = 0;  ///< index of the value to use if only one is tried
};

/// Parameters that are free together, at some shapes.
struct SearchForm {
  std::vector<std::size_t> free = {};  ///< linear parameters; empty: all
  ShapeValues starts = {};             ///< shapes to start from; none: the typical one
  int degrees = 0;                     ///< Legendre degrees along Z that the stream must tell
  std::string_view told = {};          ///< not empty: has limits of the plan of its own
};

/// What a search tries of an effect one by one, in addition to the lines that it scans for.
struct SearchRange {
  enum class When {
    always,      ///< in every step
    told_apart,  ///< so once re-chucking or the rear side tells frames; before, as `at_orders`
    at_orders,   ///< at those undulations per revolution with a peak
    scanned      ///< by a scan alone: as a line, or a step between any two readings
  } when = When::always;
  std::vector<SearchForm> forms = std::vector<SearchForm>(1);
  int highest_order = 0;   ///< of a harmonic of free order; 0: what the sampling tells
  int highest_degree = 0;  ///< of a polynomial of free degree
  int lowest_degree = 0;   ///< of such a one; 0: its first
  double tests = 0.0;  ///< what the choice counts as, for an order; 0: the forms × their starts
};

/// A line of unknown frequency, which a periodogram finds. Its phase φ is that of cos(2π f x + φ).
struct SpectralLine {
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
    at_end,    ///< the same, at most an eighth of the probed length: the middle is without it
    sum,       ///< plus range d
    duration,  ///< plus what the measurement lasts times d, within it
    lever  ///< κ plus d, κ the half length over the distance of the middle: what data show of it
  };
  double TermShape::*parameter = nullptr;
  By by = By::factor;
  double range = 1.0, low = 0.0, high = 1e300;
  std::optional<std::size_t> reader = {};  ///< the linear parameter that reads it; none: all
  /// It is where the effect's one linear parameter is linearised, and in the end that parameter's
  /// value: such an effect occurs once.
  bool linearises = false;
};

/// A measurement that tells causes apart.
struct Separator {
  std::string_view code, what;
};

/// How a measurement separates this effect from its confounders.
struct Separation {
  std::string_view code, how;
};

/// Largest shift of the identified axis over Z if the effect is not modelled, per unit of its
/// parameter; R = 40 mm, tan α = 0.1, e = 0.2 mm, tilt 1 mrad, Z 0-60 mm. Depends on the plan.
struct AxisBias {
  double value = 0.0;
  std::string_view unit, text;
};

/// What a check of the data looks for.
enum class DataCheck {
  interruption,
  saturation,
  quantisation,
  incidence_noise,
  correlated_noise,
  stated_noise,
  outliers
};

/// What a separation by several sensors or a reversal takes an effect for, order by order.
enum class SeparatedAs { neither, form, motion };

/// A parameter that the virtual lathe calls by another name, both without their unit.
struct NameInLathe {
  std::string_view name, in_lathe;
};

/// An entry of a catalogue: data that the engine, the report and the command line read. That of the
/// lathe is effect_catalogue(); one whose columns another room makes has no term.
struct Effect {
  std::string_view id = {};
  std::string_view title = {};
  Slot slot = Slot::part;
  EffectFrame frame = EffectFrame::part;
  EffectTerm term = {};           ///< how it is computed; monostate for a check
  std::string_view formula = {};  ///< the term as text
  std::vector<EffectParameter> parameters = {};
  std::string_view signature = {};
  std::string_view consequence = {};  ///< what it means for the user or what to do, in few words
  /// Ids. One of two names the other: a catalogue has it in both (see with_mutual_confounders).
  std::vector<std::string_view> confounders = {};
  std::string_view absorbed_by = {};  ///< parameters of the surface that take it in
  std::vector<Separation> separations = {};
  std::optional<AxisBias> axis_bias = {};
  std::string_view source = {};
  std::optional<DataCheck> check = {};  ///< quality of the data: never a name for a form

  Requirement needs = {};
  std::vector<ShapeValues> typical = {};  ///< shape: the first of the values each
  SearchRange search = {};
  std::optional<SpectralLine> line = {};
  std::optional<Refinement> refinement = {};
  std::string_view second_order_twin = {};  ///< id: one in the first order, told in the second
  int between_passes = 0;  ///< place among those that show from pass to pass, which are fitted ///<
                           ///< when the noise is judged, as many as it can bear; 0: not one
  bool repeats_at_tool = false;  ///< a motion that the tool meets as the probe did
  /// How much wider than their range its sizes spread: above 1 what wears, below what is set by
  /// hand and would be seen.
  double size_spread = 1.0;
  /// The influence by which a user states what is known of its one linear parameter; none: no way.
  std::optional<Influence::Kind> stated_as = {};
  /// What was stated: the readings are corrected by its value, and what remains is normal with u.
  std::optional<Influence> stated = {};
  bool same_in_cut = false;  ///< the cut meets it as the probe did: the axis it cuts is the same
  SeparatedAs separated_as = SeparatedAs::neither;
  std::vector<NameInLathe> names_in_lathe = {};
  std::string_view motion_beside = {};  ///< id; for a tilt about a point, the motion of that point
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

/// The one representation of a term next to the surface, from the search to JSON, lathe, correction
/// and report. It is an effect of the catalogue with its shape, or a pattern. It has its linear
/// amplitudes and their covariance once they are fitted.
struct TermValue {
  const Effect* effect = nullptr;  ///< of a catalogue that outlives this; nullptr: a pattern
  TermShape shape;                 ///< of an effect
  std::vector<std::size_t> free;   ///< which linear parameters are free; empty: all
  Pattern pattern;                 ///< of no effect

  /// Amplitudes in the order of parameters(), 0 where not free; mm, rad, s. Empty: not fitted.
  std::vector<double> linear;
  Covariance covariance;  ///< of `linear`; empty: not fitted

  /// Linear parameters of the effect, or those of cos and sin or of the bump of a pattern.
  std::vector<LinearParameter> parameters() const;
  std::size_t columns() const;  ///< how many are free
  std::string id() const { return effect ? std::string(effect->id) : "unexplained"; }
};

/// Whether the undulations per revolution are a parameter of the shape.
bool has_free_order(const Effect& effect);

/// The parameter that states a linear or shape parameter; nullptr: one of its own name does, or
/// none.
const EffectParameter* parameter_for(const Effect& effect, std::string_view name);

/// The parameter whose typical sizes are those of a linear one; nullptr: none.
const EffectParameter* size_for(const Effect& effect, const LinearParameter& linear);

/// All effects and checks, family by family.
std::span<const Effect> effect_catalogue();

/// The entry of `own` with this id, else that of the catalogue; nullptr: neither has it.
const Effect* find_effect(std::string_view id, std::span<const Effect> own = {});

/// The entry of a check.
const Effect& entry_of(DataCheck check);

/// Entries that name each other, in their order, where one of two named the other.
/// @throws ContractViolation for an id that none of them has.
std::vector<Effect> with_mutual_confounders(std::vector<Effect> entries);

/// The known ids most like a misspelt one, best first.
std::vector<std::string_view> nearest_effects(std::string_view id, std::size_t count = 3);

std::span<const Separator> separators();

std::string_view to_string(Slot slot);
std::string_view to_string(EffectFrame frame);

}  // namespace trueaxis

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "trueaxis/association.hpp"
#include "trueaxis/probe_stream.hpp"
#include "trueaxis/units.hpp"

/// Form parameters of ISO 12181 (roundness), 12180 (cylindricity), 12780 (straightness), 12781
/// (flatness) and run-out, coaxiality, concentricity and parallelism of ISO 1101, with U
/// (form.md; theory.md §29). Inside mm and rad; UPR: undulations per revolution.
namespace trueaxis {

/// Profile filters of ISO 16610: parts 21 (Gaussian), 31 (robust Gaussian regression), 22 (spline).
enum class ProfileFilter { none, gaussian, robust_gaussian, spline };

/// Least squares (LSCI), minimum zone (MZCI), minimum circumscribed (MCCI) and maximum inscribed
/// (MICI) circle of a section; likewise of a cylinder.
inline constexpr std::array<Criterion, 4> form_criteria{
    Criterion::gaussian, Criterion::minimum_zone, Criterion::minimum_circumscribed,
    Criterion::maximum_inscribed};

/// "gaussian" … as in files.
const char* to_string(ProfileFilter filter);
/// Of `criterion_names`.
const char* name_of(Criterion criterion);

/// One order of a spindle's radial error motion along the probe: cos · cos nC + sin · sin nC.
struct SpindleOrder {
  int order = 2;
  double cos_mm = 0.0, sin_mm = 0.0;
  double u_mm = 0.0;  ///< standard uncertainty of either
};

struct FormOptions {
  ProfileFilter filter = ProfileFilter::gaussian;
  double low_upr = 1.0;    ///< of the pass band; 1: a low-pass
  double high_upr = 50.0;  ///< where the filter lets 50 % through
  bool bore = false;
  double ball_radius_mm = 0.0;            ///< 0: the stream's
  std::optional<double> noise_mm;         ///< standard deviation of a reading; else as it shows
  std::vector<SpindleOrder> spindle{};    ///< known motion: subtracted, its u counts
  double spindle_range_mm = 0.0;          ///< range of a motion that is not known by its orders
  Criterion datum = Criterion::gaussian;  ///< of the datum's circle or cylinder
  double coverage_factor = 2.0;
  /// false: about least squares and the minimum zone alone, by Eqs. 265 and 273 about the axis of
  /// least squares (to 1e-9 mm), as quick as a diagnosis wants it.
  bool all_references = true;
  bool each_turn_by_itself = false;  ///< a helix is not estimated as one surface
  int trials = 400;                  ///< of the Monte Carlo: u to 3.5 %; of a surface 100 at least
  std::uint64_t seed = 12181;
  int threads = 0;  ///< 0: as many as there are; the values do not depend on it
};

/// A value as the standards name it.
struct FormValue {
  std::string name;       ///< "RONt", "CYLt", "eccentricity" …
  std::string reference;  ///< "LSCI" …: what it is about; empty: it needs none
  Estimate estimate;      ///< value and u, in mm (slopes: mm per rad)
  double bias_mm = 0.0;   ///< by how much noise makes it larger on average; in u, not subtracted
  /// Nothing beyond the noise: no value, and the interval ends at its 95 % bound.
  bool unresolved = false;
};

/// Ends of the interval value ± k u, or of the bounds in place of a value, which hold with 95 % or
/// more whatever k is (`bound_factor`).
double least_of(const FormValue& value, double k);
double most_of(const FormValue& value, double k);
/// The value, or the upper bound in its place: by it sections are ranked.
double size_of(const FormValue& value);

/// One order of a section's profile before the filter, amplitude · cos(nθ − phase), θ in the part.
struct FormHarmonic {
  int order = 0;
  double amplitude_mm = 0.0, phase_rad = 0.0, u_mm = 0.0;
};

/// A reference circle, in the part frame.
struct FormCircle {
  Criterion criterion = Criterion::gaussian;
  double x_mm = 0.0, y_mm = 0.0, radius_mm = 0.0;
  /// Angles (rad) that it touches, with the multipliers that prove it the least one; Eq. 266.
  std::vector<std::array<double, 2>> touches{};
  std::string why_not{};  ///< why there is none; empty: there is
};

/// The profile of one section, in order of angle.
struct FormProfile {
  std::vector<double> angle_rad, raw_mm, filtered_mm;  ///< about the least-squares circle
};

struct SectionForm {
  std::optional<double> z_mm;  ///< mean; nothing: the stream has no Z
  std::size_t readings = 0;
  double turns = 1.0;
  double points_per_cycle = 0.0;  ///< of the shortest wave that the filter lets through
  double gaps_rad = 0.0;          ///< of interruptions that the filter does not bridge, in all
  double noise_mm = 0.0;          ///< standard deviation of a reading that U rests on
  double transmission = 0.5;      ///< of a wave at the cut-off over these angles, measured
  std::vector<FormCircle> circles;
  std::vector<FormValue> values;  ///< RONt, RONp, RONv, RONq of each circle; slope, eccentricity
  std::vector<FormHarmonic> harmonics;
  int lobes = 0;             ///< the order from 2 on with the largest amplitude
  double lobes_share = 0.0;  ///< its part of the mean square of all orders from 2 on
  FormProfile profile;
};

/// A group of values of the whole: a cylinder, its axis, run-out, a face, a line.
struct FormGroup {
  std::string name;  ///< "cylindricity", "axis", "runout", "datum", "flatness", "straightness"
  std::vector<FormValue> values;
};

/// A surface that was estimated from all readings together; its `sections` are read off it.
struct FormSurface {
  std::size_t readings = 0;
  double turns = 1.0;
  int orders = 0, degrees = 0;  ///< as far as it was estimated: around, and along Z
  double noise_mm = 0.0;        ///< standard deviation of a reading
  std::vector<int> orders_found{};
};

/// Lobes that were found and that the cut-off takes part of.
struct SwallowedLobes {
  int order = 0;
  double amplitude_mm = 0.0, u_mm = 0.0;  ///< largest along Z
  double passed = 1.0;                    ///< share of the amplitude that the filter lets through
};

struct FormResult {
  std::vector<SectionForm> sections;
  std::vector<FormGroup> groups;
  std::optional<FormSurface> surface{};  ///< none: every section was assessed by itself
  /// Not empty: RONt, CYLt and what else rests on them are bounds (Estimate::interval), no values.
  std::vector<SwallowedLobes> swallowed{};
  FormOptions options;
  bool radius_known = true;  ///< false: the circles are limaçons, their radius is that of a gauge
  std::vector<std::string> notes;  ///< what a user should know of the numbers, in sentences
  std::string source, input_hash, datum_source;
};

/// What was subtracted from the readings before: by how much these may be off (theory.md, Eq. 291).
struct TakenOff {
  std::span<const std::vector<double>> columns_mm;  ///< of one u of each amplitude, every reading's
  std::span<const double> correlation;              ///< of the amplitudes, row-major
  bool of_datum = false;                            ///< off the datum's readings, else the part's
};

/// Form of what a lateral stream (X_M, C, Z: sections, or a helix, which is one surface) or a face
/// stream (Z_M, C, X) shows. Values against a datum are about the axis of `datum`, a stream of the
/// same clamping; without one about the spindle axis. u holds what `taken_off` is uncertain by.
/// @throws InputError with what the readings cannot carry: fewer than 7 a wave at the cut-off, less
///         than half a turn, several set-ups, angles that look like another unit.
FormResult assess_form(const ProbeStream& stream, const FormOptions& options = {},
                       const ProbeStream* datum = nullptr,
                       std::span<const TakenOff> taken_off = {});

/// The highest cut-off (UPR) that every section of a lateral stream carries by 7 readings per wave
/// (ISO 12181-2), 500 at most. For a surface it is what the angles of all readings carry, 50 at
/// most. Below 2 no filter is possible. @throws InputError as assess_form
int carried_upr(const ProbeStream& stream, const FormOptions& options = {});

/// The same of points x y z (mm) of a line, circle, plane or cylinder, in any orientation. Sections
/// of a circle and of a cylinder are filtered, planes and lines are not.
/// @throws InputError for another element, or points that do not make one
FormResult assess_form(std::span<const Point3> points_mm, Element element,
                       const FormOptions& options = {});

}  // namespace trueaxis

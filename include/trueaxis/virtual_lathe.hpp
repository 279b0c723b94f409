// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "trueaxis/probe_stream.hpp"

namespace trueaxis::virtual_lathe {

enum class CutKind { cylinder, cone, face };

/// Which column of the table the actuator is given.
enum class CutUse { command, wanted, none };

/// What the control is programmed to cut, about the spindle axis.
struct CutTarget {
  CutKind kind = CutKind::cylinder;
  bool bore = false;
  double start_mm = 0.0,
         end_mm = 0.0;          ///< Z (face: X) of the contact, in the order of the feed
  double radius_mm = 0.0;       ///< at start (cylinder, cone)
  double half_angle_rad = 0.0;  ///< cone: signed, > 0 where the radius grows with Z
  double z_face_mm = 0.0;
};

struct CutTool {
  double nose_radius_mm = 0.0;
  double height_mm = 0.0;             ///< Y of the edge in the tool's frame
  double angle_from_probe_rad = 0.0;  ///< the tool's frame is the probe's turned by it
  double speed_rpm = 600.0;           ///< > 0
  int sense = 1;                      ///< of C while cutting
  double feed_mm_per_rev = 0.1;       ///< > 0
  double c_start_rad = 0.0;           ///< spindle angle at start
};

struct CutActuator {
  bool perfect = false;  ///< follows the table without error
  double natural_frequency_hz = 600.0;
  double damping = 0.7;
  double delay_s = 0.0;
  double sampling_hz = 20000.0;  ///< zero-order hold
};

/// A cut with a correction table.
struct CutProgram {
  CutTarget target;
  CutTool tool;
  CutActuator actuator;
  CutUse use = CutUse::command;
  std::string table;    ///< file name of the table; not needed for CutUse::none
  bool runs_on = true;  ///< the tool runs in before the programmed path and out after it
};

}  // namespace trueaxis::virtual_lathe

/// The virtual lathe: a part that is probed numerically. It shares no formula with the model that
/// is fitted, so that agreement of the two means something. Inside: mm, rad, s; X is a radius.
namespace trueaxis::virtual_lathe {

enum class PartKind { cone, cylinder, face };

/// A rigid body. Its own frame has its axis as third axis and its origin at (x0, y0, 0) of the
/// spindle frame; s is the distance along the axis from there.
struct Part {
  PartKind kind = PartKind::cylinder;
  bool bore = false;                ///< probed from inside
  double x0_mm = 0.0, y0_mm = 0.0;  ///< where the axis pierces z = 0
  double l = 0.0, m = 0.0;          ///< direction cosines of the axis (face: of the normal)
  std::optional<double> apex_mm;    ///< cone: s of the apex; the half angle is then in (0, 90°)
  double half_angle_rad = 0.0;  ///< cone; without apex_mm signed, > 0 where the radius grows with s
  double radius_mm = 0.0;       ///< at s = radius_at_mm, when there is no apex_mm
  double radius_at_mm = 0.0;
  double d_mm = 0.0;  ///< face: n·p = d
};

/// The probe: it reads along X at Y = 0 (a face: along Z) and touches from outside the material.
struct Probe {
  double ball_radius_mm = 0.0;  ///< > 0: the reading is the position of the ball's centre
  std::optional<double> relative_zero_mm;   ///< a gauge: this unknown constant is subtracted
  std::optional<double> nominal_radius_mm;  ///< what the operator states with a relative reading
  bool states_noise = true;                 ///< the stream says its sensor_noise
  /// Several sensors that read at once, each outwards along its own line through the spindle axis:
  /// their angles from +X towards +Y (columns X_M1, X_M2 …). Empty: one, at +X.
  std::vector<double> sensor_angles_rad{};
};

/// What was done before the passes of a set-up. Without x0 … m of its own the part's axis stays.
struct Chucking {
  int number = 1;
  double reindex_rad = 0.0;  ///< the part turned about its own axis in the sense of C, as the
                             ///< spindle turns it: a mark at C = 10° is then at 10° − this
  double z_shift_mm = 0.0;   ///< the part moved along Z
  bool rear = false;         ///< probed from the rear side: the smaller X
  double x_jog_mm = 0.0;     ///< slide moved in X, sensor and machine still adding up to X
  double clamp_force_ratio = 1.0;  ///< scales what the jaws do
  std::optional<double> x0_mm, y0_mm, l, m;
};

/// One run of the probe: helical (start → end), dwell (start = end) or stationary (speed 0).
struct PlannedPass {
  double start_mm = 0.0, end_mm = 0.0;  ///< Z, or X for a face
  double feed_mm_per_rev = 0.2;         ///< > 0; the direction follows from start and end
  double speed_rpm = 60.0;              ///< signed like C; 0: stationary
  double readings_per_revolution = 10.0;
  double revolutions = 0.0;                ///< dwell
  double duration_s = 0.0, rate_hz = 0.0;  ///< stationary
  double jitter = 0.0;   ///< the instants are uniform within ± jitter/2 sampling intervals
  double pause_s = 1.0;  ///< before the pass; the spindle already turns at its speed
  std::optional<double> c_start_rad;  ///< else C runs on from the pass before
  int setup = 1;
};

struct Plan {
  std::vector<PlannedPass> passes;
  std::vector<Chucking> setups;  ///< those that are not all default
};

/// What is added to the reading after the sensor's response. Each part has its own random sequence:
/// outliers switched on leave the Gaussian noise as it was.
struct Noise {
  double sigma_mm = 0.0;
  double uniform_mm = 0.0;  ///< half width of a uniform part
  double rho = 0.0;         ///< AR(1) of the sigma part, its standard deviation staying sigma
  /// φ of ε_i = Σ φ_j ε_{i−j} + e_i of the sigma part, any order, instead of rho.
  std::vector<double> autoregression;
  double student_dof = 0.0;  ///< > 2: heavy tails of the sigma part, same standard deviation
  double incidence = 0.0;    ///< b of sigma² (1 + b tan² i), i: angle of normal and probe
  double outlier_fraction = 0.0;
  double outlier_size_mm = 0.0;     ///< each is 0.5 to 1.5 of it
  bool outliers_one_sided = false;  ///< chips: away from the material only
  double quantisation_mm = 0.0;
};

/// One effect of the catalogue by its id; parameters carry their unit in their name.
struct Effect {
  std::string id;
  std::map<std::string, double> parameters;
};

struct Scenario {
  std::string name;
  Part part;
  Probe probe;
  Plan plan;
  Noise noise;
  std::vector<Effect> effects;
  /// Where u = −1 and +1 of effects that grow along the surface; default: the plan's extremes.
  std::optional<double> u_start_mm, u_end_mm;
  std::optional<CutProgram> cut;  ///< then the plan probes the part that was cut
  std::uint64_t seed = 1;
};

/// A parameter of an effect. The unit inside is the suffix of its name; none: a pure number.
struct LatheParameter {
  std::string_view name;
  std::optional<double> fallback;  ///< absent: the scenario must give it
};

/// An effect that the virtual lathe can have.
struct EffectKind {
  std::string_view id;
  std::string_view what;  ///< its term, in one line
  std::span<const LatheParameter> parameters;
};

/// All of them, in the order of the measuring chain.
std::span<const EffectKind> effect_kinds();

/// @throws InputError listing the known ids, or the known parameters of the id.
const EffectKind& find_effect_kind(std::string_view id);

/// @throws InputError for an unknown id, an unknown or missing parameter.
void validate(const Effect& effect);

/// The parameter's value or its fallback. Expects a valid effect.
double parameter(const Effect& effect, std::string_view name);

/// What the stream does not say.
struct Truth {
  Scenario scenario;
  std::vector<double> clean_mm;           ///< readings without noise, before clipping and rounding
  std::vector<std::size_t> outlier_rows;  ///< 0-based
  std::vector<std::size_t> clipped_rows;  ///< probe.saturation
};

struct Simulation {
  ProbeStream stream;
  Truth truth;
};

/// Probes the part of a scenario: C, Z (X), t, pass and setup columns; C running. Same scenario,
/// same bits.
/// With several sensors each has noise of its own.
/// @throws InputError when the scenario contradicts itself, or the probe misses the part.
ProbeStream simulate(const Scenario& scenario);
Simulation simulate_with_truth(const Scenario& scenario);

/// Probes the part of a scenario at the arguments (C, Z, t, set-up) of a recorded stream instead of
/// a plan's: that stream with other readings, its `clean_mm` without noise. Speeds and feeds are
/// those of its passes; a stream without t and speed has neither. The scenario's plan only says how
/// the part is clamped in each set-up; u needs the scenario's u_start_mm and u_end_mm. @throws
/// InputError as simulate(), and for several sensors.
Simulation simulate_at(const Scenario& scenario, const ProbeStream& recorded);

/// A correction table as the control runs it; for a face `position_mm` is X and the offsets are in
/// Z.
struct CutTable {
  bool face = false;
  std::vector<int> revolution;
  std::vector<double> position_mm;
  std::vector<double> c_rad;  ///< running, in the sense of rotation of the cut
  std::vector<double> wanted_mm, command_mm;
};

/// The part as the tool leaves it, fixed in the spindle frame.
///
/// The control feeds the nose centre along the section of the target at the tool's height, offset
/// by the nose radius. It runs from where the nose touches the target's start to where it touches
/// its end; the actuator adds its displacement. The table is interpolated linearly in C at the
/// actuator's sampling instants and held; the second-order equation is solved exactly from hold to
/// hold. The surface is the envelope of the circular nose edge over the revolutions (with nose
/// radius 0 straight between two of them), so feed marks are there. Before the first row and after
/// the last the tool runs on along the path (CutProgram::runs_on): the table is continued linearly,
/// angle by angle.
class CutPart {
 public:
  /// @throws InputError when table and program contradict each other.
  CutPart(const CutProgram& program, const CutTable& table);
  ~CutPart();
  CutPart(CutPart&&) noexcept;
  CutPart& operator=(CutPart&&) noexcept;

  /// Radius left at polar angle theta of the spindle frame and height z; for a face the height left
  /// at (theta, distance from the axis). NaN where the tool never was.
  double surface_mm(double theta_rad, double position_mm) const;

  /// Displacement of the actuator when the spindle was at running angle c of the cut, mm.
  double displacement_mm(double c_rad) const;

  const CutProgram& program() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Probes a cut part in the same chucking, with the lathe's own numeric contact.
/// @throws InputError where the plan leaves the cut length.
ProbeStream probe_cut(const CutPart& part, const Plan& plan, const Noise& noise,
                      std::uint64_t seed);

}  // namespace trueaxis::virtual_lathe

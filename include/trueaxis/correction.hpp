// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <complex>
#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "trueaxis/effect.hpp"
#include "trueaxis/reason.hpp"
#include "trueaxis/surface.hpp"

namespace trueaxis {

/// One point of a measured frequency response.
struct ResponsePoint {
  double frequency_hz = 0.0;
  double gain = 1.0;
  double phase_rad = 0.0;
};

/// A fast tool servo. Defaults: the 600 µm, 600 Hz piezo of Constantin et al. (section 3.3).
struct Actuator {
  double stroke_mm = 0.6;  ///< full travel; the correction uses it about its middle
  double natural_frequency_hz = 600.0;
  double damping = 0.7;               ///< ζ: −3 dB then falls on the natural frequency
  double delay_s = 0.0;               ///< pure transport delay of drive and bus
  double slew_mm_per_s = 200.0;       ///< amplifier current: full stroke as a sine at about 100 Hz
  double sampling_hz = 20000.0;       ///< set-points a second, held between (zero-order hold)
  double stroke_reserve = 0.1;        ///< share of the stroke kept free for what was not modelled
  double following_limit_mm = 0.001;  ///< predicted following error that is still accepted
  bool precompensate = true;          ///< invert the response per harmonic
  std::vector<ResponsePoint>
      measured;  ///< from the held set-point to the position, replaces the second-order model
                 ///< when there (ascending frequency); delay_s and the hold are multiplied with it

  /// Whether the measured phases, one after the other, go ahead of the set-point: no servo does.
  bool leads() const;
  /// Position over set-point at a frequency ≥ 0 (e^{+iωt} convention): second order or measured
  /// response, delay, and the hold of the sampling: H = ω_n²/(ω_n² − ω² + 2iζω_nω) e^{−iωτ} sinc
  /// e^{−iωT/2} (Eq. 112).
  std::complex<double> response(double frequency_hz) const;

  /// What is not known of a measured response between its points, as a share of it: by how much
  /// straight lines between them differ from the cubics that `response` takes. 0 without points.
  double between_points(double frequency_hz) const;

  /// Lowest frequency at which |response| falls to −3 dB, Hz (Eq. 117).
  double bandwidth_hz() const;

  void validate() const;  ///< @throws ContractViolation naming quantity, value and limit
};

/// One reference surface as the target axis sees it.
struct Reference {
  std::string name;
  AxisEstimate axis;
  double weight = 1.0;
  double face_radius_mm = 0.0;  ///< > 0: a plane; only its tilt counts, × this radius
  /// Degrees of freedom that the σ of its covariance was estimated with; infinite: σ is known.
  double freedom = std::numeric_limits<double>::infinity();
};

/// The residual at one reference if the part is cut about the target axis.
struct Remainder {
  std::string name;
  double offset_start_mm = 0.0,
         offset_end_mm = 0.0;  ///< distance of the axes at both ends of the cut
  double tilt_rad = 0.0;
  double coaxiality_mm = 0.0;  ///< ISO 1101: a diameter; for a plane the axial run-out 2 R tilt
  /// Of the part cut about the target axis: the target is a number by then, so it is the reference
  /// that is known no better than this (twice its u at the worse end, in the worse direction).
  double u_coaxiality_mm = 0.0;
  double limit_mm = 0.0;  ///< that the coaxiality exceeds in 5 of 100 (Eq. 119), by run_job
};

struct TargetAxis {
  AxisEstimate axis;
  std::vector<Remainder> remainders;
};

/// The axis that minimises Σ w_i ∫ |Δ_i(Z)|² dZ over [z_start, z_end] (key idea 4 of Constantin et
/// al.), Δ_i the vector from reference axis i; a plane enters as tilt × face radius. Closed form.
/// Eqs. 106, 107, 119.
/// @throws Refusal if the references leave it open (planes alone fix no position).
/// A face asks for a direction only: with `needs_position` false, planes alone are enough and the
/// axis then passes the spindle axis at mid length.
TargetAxis solve_target_axis(std::span<const Reference> references, double z_start_mm,
                             double z_end_mm, bool needs_position = true);

/// The residual at each reference if the part is cut about any axis `target` instead.
std::vector<Remainder> remainders_of(std::span<const Reference> references, const Axis& target,
                                     double z_start_mm, double z_end_mm);

/// ISO 1101 coaxiality of `toleranced` over [z_start, z_end] with `datum` as the datum axis: a
/// diameter, mm (Eq. 118).
double coaxiality_mm(const Axis& toleranced, const Axis& datum, double z_start_mm, double z_end_mm);

enum class TargetKind { cylinder, cone, face };

/// The surface to be cut, coaxial with the target axis.
struct TargetSurface {
  TargetKind kind = TargetKind::cylinder;
  bool bore = false;
  double z_start_mm = 0.0,
         z_end_mm = 0.0;   ///< where the tool's contact starts and ends, in the order of the feed
  double radius_mm = 0.0;  ///< at z_start (cylinder, cone)
  double tan_half_angle = 0.0;  ///< cone: signed, positive where the radius grows with Z
  double z_face_mm = 0.0;       ///< face: where the target axis meets it
  double radius_start_mm = 0.0, radius_end_mm = 0.0;  ///< face: X where the cut starts and ends
  /// How far the path starts before and ends past the target, along the feed, >= 0.
  double run_in_mm = 0.0, overrun_mm = 0.0;
  /// Z (a face: X) that no point of the nose may pass; it lies outside of the target.
  std::optional<double> shoulder_mm{};

  double start_mm() const { return kind == TargetKind::face ? radius_start_mm : z_start_mm; }
  double end_mm() const { return kind == TargetKind::face ? radius_end_mm : z_end_mm; }
  /// Along Z (a face: X), in the order of the feed, with run-in and overrun.
  double path_start_mm() const {
    return start_mm() - std::copysign(run_in_mm, end_mm() - start_mm());
  }
  double path_end_mm() const { return end_mm() + std::copysign(overrun_mm, end_mm() - start_mm()); }
};

/// What the control makes of a table between two of its rows.
enum class Interpolation {
  not_stated,
  linear,  ///< straight lines
  none,    ///< a row is held until the next
};

/// "not_stated", "linear", "none"
const char* to_string(Interpolation interpolation);

/// Tool and cutting motion.
struct ToolSetup {
  double nose_radius_mm = 0.0;
  double height_mm = 0.0;  ///< Y of the cutting edge in the tool's own frame: positive to the side
                           ///< from which the surface comes when C grows
  double angle_from_probe_rad =
      0.0;  ///< about the spindle from the probe to the tool; a turret at the rear: π
  double speed_rpm = 600.0;       ///< > 0
  int sense = 1;                  ///< sense of C while cutting: +1 or −1
  double feed_mm_per_rev = 0.1;   ///< > 0; the direction follows from the target's start and end
  double c_start_rad = 0.0;       ///< spindle angle at the first row
  int rows_per_revolution = 360;  ///< linear interpolation then errs by 4e-5 of a 1-UPR amplitude
  Interpolation interpolation = Interpolation::not_stated;  ///< of the rows, by the control
};

/// The rows of a correction table, in the order in which they are run. For a face the actuator
/// works along Z and `position_mm` is the machine X; else it works along X and `position_mm` is Z.
/// Positions are those of the centre of the tool's nose, so that the contact runs over the target.
/// No row lies beyond the end of the path: the last whole revolution, and the rest of the one
/// before it, are cut at the end, where the feed is 0.
struct CorrectionRows {
  std::vector<int> revolution;
  std::vector<double> position_mm;
  std::vector<double> c_rad;       ///< running, in the sense of rotation when cutting
  std::vector<double> wanted_mm;   ///< X_fts = X − X programmed, positive away from the spindle
                                   ///< axis; a face: Z_fts = Z − Z programmed, positive along +Z
  std::vector<double> command_mm;  ///< precompensated for the actuator
};

/// One harmonic of the correction, cos convention A cos(nC − φ), at both ends of the cut. Orders 0
/// to 8 above 1 nm; order 0 is the signed mean.
struct CorrectionHarmonic {
  int order = 0;
  double amplitude_start_mm = 0.0, phase_start_rad = 0.0;
  double amplitude_end_mm = 0.0, phase_end_rad = 0.0;
  double gain = 1.0, lag_rad = 0.0;  ///< actuator at this order and speed
};

/// What the actuator has to do and has left.
struct ActuatorMargin {
  double stroke_used_mm = 0.0, stroke_available_mm = 0.0;  ///< peak to peak; after the reserve
  double slew_used_mm_per_s = 0.0, slew_available_mm_per_s = 0.0;
  double highest_frequency_hz = 0.0, bandwidth_hz = 0.0;  ///< highest harmonic above 10 nm
  double set_points_per_revolution = 0.0;
  double following_uncompensated_mm = 0.0;  ///< peak, if the wanted profile were sent as it is
  double following_mm = 0.0;                ///< peak, with what X_command holds; steady run
  double following_once_mm = 0.0;  ///< of it what turns once per revolution with the part, at the
                                   ///< worst place: the axis of the cut moves by it (Eq. 116a)
  double following_limit_mm = 0.0;
  bool follows = false;
  Reasons breaks;              ///< the limits that break, none when it follows
  double max_speed_rpm = 0.0;  ///< highest speed at which it would run, where it runs at most that
                               ///< of a third of the bandwidth or its own; 0: at none
  Reasons remedies;            ///< what would make it follow, none when it follows
  double following_unknown_mm = 0.0;  ///< part of `following_mm`: between points of the response
};

/// An error motion of the machine that the probe saw along X and that repeats while cutting. The
/// part (or the slide) is off by m(C, Z) towards the probe; a tool on the same side follows it by
/// +m, or it would leave −m in the part; one on the other side by −m. In between it is unknown: the
/// probe saw one direction only.
struct RepeatingMotion {
  TermValue term;                          ///< of an effect of the catalogue, fitted
  double z_mid_mm = 0.0, z_half_mm = 1.0;  ///< u = (z − z_mid)/z_half
};

/// A motion of the spindle along X at the tool, cos · cos nC + sin · sin nC, that no probe sees
/// where the tool cuts: it comes out of the form of finished parts, measured elsewhere.
struct LearnedMotion {
  int order = 0;
  double cos_mm = 0.0, sin_mm = 0.0;
  double u_mm = 0.0;  ///< standard uncertainty of either
};

/// What becomes of an eccentricity once per revolution from the readings of the references to the
/// cut: the axis of the cut is e^{gain + i lag} times the one that the table was made for, x + i y.
/// It stays with the machine: probe, filter, servo and the zero of C.
struct LoopResponse {
  double gain = 0.0;     ///< logarithm: 0.01 cuts 1 % too far off the spindle axis
  double lag_rad = 0.0;  ///< positive: the axis comes out turned in the sense of the part's angle
  double u_gain = 0.0, u_lag_rad = 0.0;  ///< standard uncertainties
  double u_cut_mm = 0.0;                 ///< by which the axis of a cut scatters, in x and in y
  std::vector<LearnedMotion> motion{};   ///< that the tool follows
};

/// How far what a control makes of a table is from the wanted correction, over the cut.
struct Deviation {
  double largest_mm = 0.0;  ///< anywhere
  double once_mm = 0.0;     ///< amplitude of what turns once per revolution: the axis moves by it
};

struct Correction {
  TargetSurface target;
  ToolSetup tool;
  Actuator actuator;
  AxisEstimate axis;                     ///< the target axis
  std::vector<RepeatingMotion> motions;  ///< of the machine, followed as well
  LoopResponse loop{};                   ///< of the machine, for which the table is corrected
  /// The axis that the table is made for, so that the target axis comes out.
  Axis commanded_axis() const;
  /// Where the programmed path of the nose's centre starts and ends, Z (a face: X): the contact
  /// then runs from the target's start to its end, with run-in and overrun. All rows lie between.
  double position_start_mm = 0.0, position_end_mm = 0.0;
  CorrectionRows rows;
  std::vector<CorrectionHarmonic> harmonics;
  ActuatorMargin margin;
  /// Of a drive that joins the rows' wanted values by straight lines and follows without error.
  Deviation between_rows;
  Deviation held_rows;  ///< of one that holds each row until the next
};

/// The correction profile, its precompensation and its margin. An actuator that cannot follow is
/// reported in `margin`, not thrown: the caller refuses.
/// @throws Refusal where the tool does not meet the target surface (past its apex, height beyond
/// its
///         radius); ContractViolation for quantities that cannot be.
Correction make_correction(const AxisEstimate& axis, const TargetSurface& target,
                           const ToolSetup& tool, const Actuator& actuator,
                           std::vector<RepeatingMotion> motions = {},
                           const LoopResponse& loop = {});

/// The fewest rows per revolution that keep the deviation between them at most `limit`; 0: not even
/// 100000 do.
/// @param by linear or none
int rows_that_would_do(const Correction& correction, Interpolation by, const Deviation& limit);

}  // namespace trueaxis

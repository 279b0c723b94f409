// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "trueaxis/probe_stream.hpp"
#include "trueaxis/units.hpp"

/// Form of the part and error motion of the spindle (theory.md §22). Several sensors at known
/// angles, reversal (Donaldson 1972), re-indexed set-ups, or all of these in one estimate separate
/// them. Inside mm and rad; an order is a number of undulations per revolution.
namespace trueaxis {

/// Of a sensor's angle or a re-indexing if nobody states it: a mark that is read to a degree, ±1°
/// at most.
inline constexpr double default_u_angle_rad = 0.5 * rad_per_deg;

struct SpindleOptions {
  int order_max = 100;  ///< orders 2 … order_max are separated, as far as the readings carry them
  /// The direction in which the tool feels the motion, from +X towards +Y. Unless stated: X, or the
  /// line of the sensors if they are all on one.
  std::optional<double> sensitive_rad;
  double u_angle_rad = default_u_angle_rad;    ///< standard uncertainty of each sensor's angle
  double u_reindex_rad = default_u_angle_rad;  ///< of the angle of each re-indexing
  double largest_condition = 100.;  ///< an order with a larger condition number is suppressed
  double coverage_factor = 2.0;     ///< k of U = k u
};

/// cos · cos(n α) + sin · sin(n α), α the spindle angle C (a motion) or the angle in the part (a
/// form). NaN where it is not determined.
struct SpindleHarmonic {
  double cos_mm, sin_mm;
  double u_mm;  ///< standard uncertainty of either, and of the amplitude
  double amplitude_mm() const;
  double phase_rad() const;  ///< φ of amplitude · cos(n α − φ)
  bool determined() const;
};

/// One order of the separation.
struct SeparatedOrder {
  int order = 0;
  double condition = 1.0;     ///< of the separation matrix (Eq. 145); infinite: singular
  std::string suppressed;     ///< why it is not determined; empty: it is
  SpindleHarmonic form;       ///< of the part, in the part frame of the first set-up
  SpindleHarmonic sensitive;  ///< motion along the sensitive direction (axial: along Z)
  SpindleHarmonic across;     ///< motion 90° from it; NaN where the sensors do not see it
};

/// Values of ISO 230-7 of the error motion in one direction, as ranges in mm with u; one that is
/// not beyond the noise is an interval that ends at its 95 % bound. The suppressed orders are in
/// none but the asynchronous one.
struct MotionValues {
  Estimate synchronous;   ///< largest − smallest of the orders from 2 (axial: from 1)
  Estimate asynchronous;  ///< the widest band at one angle; the sensors' noise is in it
  Estimate total;         ///< largest − smallest of both together
};

/// What one set-up of one stream showed.
struct SpindleRun {
  std::string stream;
  int setup = 1;
  std::size_t sensors = 1, readings = 0, left_out = 0;  ///< excluded: far from all others
  double turns = 0.0, readings_per_turn = 0.0;
  double asynchronous_rms_mm = 0.0;     ///< of what does not repeat with C, mean over the sensors
  Estimate eccentricity;                ///< of the part, mm; with the fundamental motion in it
  double eccentricity_angle_rad = 0.0;  ///< its direction in the part frame of this set-up
};

/// Curves of a polar plot over one turn, as many points each; and readings for the cloud.
struct PolarCurves {
  std::vector<double> angle_rad, motion_mm, u_motion_mm;  ///< along the sensitive direction
  std::vector<double> form_mm, u_form_mm;                 ///< empty where no form is separated
  std::vector<double> total_angle_rad, total_mm;          ///< motion with its asynchronous part
};

/// Radial or axial motion, and the form that was separated from it.
struct ErrorMotion {
  double sensitive_rad = 0.0;  ///< radial: the direction of `sensitive`
  bool across_seen = false;    ///< whether the sensors see more than one direction
  std::vector<SeparatedOrder> orders;
  MotionValues sensitive, across;
  Estimate form;  ///< roundness of the part about its least-squares circle (axial: of its face)
  bool form_seen() const { return form.determined() || form.interval; }
  Estimate fundamental, residual;  ///< axial: once per revolution, and the other whole orders
  std::vector<SpindleRun> runs;
  double disagreement =
      1.0;  ///< χ²/ν of sensors and set-ups against each other; NaN: none to spare
  PolarCurves polar;
};

struct SpindleResult {
  std::optional<ErrorMotion> radial;  ///< of streams X_M …
  std::optional<ErrorMotion> axial;   ///< of streams Z_M
  double coverage_factor = 2.0;
  std::vector<std::string> notes;  ///< what a user should know of the numbers
  std::vector<std::string> sources, input_hashes;
};

/// Separates part and spindle in the streams of one section, spindle and speed: lateral ones
/// (several sensors, set-ups, reversal) give the radial motion, faces the axial one. What the
/// layout cannot tell apart is suppressed and says why.
/// @throws InputError with everything that does not go together: several Z, several speeds, fewer
///         than 4 turns, a layout that separates nothing.
SpindleResult separate_spindle(std::span<const ProbeStream> streams,
                               const SpindleOptions& options = {});

/// The condition number of each order from `order_min` on, of sensors at these angles in one
/// set-up; infinite where it is singular.
std::vector<double> separation_conditions(std::span<const double> angles_rad, int order_min,
                                          int order_max);

struct ProposeOptions {
  int sensors = 3;  ///< 3 … 8
  int order_min = 2, order_max = 100;
  double least_apart_rad = 0.3490658503988659;  ///< 20°
};

/// Angles of sensors, the first at 0, that make the worst condition number over the orders least;
/// to 0.1°. A deterministic search: exhaustive on a grid of 1° for three sensors, then refined.
/// @throws InputError where so many sensors do not fit that far apart.
std::vector<double> propose_sensor_angles(const ProposeOptions& options);

}  // namespace trueaxis

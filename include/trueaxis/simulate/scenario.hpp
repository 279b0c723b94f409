// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "trueaxis/simulate/cut_program.hpp"

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
  std::optional<double> relative_zero_mm;   ///< a gauge: this unknown constant is taken off
  std::optional<double> nominal_radius_mm;  ///< what the operator states beside a relative reading
  bool states_noise = true;                 ///< the stream says its sensor_noise
};

/// What was done before the passes of a set-up. Without x0 … m of its own the part's axis stays.
struct Chucking {
  int number = 1;
  double reindex_rad = 0.0;        ///< the part turned about its own axis, in the sense of C
  double z_shift_mm = 0.0;         ///< the part moved along Z
  bool rear = false;               ///< probed from the rear side: the smaller X
  double x_jog_mm = 0.0;           ///< slide moved in X, sensor and machine still adding up to X
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

}  // namespace trueaxis::virtual_lathe

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <limits>
#include <string_view>
#include <vector>

#include "simulate/geometry.hpp"
#include "trueaxis/virtual_lathe.hpp"

namespace trueaxis::virtual_lathe {

/// The instant of a reading: what the machine records.
struct Moment {
  double t_s = 0.0, c_rad = 0.0, position_mm = 0.0;
  double omega_rad_per_s = 0.0;    ///< signed
  double velocity_mm_per_s = 0.0;  ///< of the position, signed
};

/// Where spindle, slide and part really are then.
struct TrueState {
  Moment at;
  bool face = false;
  double u = 0.0;            ///< recorded position on [−1, 1]
  double u_part = 0.0;       ///< the same, less by how far the part was moved along Z
  double c_rad = 0.0;        ///< true spindle angle
  double position_mm = 0.0;  ///< true position of the probe line: Z, or X for a face
  double across_mm = 0.0;    ///< error of slide and frame in the direction that is read
  double part_x_mm = 0.0;    ///< displacement of the part along machine X …
  double part_y_mm = 0.0;    ///< … along machine Y …
  double part_z_mm = 0.0;    ///< … and along machine Z
};

/// A point of the part's surface.
struct SurfacePoint {
  double theta_rad = 0.0;        ///< about the part's axis, fixed to the part
  double chuck_theta_rad = 0.0;  ///< the same against the chuck
  double s_mm = 0.0;             ///< along the axis; face: distance from the axis
  double u = 0.0;                ///< s on [−1, 1]
  double u_half_mm = 0.0;        ///< along s, what u is 1 at
  double clamp = 1.0;            ///< clamping force against the first set-up
  double outward = 1.0;          ///< direction out of the material: +1, in a bore −1
};

/// Rigid step of the part against the spindle.
struct PartStep {
  double dx_mm = 0.0, dy_mm = 0.0, turn_rad = 0.0;
  double dz_mm = 0.0, tilt_x_rad = 0.0, tilt_y_rad = 0.0;  ///< of its axis towards x, y
};

/// The share of a slip that is done at a time, less all of it where the part is described as it is
/// after the slip.
inline double slipped(double t_s, double from_s, double duration_s, double ends) {
  const double done = t_s < from_s                ? 0.0
                      : t_s < from_s + duration_s ? (t_s - from_s) / duration_s
                                                  : 1.0;
  return ends > 0.5 ? done - 1.0 : done;
}

struct ProbeLine {
  double height_mm = 0.0;  ///< Y
  double tilt_rad = 0.0;   ///< in X-Z, from X towards Z
  double extra_ball_mm = 0.0;
};

/// What a sensor's term is of.
struct Sensed {
  const TrueState& state;
  double facing = 1.0;  ///< of the gauge: −1 on the rear side, where it is turned round
  Vec3 normal{};        ///< out of the material, machine frame; only if Chain::needs_normal
  double x_mm = 0.0;    ///< indication before the term
};

/// The measuring chain of a scenario: one list of terms a slot.
struct Chain {
  ProbeLine line;                                                // B
  std::vector<std::function<void(TrueState&)>> machine;          // A and D
  std::vector<std::function<double(const SurfacePoint&)>> form;  // C, along the normal
  std::vector<std::function<Vec3(double s_mm)>> bend;            // C, axis, part frame
  std::vector<std::function<PartStep(double t_s)>> step;         // C, part in the chuck
  std::vector<std::function<double(const Sensed&)>> response;    // E
  bool local_form = false;  ///< form with edges: contacts are searched step by step from outside
  double waves_mm = 0.0;    ///< amplitudes of all waves along the surface, and the shortest of them
  double shortest_mm = std::numeric_limits<double>::infinity();
  bool needs_normal = false;
  double lag_s = 0.0;
  double play_mm = 0.0;
  double low_mm = -std::numeric_limits<double>::infinity();
  double high_mm = std::numeric_limits<double>::infinity();
  double quantisation_mm = 0.0;
};

/// The chain of the effects, in the order of the catalogue whatever their order in the scenario.
/// @throws InputError.
Chain make_chain(const std::vector<Effect>& effects);

}  // namespace trueaxis::virtual_lathe

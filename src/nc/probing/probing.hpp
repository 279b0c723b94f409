// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

/// Programs that measure a plan: the motion, what it must keep to, and how each control writes it.
namespace trueaxis::nc {

enum class ProbedSurface {
  shaft,  ///< touched inwards along X
  bore,   ///< touched outwards along X, by a stylus along Z
  face,   ///< touched along Z
};

/// One run of the probe along Z (along X on a face), C in proportion.
struct ProbingPass {
  double start_mm = 0.0, end_mm = 0.0;
  double turns = 0.0;    ///< signed like C; 0: at standstill
  double seconds = 0.0;  ///< that a probe takes that reads while the spindle turns
  std::size_t readings = 0;
  double c_rad = 0.0;  ///< where C starts
  bool rear = false;   ///< probed at the smaller X
  double rpm() const { return seconds > 0.0 ? 60.0 * turns / seconds : 0.0; }
};

/// The passes on a surface that is known roughly.
struct ProbingPlan {
  std::string what;  ///< in a few words, for the head of the program
  std::string log;   ///< of several plans in a program: what its log's name ends with
  ProbedSurface surface = ProbedSurface::shaft;
  double size_mm = 0.0;  ///< radius at Z = 0; of a face its Z
  double slope = 0.0;    ///< of the radius over Z
  std::vector<ProbingPass> passes;
  double size_at(double along_mm) const { return size_mm + slope * along_mm; }
};

enum class ProbeKind {
  touch,     ///< a trigger: points at indexed C
  analogue,  ///< a gauge that is read while the spindle turns
};

/// What the machine and its operator state. X is a radius, from the spindle axis.
struct ProbingLimits {
  double x_low_mm = 0.0, x_high_mm = 0.0, z_low_mm = 0.0, z_high_mm = 0.0;
  double speed_rpm = 0.0;  ///< highest of C
  double reach_mm = 0.0;   ///< no part, jaw or chuck is farther from the axis than this
  double front_mm = 0.0;   ///< and none beyond this Z
  std::optional<double> bore_radius_mm;  ///< a bore is free to this distance from the axis
  std::optional<double> bore_bottom_mm;  ///< and down to this Z
  std::optional<double> bore_mouth_mm;   ///< radius that is free in front of what is probed
  double clearance_mm = 0.0;             ///< that rapid moves keep
  ProbeKind kind = ProbeKind::touch;
  double ball_radius_mm = 0.0;
  std::optional<double> stylus_radius_mm;  ///< of the shank
  std::optional<double> stylus_length_mm;  ///< from the ball's centre to the body of the probe
  double feed_mm_per_s = 0.0;              ///< towards the part
  double search_mm = 0.0;                  ///< how far beyond the expected contact a probe may go
  double rate_hz = 0.0;                    ///< of an analogue probe
  double spin_up_s = 0.0;   ///< in which C and Z get to their speed, for an analogue probe
  std::string work_offset;  ///< empty: not stated
  bool x_diameter = false;  ///< X words and measured positions of the control are diameters
  char gcode_system = 0;    ///< of FANUC: 'A', 'B' or 'C'; 0: not stated

  std::string offset() const { return work_offset.empty() ? "G54" : work_offset; }
  double clear_x_mm() const { return reach_mm + ball_radius_mm + clearance_mm; }
  /// In a bore whose free radius is stated.
  double inside_x_mm() const { return *bore_radius_mm - ball_radius_mm - clearance_mm; }
  double clear_z_mm() const { return front_mm + ball_radius_mm + clearance_mm; }
};

enum class ProbingControl { linuxcnc, fanuc, siemens, heidenhain };

struct ProbingProgram {
  std::string text;
  std::size_t readings = 0;
  double minutes = 0.0;  ///< about
};

/// The plans one after the other, each with its own log.
/// @param name of the program's file, without folder and ending: the logs are called after it
/// @param file of the limits, which diagnostics name
/// @throws InputError with every reason why a plan cannot be driven so
ProbingProgram write_probing(std::span<const ProbingPlan> plans, const ProbingLimits& limits,
                             ProbingControl control, const std::string& name, bool dry_run,
                             const std::string& file);

}  // namespace trueaxis::nc

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

/// Programs that measure a plan: the motion, what it must keep to, and how each control writes it.
namespace trueaxis::nc {

/// One run of the probe along Z, C and Z in proportion.
struct ProbingPass {
  double start_mm = 0.0, end_mm = 0.0;
  double turns = 0.0;    ///< signed like C; 0: at standstill
  double seconds = 0.0;  ///< that a probe takes that reads while the spindle turns
  std::size_t readings = 0;
  double c_rad = 0.0;  ///< where C starts
  bool rear = false;   ///< probed at the smaller X
  double rpm() const { return seconds > 0.0 ? 60.0 * turns / seconds : 0.0; }
};

/// The passes on a shaft whose radius is known roughly.
struct ProbingPlan {
  std::string what;  ///< in a few words, for the head of the program
  double radius_mm = 0.0;
  double slope = 0.0;  ///< of the radius over Z
  std::vector<ProbingPass> passes;
  double radius_at(double z_mm) const { return radius_mm + slope * z_mm; }
};

/// Why a part cannot be probed by a program; empty: it can.
std::string objection_to_part(bool bore, bool face);

enum class ProbeKind {
  touch,     ///< a trigger: points at indexed C
  analogue,  ///< a gauge that is read while the spindle turns
};

/// What the machine and its operator state. X is a radius, from the spindle axis.
struct ProbingLimits {
  double x_low_mm = 0.0, x_high_mm = 0.0, z_low_mm = 0.0, z_high_mm = 0.0;
  double speed_rpm = 0.0;     ///< highest of C
  double reach_mm = 0.0;      ///< no part, jaw or chuck is farther from the axis than this
  double front_mm = 0.0;      ///< and none beyond this Z
  double clearance_mm = 0.0;  ///< that rapid moves keep
  ProbeKind kind = ProbeKind::touch;
  double ball_radius_mm = 0.0;
  double feed_mm_per_s = 0.0;  ///< towards the part
  double search_mm = 0.0;      ///< how far beyond the expected contact a probe may go
  double rate_hz = 0.0;        ///< of an analogue probe
  double spin_up_s = 0.0;      ///< in which C and Z get to their speed, for an analogue probe
  std::string work_offset;     ///< empty: not stated
  bool x_diameter = false;     ///< X words and measured positions of the control are diameters
  char gcode_system = 0;       ///< of FANUC: 'A', 'B' or 'C'; 0: not stated

  std::string offset() const { return work_offset.empty() ? "G54" : work_offset; }
  double clear_x_mm() const { return reach_mm + ball_radius_mm + clearance_mm; }
  double clear_z_mm() const { return front_mm + ball_radius_mm + clearance_mm; }
};

enum class ProbingControl { linuxcnc, fanuc, siemens, heidenhain };

struct ProbingProgram {
  std::string text;
  std::size_t readings = 0;
  double minutes = 0.0;  ///< about
};

/// @param name of the program's file, without folder and ending: the log is called after it
/// @param file of the limits, which diagnostics name
/// @throws InputError with every reason why the plan cannot be driven so
ProbingProgram write_probing(const ProbingPlan& plan, const ProbingLimits& limits,
                             ProbingControl control, const std::string& name, bool dry_run,
                             const std::string& file);

}  // namespace trueaxis::nc

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace trueaxis::virtual_lathe {

enum class CutKind { cylinder, cone, face };

/// Which column of the table the actuator is given.
enum class CutUse { command, wanted, none };

/// What the control is programmed to cut, about the spindle axis.
struct CutTarget {
  CutKind kind = CutKind::cylinder;
  bool bore = false;
  double start_mm = 0.0,
         end_mm = 0.0;          ///< Z (face: X) of the nose centre, in the order of the feed
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
  std::string table;  ///< file name of the table; not needed for CutUse::none
};

}  // namespace trueaxis::virtual_lathe

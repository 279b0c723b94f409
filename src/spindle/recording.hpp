// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "spindle/layout.hpp"
#include "trueaxis/probe_stream.hpp"

namespace trueaxis {

/// The readings of one set-up of one stream, outwards from the spindle axis (axial: along Z).
struct RunReadings {
  std::string stream;
  SetUp set_up;
  std::vector<double> angles_rad;  ///< of the sensors, the rear side as half a turn
  std::vector<double> c_rad;
  std::vector<std::vector<double>> columns_mm;  ///< one a sensor
  double radius_mm = 0.0;                       ///< of the part there; 0: nobody says
  bool rear = false;
  bool axial = false, on_axis = false;  ///< on_axis: a face read at X = 0
  std::size_t left_out = 0;

  double turns() const;
};

/// The runs of the streams. @throws InputError with all that does not go together in one estimate.
std::vector<RunReadings> take_runs(std::span<const ProbeStream> streams);

/// Where the motion is felt: as wanted, else X, or the line of the sensors if they are on one.
/// @throws InputError if they are on another line than that wanted.
double sensitive_direction(std::span<const RunReadings> runs, std::optional<double> wanted_rad);

/// The channels of the runs. @throws InputError where there are fewer than unknowns.
Layout layout_of(std::span<const RunReadings> runs, double sensitive_rad);

class SynchronousFit;
struct SynchronousPart;

/// @throws InputError where readings are missing and the orders that are left are not all there are
void expect_no_gap(const RunReadings& run, const SynchronousFit& fit, const SynchronousPart& part);

/// The readings of a run less those whose `marks` are set.
void leave_out(RunReadings& run, const std::vector<bool>& marks);

}  // namespace trueaxis

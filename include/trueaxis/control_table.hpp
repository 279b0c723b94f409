// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "trueaxis/correction.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {

/// A form in which a correction goes to a machine, in addition to the table of run_job.
enum class ControlFormat {
  grid,                 ///< CSV: C down, Z (of a face X) across, µm
  halstreamer,          ///< LinuxCNC: a set-point a line, µm, and C
  servo_nc,             ///< slow tool servo: blocks C X Z under inverse time
  sinumerik_cec,        ///< SINUMERIK: X over C, a table for each band of Z
  beckhoff_crosscomp2,  ///< Beckhoff and ISG: X over C and Z
};

std::string_view to_string(ControlFormat format);

/// What a control needs to know in addition to the correction itself.
struct ControlTable {
  ControlFormat format = ControlFormat::grid;
  std::string file;                 ///< name in the folder of the results
  double c_step_rad = rad_per_deg;  ///< of grids and tables; a whole number of them is a turn
  double position_step_mm = 1.0;    ///< along Z (of a face X); of SINUMERIK the length of a band
  bool x_is_diameter = false;       ///< servo_nc: X is written as a diameter
  bool minutes = false;             ///< servo_nc: F is minutes a block instead of blocks a minute
  std::string head, tail;           ///< servo_nc: text before and after the blocks
  int x_axis = 1, c_axis = 2, z_axis = 3;  ///< Beckhoff: numbers of the axes
};

/// A file for a control, and how far it is off.
struct MadeControlTable {
  std::string text;
  double rounding_mm = 0.0;  ///< half the last digit of a value
  /// How far the control's reading of the text is from the wanted correction: rounding and
  /// coarseness together. It is linear between its points (for a band its one table). halstreamer
  /// holds each line until the next; its deviation is from straight lines between the commands.
  Deviation off;
};

/// Why a file of this form cannot be made of such a cut, and what to do; empty: it can. The limits
/// are 10⁶ values of a grid, 5·10⁷ lines of a stream, 10⁶ NC blocks, SINUMERIK's 8 tables of 200
/// points, Beckhoff's 10201 points.
std::string objection_to(const ControlTable& table, const TargetSurface& target,
                         const ToolSetup& tool);

/// @throws ContractViolation where objection_to() has one
MadeControlTable make_control_table(const Correction& correction, const ControlTable& table);

/// What a control that interpolates `values` (of the rows, mm) over C and position makes of a
/// table: linear along C between the rows, and along the position between two revolutions at the
/// same C. Beyond the ends of the path the ends are held. The servo component for LinuxCNC does the
/// same, bit for bit.
/// @param turns since the first row, in the sense of the cut: sense · (C − c_start) / 2π
double table_value_mm(const CorrectionRows& rows, const std::vector<double>& values,
                      int rows_per_revolution, double turns, double position_mm);

}  // namespace trueaxis

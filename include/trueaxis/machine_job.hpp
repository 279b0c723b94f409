// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "trueaxis/compensation.hpp"
#include "trueaxis/job.hpp"
#include "trueaxis/machine_diagnosis.hpp"

/// The job of a machine of several axes: from a measurement to its errors, and with them from a
/// program to one that cuts right (docs/reference/machine-job.md). Inside mm, rad and s.
namespace trueaxis {

/// A file that a job reads, for the record.
struct JobInput {
  std::string what, file, hash;
};

struct MachineJobProgram {
  std::string file, text;
  CompensationOptions options;
};

/// Everything read: what is wrong with any file is known before anything is computed.
struct MachineJob {
  std::string path, name;
  Machine machine;
  ErrorModel known;  ///< errors that were known before; what is measured adds to them
  std::vector<std::string> remarks_of_known{};  ///< what their files do not say
  std::vector<MachineMeasurement> data;
  double false_alarm = 0.01;
  std::optional<MachineJobProgram> program;
  /// How far the tip may be from where the program has it in the part.
  std::optional<double> tolerance_mm;
  std::vector<JobInput> inputs;
  JobHeader header{};
};

/// Where an axis was measured and where the program has it, mm or rad; the program's cutting moves.
struct AxisRange {
  AxisName axis = AxisName::X;
  double measured_low = 0.0, measured_high = 0.0;
  std::optional<std::array<double, 2>> program;
};

/// Displacement of all tips as one rigid body: of a part that is elsewhere. A measurement of balls
/// does not tell it, as their places are unknown; who probes the part finds it.
struct PartDisplacement {
  Vector3 about_mm{};  ///< of the workpiece's body, M in the zero position
  Vector3 shift_mm{}, turn_rad{};
};

/// The tip at the end of a cutting move against where the program has it, in the workpiece's body
/// and without the displacement of the part as a whole.
struct ProgramTip {
  std::size_t line = 0;  ///< of the program that was read
  Vector3 tip_mm{};      ///< nominal, in the program frame
  Vector3 before_mm{}, after_mm{};
  double u_mm = 0.0;  ///< standard uncertainty: root of the trace of the tip's covariance
};

/// Tip errors over the positions of two axes, the others at `at`; what `ProgramTip` says of them.
struct ErrorMap {
  AxisName across = AxisName::X, up = AxisName::Y;
  AxisPositions at{};
  std::vector<double> across_positions, up_positions;  ///< mm or rad
  std::vector<double> before_mm;                       ///< by rows of `up`
  std::vector<double> after_mm;  ///< at most (95 % confidence); NaN: out of reach
};

struct MachineJobVerdict {
  Decision decision = Decision::no_go;
  Reasons reasons, reservations;
  Reasons next;                            ///< what to do now
  double before_mm = 0.0, after_mm = 0.0;  ///< largest, at the ends of cutting moves
  std::size_t before_line = 0, after_line = 0;
  double between_mm = 0.0;  ///< largest deviation between the ends, of the new program
  /// The same of the program as it was read, without the displacement of the part as a whole.
  double between_before_mm = 0.0;
  std::size_t between_before_line = 0;
  double U_mm = 0.0;                      ///< of the tip, k = 2, largest
  double not_corrected_mm = 0.0;          ///< what was found and no program can correct
  double lower_mm = 0.0, upper_mm = 0.0;  ///< the tip is off by less with 5 % and 95 %

  /// On the whole path, ends of blocks and between them.
  double path_before_mm() const { return std::max(before_mm, between_before_mm); }
  double path_after_mm() const { return std::max(after_mm, between_mm); }
  bool go() const { return decision != Decision::not_proven && decision != Decision::no_go; }
};

struct MachineJobResult {
  MachineJob job;
  MachineDiagnosis diagnosis;
  std::string implausible;  ///< why the errors cannot be right; empty: nothing speaks against them
  ErrorModel errors;        ///< known and found, with what is uncertain of them
  std::optional<ProgramCompensation> compensation;
  std::vector<AxisRange> ranges;
  std::optional<PartDisplacement> part;  ///< of the program as it was read
  std::vector<ProgramTip> tips;
  std::vector<ErrorMap> maps;
  Reasons remarks;  ///< what holds for the numbers, and what they do not contain
  MachineJobVerdict verdict;
};

/// Diagnosis, errors with what was found fitted in, the program compensated with them, and the
/// verdict, which is final. @throws InputError as `diagnose_machine` and `compensate_program` do
MachineJobResult run_machine_job(MachineJob job);

/// The same from a diagnosis of the job's measurements that is made already.
MachineJobResult run_machine_job(MachineJob job, MachineDiagnosis diagnosis);

}  // namespace trueaxis

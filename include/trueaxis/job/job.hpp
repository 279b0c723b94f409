// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "trueaxis/correct/correction.hpp"
#include "trueaxis/correct/target_axis.hpp"
#include "trueaxis/fit/fit.hpp"
#include "trueaxis/measure/probe_stream.hpp"

namespace trueaxis {

/// What the job says of a stream that the stream does not.
struct StreamReading {
  std::optional<bool> diameter;             ///< X_M is a diameter (true) or a radius (false)
  std::optional<Indication> indication;     ///< overrides the stream's `reading`
  std::optional<double> nominal_radius_mm;  ///< overrides the stream's `nominal_radius`
};

/// One reference surface of a job and how its stream is to be read and fitted.
struct JobReference {
  std::string name;
  std::string stream;  ///< path, relative to the job file
  StreamReading read;
  FitOptions fit;
  double weight = 1.0;
  double face_radius_mm = 0.0;  ///< plane: radius at which its tilt counts; 0: the largest X probed
};

/// The main job: from probe streams to a correction table. Everything but the references is
/// optional; without a target the job ends with the fit.
struct Job {
  std::string path, name;
  std::vector<JobReference> references;
  std::optional<TargetSurface> target;
  std::optional<double>
      coaxiality_tolerance_mm;  ///< ISO 1101, a diameter; of a face its axial run-out
  ToolSetup tool;
  Actuator actuator;
};

/// ISO 14253-1 decision about the tolerance, with the numbers it rests on.
struct Verdict {
  bool go = false;
  std::string line;                   ///< the first line of the result
  double coaxiality_before_mm = 0.0;  ///< cut about the spindle axis, against the references
  double coaxiality_after_mm =
      0.0;  ///< expected with the table: what the compromise and the actuator leave
  double u_coaxiality_mm =
      0.0;  ///< standard uncertainty of the cut axis against the reference, as a diameter
  double coverage_factor = 2.0;
};

struct JobResult {
  Job job;
  std::vector<ProbeStream> streams;  ///< one per reference
  std::vector<FitResult> fits;       ///< one per reference
  std::optional<TargetAxis> target_axis;
  std::optional<Correction> correction;
  Verdict verdict;
};

/// Fit, target axis, correction, verdict. Streams come read, one per reference.
JobResult run_job(Job job, std::vector<ProbeStream> streams);

}  // namespace trueaxis

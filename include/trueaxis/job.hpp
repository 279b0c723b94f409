// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "trueaxis/correction.hpp"
#include "trueaxis/diagnosis.hpp"
#include "trueaxis/estimate.hpp"
#include "trueaxis/fit.hpp"
#include "trueaxis/probe_stream.hpp"

namespace trueaxis {

/// Noise-free readings of a simulation with the ideal surface (before) and with the extended model
/// (after) at the arguments of a measured stream, one a reading, mm.
struct SimulatedReadings {
  std::vector<double> before_mm, after_mm;
};

/// How far a simulation is from what was measured.
struct Discrepancy {
  double rms_mm = 0.0;  ///< of measured − simulated
  double share = 0.0;   ///< its variance over that of measured − ideal surface
};

/// Measured against simulated, before and after. Readings that are masked do not count.
struct Comparison {
  std::size_t readings = 0, masked = 0;
  Discrepancy before, after;
  Discrepancy noise;  ///< what noise alone would leave
  /// λ of measured = after + λ (before − after) + noise, by least squares about the mean: 0 where
  /// what was found is right; above ½ exactly where more of the variance is left than before. u is
  /// that of the diagnosis' noise. Not determined where the two simulations are the same.
  Estimate j_test_lambda;
  /// Amplitudes of measured − simulated over the order, in half resolution cells up to order 15 or
  /// half the sampling; none for less than half a turn.
  std::vector<SpectrumBin> spectrum;
  std::vector<SpectrumBin> lines;  ///< its largest, largest first
};

/// A diagnosed measurement taken again by the virtual lathe.
struct Resimulation {
  SimulatedReadings readings;
  Comparison comparison;
  std::string why_not;  ///< not empty: there is none, for this reason
};

/// @param sigma_mm standard deviation of a reading
/// @param autoregression φ of its noise ε_i = Σ φ_j ε_{i−j} + e_i; empty: white
Comparison compare(const ProbeStream& measured, const SimulatedReadings& simulated,
                   const std::vector<bool>& masked, double sigma_mm,
                   const std::vector<double>& autoregression = {});

/// Whether the findings are refuted: more is left with them than without (λ > ½), and by more than
/// chance. Both differences hold the same noise; were the findings right, λ would be 0 with the
/// standard uncertainty u. Beyond chance is λ > 2.33 u, 1 % on one side: the C test of Davidson &
/// MacKinnon, Econometrica 49 (1981) 781, of two models that do not contain each other. That alone
/// would refute too much: linearised terms move λ of a right finding (a nonlinearity of 20 µm:
/// 0.2).
bool refuted(const Comparison& comparison);

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
  /// Ids of machine motions that the correction is to follow as well; see repeating_effects().
  std::vector<std::string> include;
};

/// The machine motions that repeat at the tool: only these may be asked into a correction. A form
/// of the reference acts through the target axis alone, an error of the probe never.
std::span<const std::string_view> repeating_effects();

/// What became of a motion that the job asked into the correction.
struct Inclusion {
  std::string effect;
  std::string reference;  ///< where it was found; empty: nowhere
  bool included = false;
  bool refused = false;  ///< found, but it must not be cut with: then there is no go
  std::string why;       ///< why it is not included
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
  std::vector<FitResult> fits;       ///< one per reference: the ideal surface
  /// One per reference; none for a face, which is not diagnosed, and where a fit failed.
  std::vector<std::optional<Diagnosis>> diagnoses;
  /// One per reference when the diagnosed ones were simulated again after the job was run; else
  /// empty.
  std::vector<std::optional<Resimulation>> resimulations;
  std::vector<Inclusion> inclusions;
  std::optional<TargetAxis> target_axis;
  std::optional<Correction> correction;
  Verdict verdict;
};

/// The fit whose axis the correction takes: that of the extended model where the diagnosis found
/// something and it converged, else that of the ideal surface.
const FitResult& fit_used(const JobResult& result, std::size_t reference);

/// Fit, diagnosis, target axis, correction, verdict. Streams come read, one per reference.
JobResult run_job(Job job, std::vector<ProbeStream> streams);

/// Takes a go back where the virtual lathe refutes what the diagnosis of a reference found
/// (refuted()): the axis that the correction takes is then that of a wrong model. A resimulation
/// that there is none of refutes nothing.
void judge_resimulations(JobResult& result);

}  // namespace trueaxis

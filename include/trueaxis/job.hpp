// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "trueaxis/control_table.hpp"
#include "trueaxis/correction.hpp"
#include "trueaxis/datum_axis.hpp"
#include "trueaxis/diagnosis.hpp"
#include "trueaxis/fit.hpp"
#include "trueaxis/machine_loop.hpp"
#include "trueaxis/part_form.hpp"
#include "trueaxis/probe_stream.hpp"
#include "trueaxis/reason.hpp"
#include "trueaxis/resimulation.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {

/// One reference surface of a job and how its stream is to be fitted.
struct JobReference {
  std::string name;
  FitOptions fit;
  double weight = 1.0;
  double face_radius_mm = 0.0;  ///< plane: radius at which its tilt counts; 0: the largest X probed
  FormTask form{};              ///< tolerances of its form and how it is filtered
  /// How ISO 5459 associates the axis that a cut is about; none: least squares along the probe
  /// line.
  std::optional<Criterion> association{};
};

/// The axis of a diagnosed reference that a cut is about. Whichever it is, the verdict holds the
/// cut against the stated one, which is where the axis is as far as the readings tell.
enum class AxisOfCut {
  stated,  ///< the average over what may have caused the readings
  named,   ///< were all causes those that are named
  ideal    ///< of the ideal fit, as if there were no cause
};

const char* to_string(AxisOfCut axis);

/// The datum system of a target (ISO 5459), primary first. Several references in one are a common
/// datum (A-B). Empty: the target axis is the weighted compromise of all references.
using DatumSystem = std::vector<std::vector<std::string>>;

/// What heads the report of a job, as the job says it: label ("Part", "Serial number" …) and text.
/// Nothing is computed with it.
using JobHeader = std::vector<std::pair<std::string, std::string>>;

/// The main job: from probe streams to a correction table. Everything but the references is
/// optional; without a target the job ends with the fit.
struct Job {
  std::string name;
  std::vector<JobReference> references;
  std::optional<TargetSurface> target;
  std::optional<double>
      coaxiality_tolerance_mm;  ///< ISO 1101, a diameter; of a face its axial run-out
  /// The most that may be removed over the target as clamped, in radius (a face: along Z). Needed
  /// where the target lies on the probed length of a reference.
  std::optional<double> stock_mm;
  ToolSetup tool;
  Actuator actuator;
  /// Ids of machine motions that the correction is to follow as well; see repeating_effects().
  std::vector<std::string> include;
  AxisOfCut axis_of_cut = AxisOfCut::stated;
  DatumSystem datums{};
  std::vector<ControlTable> outputs{};  ///< files for controls, in addition to the table
  JobHeader header{};
  /// Roundness and cylindricity of each reference in addition to its axis; false: a study of many
  /// jobs needs none, and `forms` stays empty where no tolerance asks for them.
  bool values_of_form = true;
  /// What parts before told of the machine: the table is corrected for it.
  LoopResponse loop{};
};

/// The machine motions that repeat at the tool: only these may be asked into a correction. A form
/// of the reference acts through the target axis alone, an error of the probe never.
std::span<const std::string_view> repeating_effects();

/// What became of a motion that the job asked into the correction.
struct Inclusion {
  std::string effect;
  std::string reference;  ///< where it was found; empty: nowhere
  bool included = false;
  bool refused = false;         ///< found, but it must not be cut with: then there is no go
  std::optional<Reason> why{};  ///< why it is not included, or what remains open of an included one
};

/// Two references whose axes are apart by more than their uncertainty: half-way between their
/// lengths and in direction.
struct Disagreement {
  std::size_t first = 0, second = 0;          ///< references
  double offset_mm = 0.0, U_offset_mm = 0.0;  ///< 0 where one of them is a plane
  double tilt_rad = 0.0, U_tilt_rad = 0.0;
  double between_mm = 0.0;  ///< from the middle of one probed length to that of the other
  double p_value = 1.0;     ///< that the readings' noise alone sets them as far apart
};

/// The references compared with each other. Surfaces of real parts are not quite coaxial, so a
/// disagreement alone is ordinary: a reason is what a mistake in a stream or job, tried on the
/// data, explains, or a disagreement that no part has.
struct Agreement {
  std::vector<Disagreement> disagreements;  ///< the largest first
  std::optional<Reason> reason;             ///< with what mends it: then nothing may be cut
  double odds = 0.0;  ///< of the mistake that is named against none, of equal odds before
};

/// The probability that a part with a go is out of tolerance (ISO 14253-1): 5 %.
inline constexpr double nonconformity_risk = 0.05;

/// What may be done with the result.
enum class Decision {
  identified,            ///< no target: nothing to decide
  untoleranced,          ///< no tolerance: the table is there, nobody says how good it must be
  go,                    ///< conformity is proven, at a risk of 5 %
  go_with_reservations,  ///< so it is whichever model is right, but the data leave the model open
  not_proven,            ///< neither conformity nor nonconformity is proven
  no_go                  ///< nonconformity is proven, or something forbids the cut
};

/// A file that the cut may be run with, and what it adds to the coaxiality (of a face the run-out)
/// of the target axis, a diameter, mm.
struct CutFile {
  std::string name;
  double actuator_mm = 0.0;  ///< the part of the following error that turns with the part
  double file_mm = 0.0;      ///< its rounding and coarseness, as its control reads it
  double adds_mm = 0.0;      ///< both together
};

/// The numbers that the decision about a cut rests on.
struct CutNumbers {
  /// The files of the job and table.csv. The numbers below are of the one that adds most, `file`.
  std::vector<CutFile> files{};
  std::string file{};
  double coaxiality_before_mm = 0.0;  ///< cut about the spindle axis, against the references
  double coaxiality_after_mm =
      0.0;  ///< expected with `file`: what the compromise, the actuator and the file leave
  double u_coaxiality_mm = 0.0;  ///< of the worst reference's axis in its worse direction, doubled
  double lower_mm = 0.0, upper_mm = 0.0;  ///< the coaxiality is below with 5 % and 95 %
  double coverage_factor = 2.0;  ///< of U in fits; the decision's risk is 5 % whatever it is
};

/// ISO 14253-1 decision about the tolerance, with what it rests on.
struct Verdict : CutNumbers {
  Decision decision = Decision::no_go;
  Reasons reasons{};       ///< why the decision is what it is, the weightiest first
  Reasons reservations{};  ///< what a reader of it must know as well
  Reasons moved{};         ///< slips that are sure: the axis is that of now

  /// Whether the table may be run.
  bool go() const { return decision != Decision::not_proven && decision != Decision::no_go; }
  /// Of a tolerance that is not proven the measurement that would; of a file that is too coarse
  /// what would do.
  Reasons what_would_prove() const;
};

const char* to_string(Decision decision);

/// The datum system of a target (Eqs. 304, 305): its axis is linear in those of the references.
struct TargetDatum {
  std::string name;  ///< "A-B | C"
  double z_ref_mm = 0.0;
  /// One per reference: the datum's axis by its own, both at z_ref.
  std::vector<AxisMatrix> shares;
  std::vector<Remainder> references;  ///< residual at each reference, which nothing judges
};

/// What the readings tell of the references: the input of all that follows.
struct IdentifiedJob {
  Job job;
  std::vector<ProbeStream> streams;  ///< one per reference
  std::vector<FitResult> fits;       ///< one per reference: the ideal fit
  Agreement agreement;
  /// One per reference; none for a face, which is not diagnosed, and where a fit failed.
  std::vector<std::optional<Diagnosis>> diagnoses;
  /// Every diagnosed reference as the virtual lathe takes it again.
  std::vector<std::optional<Resimulation>> resimulations;
};

/// The cut that follows from it, unless something forbids to compute one.
struct PlannedJob : IdentifiedJob {
  /// One per reference: if the job states an `association`, how far its axis is off least squares.
  std::vector<std::optional<AxisEstimate>> associated{};
  std::optional<TargetDatum> datum{};  ///< of a job that names `datums`
  std::vector<Inclusion> inclusions{};
  std::optional<TargetAxis> target_axis{};
  std::optional<Correction> correction{};
  std::vector<MadeControlTable> control_files{};  ///< one for each of job.outputs
  std::string refused{};  ///< why no correction could be made though all was fitted; else empty
};

struct JobResult : PlannedJob {
  std::vector<PartForm> forms{};  ///< one per reference
  /// One per reference: what other associations would give; empty without any.
  std::vector<std::vector<DatumAxis>> datum_axes{};
  Verdict verdict{};
  /// One per reference: why its axis is withheld from its fits; `why_not` there is the code.
  std::vector<std::optional<Reason>> axis_unknown{};
  std::optional<MachineFeedback> feedback{};  ///< of a job that learns from part to part
};

/// The fit whose axis the correction uses: the final one if the diagnosis found something and
/// converged, else the ideal fit.
const FitResult& fit_used(const IdentifiedJob& job, std::size_t reference);

/// Whether every tolerance of form is proven met. The verdict is of the cut and does not hold them.
bool forms_met(const JobResult& result);

/// The least coaxiality that the cut has as it was probed again, if it is beyond the tolerance (ISO
/// 14253-1): twice its distance from the target axis less U. (No axis is nearer to all references
/// than the target axis, so to one of them it is at least that.)
std::optional<double> coaxiality_of_cut_not_met_mm(const JobResult& result);

/// Fit, diagnosis, form, the diagnosed measured again by the virtual lathe, target axis,
/// correction, and the verdict, which is final. `streams` are one per reference. If the cut is
/// refused (a tool that does not meet the target), the verdict has the reason and nothing is
/// thrown. @throws InputError as fit() does, and when the target lies on the probed length of a
/// reference
///         and the job does not say its stock; that diagnostic names no file.
JobResult run_job(Job job, std::vector<ProbeStream> streams);

}  // namespace trueaxis

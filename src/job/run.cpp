// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "job/inclusion.hpp"
#include "job/slip.hpp"
#include "trueaxis/error.hpp"
#include "trueaxis/job.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

/// Radius at which a reference's tilt counts: that of the face to be cut, else that of a plane
/// probed; 0 for a reference whose position counts.
double face_radius(const JobReference& reference, const FitResult& fit,
                   const TargetSurface& target) {
  if (target.kind == TargetKind::face)
    return std::max(target.radius_start_mm, target.radius_end_mm);
  if (fit.surface != "plane") return 0.0;
  if (reference.face_radius_mm > 0.0) return reference.face_radius_mm;
  return std::max(std::abs(fit.position_min_mm), std::abs(fit.position_max_mm));
}

bool usable(const JobResult& result) {
  return std::ranges::all_of(
      result.fits, [](const FitResult& fit) { return fit.status == FitStatus::converged; });
}

std::vector<Reference> references_of(const JobResult& result) {
  std::vector<Reference> references;
  for (std::size_t i = 0; i < result.fits.size(); ++i) {
    const JobReference& named = result.job.references[i];
    const FitResult& fit = fit_used(result, i);
    references.push_back(
        {named.name, fit.axis, named.weight, face_radius(named, fit, *result.job.target)});
  }
  return references;
}

/// What a cut about the spindle axis would leave at the worst reference.
double coaxiality_uncorrected(const std::vector<Reference>& references, double z_start,
                              double z_end) {
  double worst = 0.0;
  for (const Reference& r : references) {
    worst = std::max(
        worst, r.face_radius_mm > 0.0
                   ? 2.0 * r.face_radius_mm * std::hypot(r.axis.axis.slope_x, r.axis.axis.slope_y)
                   : coaxiality_mm({}, r.axis.axis, z_start, z_end));
  }
  return worst;
}

/// "2.7 µm", with the digits that an uncertainty U of it leaves.
std::string in_um(double length_mm, double U_mm) {
  char text[48];
  std::snprintf(text, sizeof text, "%.*f µm", decimals_of(U_mm / mm_per_um, 1),
                length_mm / mm_per_um);
  return text;
}

std::string as_given_um(double length_mm) {
  char text[48];
  std::snprintf(text, sizeof text, "%.9g µm", length_mm / mm_per_um);
  return text;
}

std::string runs_at(const ActuatorMargin& margin) {
  if (!(margin.max_speed_rpm > 0.0)) return "it would not at any speed";
  char text[64];
  std::snprintf(text, sizeof text, "it would at %.0f rpm or less",
                std::floor(margin.max_speed_rpm));
  return text;
}

/// ISO 14253-1: conformity is shown when value + U lies within the tolerance.
void decide(JobResult& result, const std::vector<Reference>& references) {
  Verdict& verdict = result.verdict;
  const TargetSurface& target = *result.job.target;
  const Correction& correction = *result.correction;
  verdict.coverage_factor = result.job.references.front().fit.coverage_factor;
  verdict.coaxiality_before_mm =
      coaxiality_uncorrected(references, target.z_start_mm, target.z_end_mm);
  const double k = verdict.coverage_factor;
  const auto worst = std::ranges::max_element(
      result.target_axis->remainders, {},
      [&](const Remainder& r) { return r.coaxiality_mm + k * r.u_coaxiality_mm; });
  // A following error that turns once a revolution moves the axis by its amplitude; all of it is
  // taken as such.
  verdict.coaxiality_after_mm = worst->coaxiality_mm + 2.0 * correction.margin.following_mm;
  verdict.u_coaxiality_mm = worst->u_coaxiality_mm;
  const double U = k * verdict.u_coaxiality_mm;
  const std::string numbers =
      std::string(target.kind == TargetKind::face ? "axial run-out " : "coaxiality ") +
      in_um(verdict.coaxiality_after_mm, U) + " with the table (U = " + in_um(U, U) + "), " +
      in_um(verdict.coaxiality_before_mm, U) + " without it";
  if (const std::string slip = slip_objection(result); !slip.empty()) {
    verdict.line = "NO-GO: " + slip;
    return;
  }
  if (!correction.margin.follows) {
    verdict.line = "NO-GO: the actuator cannot follow: " + correction.margin.breaks + "; " +
                   runs_at(correction.margin) + "; " + numbers;
    return;
  }
  if (!std::isfinite(U)) {
    verdict.line =
        "NO-GO: the readings give no uncertainty: probe more of them, or give the sensor's noise";
    return;
  }
  for (const Inclusion& inclusion : result.inclusions) {
    if (!inclusion.refused) continue;
    verdict.line = "NO-GO: " + inclusion.effect + " of " + inclusion.reference +
                   " must not enter the correction: " + inclusion.why;
    return;
  }
  if (!result.job.coaxiality_tolerance_mm) {
    verdict.go = true;
    verdict.line = "DONE, no tolerance given: " + numbers;
    return;
  }
  const double tolerance = *result.job.coaxiality_tolerance_mm;
  verdict.go = verdict.coaxiality_after_mm + U <= tolerance;
  verdict.line = std::string(verdict.go ? "GO: " : "NO-GO: ") + numbers + ", tolerance " +
                 as_given_um(tolerance);
}

void diagnose_all(JobResult& result) {
  for (std::size_t i = 0; i < result.streams.size(); ++i) {
    result.diagnoses.emplace_back();
    if (result.streams[i].kind == StreamKind::face) continue;
    if (result.fits[i].status != FitStatus::converged) continue;
    DiagnoseOptions options;
    options.fit = result.job.references[i].fit;
    result.diagnoses.back() = diagnose(result.streams[i], options);
  }
}

}  // namespace

const FitResult& fit_used(const JobResult& result, std::size_t reference) {
  expects(reference < result.fits.size(), "a reference of the job");
  const bool diagnosed = reference < result.diagnoses.size() && result.diagnoses[reference];
  if (!diagnosed) return result.fits[reference];
  const Diagnosis& diagnosis = *result.diagnoses[reference];
  const bool extended = diagnosis.verdict != DiagnosisVerdict::ideal &&
                        diagnosis.extended.status == FitStatus::converged;
  return extended ? diagnosis.extended : result.fits[reference];
}

JobResult run_job(Job job, std::vector<ProbeStream> streams) {
  expects(job.references.size() == streams.size() && !streams.empty(), "one stream per reference");
  JobResult result;
  result.job = std::move(job);
  result.streams = std::move(streams);
  for (std::size_t i = 0; i < result.streams.size(); ++i) {
    result.fits.push_back(fit(result.streams[i], result.job.references[i].fit));
  }
  diagnose_all(result);
  if (!usable(result)) {
    for (std::size_t i = 0; i < result.fits.size(); ++i) {
      if (result.fits[i].status == FitStatus::converged) continue;
      result.verdict.line =
          "NO-GO: " + result.job.references[i].name + ": " + result.fits[i].message;
      return result;
    }
  }
  if (!result.job.target) {
    const std::string slip = slip_objection(result);
    result.verdict.go = slip.empty();
    result.verdict.line =
        slip.empty() ? "DONE: identified, no target to correct" : "NO-GO: " + slip;
    return result;
  }
  const TargetSurface& target = *result.job.target;
  const std::vector<Reference> references = references_of(result);
  result.target_axis = solve_target_axis(references, target.z_start_mm, target.z_end_mm,
                                         target.kind != TargetKind::face);
  result.correction = make_correction(result.target_axis->axis, target, result.job.tool,
                                      result.job.actuator, included_motions(result));
  decide(result, references);
  return result;
}

}  // namespace trueaxis

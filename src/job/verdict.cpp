// SPDX-License-Identifier: Apache-2.0
#include "job/verdict.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "job/cut_checks.hpp"
#include "job/references.hpp"
#include "job/slip.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

/// What a cut about the spindle axis would leave at the worst reference.
double coaxiality_uncorrected(const std::vector<Reference>& references,
                              const TargetSurface& target) {
  double worst = 0.0;
  for (const Reference& r : references) {
    worst = std::max(
        worst, r.face_radius_mm > 0.0
                   ? 2.0 * r.face_radius_mm * std::hypot(r.axis.axis.slope_x, r.axis.axis.slope_y)
                   : coaxiality_mm({}, r.axis.axis, target.z_start_mm, target.z_end_mm));
  }
  return worst;
}

/// The numbers that the decision about a cut rests on.
Verdict expected_cut(const JobResult& result) {
  Verdict verdict;
  verdict.coverage_factor = result.job.references.front().fit.coverage_factor;
  verdict.coaxiality_before_mm = coaxiality_uncorrected(references_of(result), *result.job.target);
  const double k = verdict.coverage_factor;
  const auto worst = std::ranges::max_element(
      result.target_axis->remainders, {},
      [&](const Remainder& r) { return r.coaxiality_mm + k * r.u_coaxiality_mm; });
  // A following error that turns once a revolution moves the axis by its amplitude (Eq. 116a).
  verdict.coaxiality_after_mm =
      worst->coaxiality_mm + 2.0 * result.correction->margin.following_once_mm;
  verdict.u_coaxiality_mm = worst->u_coaxiality_mm;
  return verdict;
}

/// "2.7 µm", with the digits that an uncertainty U of it leaves.
std::string in_um(double length_mm, double U_mm) {
  return fmt::format("{:.{}f} µm", length_mm / mm_per_um, decimals_of(U_mm / mm_per_um, 1));
}

std::string numbers_of(const Verdict& v, TargetKind kind) {
  const double U = v.coverage_factor * v.u_coaxiality_mm;
  return fmt::format("{} {} with the table (U = {}), {} without it",
                     kind == TargetKind::face ? "axial run-out" : "coaxiality",
                     in_um(v.coaxiality_after_mm, U), in_um(U, U),
                     in_um(v.coaxiality_before_mm, U));
}

std::string cannot_follow(const ActuatorMargin& margin) {
  return "the actuator cannot follow: " + margin.breaks + "; " + margin.remedy;
}

/// Of the first reference whose findings the virtual lathe refutes; empty: of none.
std::string refutation(const JobResult& result) {
  for (std::size_t i = 0; i < result.resimulations.size(); ++i) {
    const auto& again = result.resimulations[i];
    if (!again || !again->why_not.empty() || !refuted(again->comparison)) continue;
    const std::string& reference = result.job.references[i].name;
    const NextMeasurement& next = result.diagnoses[i]->next;
    const Comparison& c = again->comparison;
    return fmt::format(
        "{}what was found does not reproduce the readings: simulated with them, {:.3g} µm RMS are "
        "left ({:.0f} % of the variance), with the ideal surface {:.3g} µm: {}",
        reference.empty() ? "" : reference + ": ", c.after.rms_mm / mm_per_um,
        100.0 * c.after.share, c.before.rms_mm / mm_per_um,
        next.plan.empty() || next.what.empty() ? "probe again" : next.what);
  }
  return "";
}

/// Why there is no go, whatever the tolerance; empty: nothing speaks against it.
std::string objection(const JobResult& result, const Verdict& numbers) {
  for (std::size_t i = 0; i < result.fits.size(); ++i) {
    if (result.fits[i].status != FitStatus::converged)
      return result.job.references[i].name + ": " + result.fits[i].message;
  }
  if (std::string slip = slip_objection(result); !slip.empty()) return slip;
  if (std::string cut = cut_objection(result); !cut.empty()) return cut;
  if (result.correction) {
    if (!result.correction->margin.follows)
      return cannot_follow(result.correction->margin) + "; " +
             numbers_of(numbers, result.job.target->kind);
    if (!std::isfinite(numbers.u_coaxiality_mm))
      return "the readings give no uncertainty: probe more of them, or give the sensor's noise";
    for (const Inclusion& inclusion : result.inclusions) {
      if (inclusion.refused)
        return inclusion.effect + " of " + inclusion.reference +
               " must not enter the correction: " + inclusion.why;
    }
  }
  return refutation(result);
}

}  // namespace

Verdict decide(const JobResult& result) {
  Verdict verdict = result.correction ? expected_cut(result) : Verdict{};
  if (const std::string why = objection(result, verdict); !why.empty()) {
    verdict.line = "NO-GO: " + why;
    return verdict;
  }
  verdict.go = true;
  if (!result.correction) {
    verdict.line = "DONE: identified, no target to correct";
    return verdict;
  }
  const std::string numbers = numbers_of(verdict, result.job.target->kind);
  if (!result.job.coaxiality_tolerance_mm) {
    verdict.line = "DONE, no tolerance given: " + numbers;
    return verdict;
  }
  const double tolerance_mm = *result.job.coaxiality_tolerance_mm;
  const double U_mm = verdict.coverage_factor * verdict.u_coaxiality_mm;
  verdict.go = verdict.coaxiality_after_mm + U_mm <= tolerance_mm;
  verdict.line = fmt::format("{}: {}, tolerance {:.9g} µm", verdict.go ? "GO" : "NO-GO", numbers,
                             tolerance_mm / mm_per_um);
  return verdict;
}

}  // namespace trueaxis

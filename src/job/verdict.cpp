// SPDX-License-Identifier: Apache-2.0
#include "job/verdict.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "correct/coaxiality_distribution.hpp"
#include "fit/plausible.hpp"
#include "job/cut_checks.hpp"
#include "job/cut_files.hpp"
#include "job/datum_doubts.hpp"
#include "job/doubts.hpp"
#include "job/exchanged.hpp"
#include "job/proof.hpp"
#include "job/references.hpp"
#include "job/sensor_doubts.hpp"
#include "job/slip.hpp"
#include "job/target_datum.hpp"
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

/// The file that adds most to the coaxiality of the axis.
const CutFile& worst_file(const std::vector<CutFile>& files) {
  return *std::ranges::max_element(files, {}, &CutFile::adds_mm);
}

CoaxialityDistribution distribution_of(const JobResult& result,
                                       const std::vector<Reference>& references) {
  const TargetSurface& target = *result.job.target;
  return {references, result.target_axis->axis.axis, target.z_start_mm, target.z_end_mm};
}

/// The numbers that the decision about a cut rests on.
Verdict expected_cut(const JobResult& result) {
  Verdict verdict;
  verdict.coverage_factor = result.job.references.front().fit.coverage_factor;
  const std::vector<Reference> references = judged(result, references_of(result));
  verdict.coaxiality_before_mm = coaxiality_uncorrected(references, *result.job.target);
  const auto worst =
      std::ranges::max_element(result.target_axis->remainders, {}, &Remainder::limit_mm);
  verdict.files = cut_files(result);
  const CutFile& file = worst_file(verdict.files);
  verdict.file = file.name;
  verdict.coaxiality_after_mm = worst->coaxiality_mm + file.adds_mm;
  verdict.u_coaxiality_mm = worst->u_coaxiality_mm;
  const CoaxialityDistribution distribution = distribution_of(result, references);
  verdict.lower_mm = distribution.quantile(nonconformity_risk) + file.adds_mm;
  verdict.upper_mm = distribution.quantile(1.0 - nonconformity_risk) + file.adds_mm;
  return verdict;
}

/// "2.7 µm", with two digits of it.
std::string in_um(double length_mm) {
  const double um = length_mm / mm_per_um;
  return fmt::format("{:.{}f} µm", um, decimals_of(um, 0));
}

/// "cec.ini, servo.nc or table.csv"
std::string names_of(const std::vector<CutFile>& files) {
  std::string names;
  for (std::size_t i = 0; i < files.size(); ++i)
    names += (i == 0 ? "" : i + 1 < files.size() ? ", " : " or ") + files[i].name;
  return names;
}

std::string numbers_of(const Verdict& v, TargetKind kind) {
  const std::string with =
      v.files.size() < 2 ? "the table (in 95 of 100)"
                         : fmt::format("{} (worst: {}, in 95 of 100)", names_of(v.files), v.file);
  return fmt::format("{} at most {} with {}, {} without it",
                     kind == TargetKind::face ? "axial run-out" : "coaxiality", in_um(v.upper_mm),
                     with, in_um(v.coaxiality_before_mm));
}

std::string cannot_follow(const ActuatorMargin& margin) {
  return "the actuator cannot follow: " + margin.breaks + "; " + margin.remedy;
}

/// Of the first reference whose findings the virtual lathe refutes; empty: of none.
std::string refutation(const JobResult& result) {
  for (std::size_t i = 0; i < result.resimulations.size(); ++i) {
    const auto& again = result.resimulations[i];
    if (!again || !again->why_not.empty() || !refuted(again->comparison)) continue;
    const NextMeasurement& next = result.diagnoses[i]->next;
    const Comparison& c = again->comparison;
    return fmt::format(
        "{}what was found does not reproduce the readings: simulated with them, {:.3g} µm RMS are "
        "left ({:.0f} % of the variance), with the ideal surface {:.3g} µm: {}",
        of_reference(result, i), c.after.rms_mm / mm_per_um, 100.0 * c.after.share,
        c.before.rms_mm / mm_per_um,
        next.plan.empty() || next.what.empty() ? "probe again" : next.what);
  }
  return "";
}

/// Why there is no go, whatever the tolerance; empty: nothing speaks against it.
std::string objection(const JobResult& result, const Verdict& numbers) {
  if (!result.agreement.reason.empty()) return result.agreement.reason;
  for (std::size_t i = 0; i < result.fits.size(); ++i) {
    const FitResult& fit = result.fits[i];
    if (fit.status == FitStatus::implausible)
      return reference_and_file(result, i) + ": " + fit.message;
    if (fit.status != FitStatus::converged)
      return result.job.references[i].name + ": " + fit.message + "; " +
             turns_text(result.streams[i]);
  }
  if (std::string slip = slip_objection(result); !slip.empty()) return slip;
  if (!result.refused.empty()) return result.refused;
  if (std::string cut = cut_objection(result); !cut.empty()) return cut;
  if (result.correction) {
    if (!result.correction->margin.follows)
      return cannot_follow(result.correction->margin) + "; " +
             numbers_of(numbers, result.job.target->kind);
    if (!std::isfinite(numbers.upper_mm))
      return "the readings give no uncertainty: probe more of them, or give the sensor's noise";
    for (const Inclusion& inclusion : result.inclusions) {
      if (inclusion.refused)
        return inclusion.effect + " of " + inclusion.reference +
               " must not enter the correction: " + inclusion.why;
    }
  }
  return refutation(result);
}

/// The largest coaxiality, at the risk of the decision, if the open references are where the ideal
/// fit has them.
double upper_if_ideal_mm(const JobResult& result, const std::vector<OpenAxis>& open,
                         double file_adds_mm) {
  std::vector<Reference> references = references_of(result);
  for (const OpenAxis& o : open)
    references[o.reference].axis.axis = result.fits[o.reference].axis.axis;
  return distribution_of(result, judged(result, references)).quantile(1.0 - nonconformity_risk) +
         file_adds_mm;
}

Verdict not_proven(Verdict verdict, const std::string& why) {
  verdict.decision = Decision::not_proven;
  verdict.line = "NOT PROVEN: " + why;
  return verdict;
}

/// Why an axis is not proven whatever its U says, with a cut or without; empty: nothing is in
/// doubt.
std::string axis_objection(const JobResult& result) {
  if (std::string why = result.correction ? datum_objection(result) : ""; !why.empty()) return why;
  for (std::size_t i = 0; i < result.diagnoses.size(); ++i) {
    if (!result.diagnoses[i]) continue;
    if (const std::string why = why_axis_unknown(result.streams.at(i), *result.diagnoses[i]);
        !why.empty())
      return of_reference(result, i) + why;
  }
  return "";
}

/// By the tolerance alone (Eq. 120).
Verdict by_tolerance(Verdict verdict, const JobResult& result, double tolerance_mm) {
  const std::string limit = fmt::format(", tolerance {:.9g} µm", tolerance_mm / mm_per_um);
  const std::string numbers = numbers_of(verdict, result.job.target->kind) + limit;
  if (verdict.upper_mm <= tolerance_mm) {
    verdict.decision = Decision::go;
    verdict.line = "GO: " + numbers;
    return verdict;
  }
  const CutFile worst = worst_file(verdict.files);
  const double by_file_mm = worst.adds_mm - worst.actuator_mm;
  const double axis_mm = verdict.upper_mm - by_file_mm;
  const std::string name_of_it = in_um(axis_mm) == in_um(verdict.upper_mm)
                                     ? ""
                                     : fmt::format("; {}, as its control reads it, adds {} of it",
                                                   worst.name, in_um(by_file_mm));
  if (axis_mm <= tolerance_mm || by_file_mm > tolerance_mm) {  // the file forbids it, not the axis
    const double allowed_mm = std::max(tolerance_mm - (verdict.upper_mm - worst.adds_mm),
                                       0.1 * tolerance_mm + worst.actuator_mm);
    verdict.what_would_prove = what_would_do(result, worst, allowed_mm);
    verdict.line = "NO-GO: " + numbers + name_of_it + ": " + verdict.what_would_prove;
  } else if (verdict.coaxiality_after_mm > tolerance_mm && verdict.lower_mm > tolerance_mm) {
    verdict.decision = Decision::no_go;
    verdict.line =
        fmt::format("NO-GO: {}, and at least {}{}", numbers, in_um(verdict.lower_mm), name_of_it);
  } else {
    verdict.what_would_prove = what_would_prove(result, tolerance_mm - worst.adds_mm);
    verdict = not_proven(std::move(verdict), numbers + name_of_it);
    verdict.line += "; " + verdict.what_would_prove;
  }
  return verdict;
}

}  // namespace

Verdict decide(const JobResult& result) {
  Verdict verdict = result.correction ? expected_cut(result) : Verdict{};
  if (const std::string why = objection(result, verdict); !why.empty()) {
    verdict.line = "NO-GO: " + why;
    return verdict;
  }
  verdict.moved = moved_part(result);
  const std::string moved = verdict.moved.empty() ? "" : "; " + verdict.moved;
  if (const std::string why = axis_objection(result); !why.empty())
    return not_proven(std::move(verdict), why);
  if (!result.correction) {
    verdict.decision = Decision::identified;
    verdict.line = "DONE: identified, no target to correct" + moved;
    return verdict;
  }
  const std::vector<OpenAxis> open = open_axes(result);
  for (const OpenAxis& o : open) verdict.reservations.push_back(o.why);
  for (std::string& why : model_reservations(result))
    verdict.reservations.push_back(std::move(why));
  for (std::string& why : datum_reservations(result))
    verdict.reservations.push_back(std::move(why));
  for (std::string& why : cut_reservations(result)) verdict.reservations.push_back(std::move(why));
  if (std::string why = axis_reservation(result); !why.empty())
    verdict.reservations.push_back(std::move(why));
  if (const auto tolerance_mm = result.job.coaxiality_tolerance_mm) {
    verdict = by_tolerance(std::move(verdict), result, *tolerance_mm);
    verdict.line += moved;
    if (verdict.decision == Decision::go) {
      std::string why = improbable_and_far(result, *tolerance_mm);
      if (why.empty()) why = sensor_or_eccentricity(result, *tolerance_mm - verdict.upper_mm);
      if (!why.empty()) return not_proven(std::move(verdict), why);
    }
    if (verdict.decision != Decision::go || verdict.reservations.empty()) return verdict;
    const double if_ideal_mm =
        open.empty() ? 0.0 : upper_if_ideal_mm(result, open, worst_file(verdict.files).adds_mm);
    if (if_ideal_mm > *tolerance_mm) {
      return not_proven(
          std::move(verdict),
          fmt::format("{}; were the axis where the ideal fit has it, the coaxiality would be up to "
                      "{}, tolerance {:.9g} µm",
                      open[0].why, in_um(if_ideal_mm), *tolerance_mm / mm_per_um));
    }
    verdict.decision = Decision::go_with_reservations;
    verdict.line = "GO with reservations" + verdict.line.substr(2);
  } else {
    verdict.decision = Decision::untoleranced;
    verdict.line =
        "DONE, no tolerance given: " + numbers_of(verdict, result.job.target->kind) + moved;
  }
  for (const std::string& reservation : verdict.reservations) verdict.line += "; " + reservation;
  return verdict;
}

const char* to_string(Decision decision) {
  switch (decision) {
    case Decision::identified:
      return "identified";
    case Decision::untoleranced:
      return "untoleranced";
    case Decision::go:
      return "go";
    case Decision::go_with_reservations:
      return "go_with_reservations";
    case Decision::not_proven:
      return "not_proven";
    case Decision::no_go:
      return "no_go";
  }
  return "";
}

}  // namespace trueaxis

// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <utility>

#include "correct/coaxiality_distribution.hpp"
#include "job/check.hpp"
#include "job/checks.hpp"
#include "job/conclude.hpp"
#include "job/cut_files.hpp"
#include "job/part_form_steps.hpp"
#include "job/references.hpp"
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

CoaxialityDistribution distribution_of(const PlannedJob& result,
                                       const std::vector<Reference>& references) {
  const TargetSurface& target = *result.job.target;
  return {references, result.target_axis->axis.axis, target.z_start_mm, target.z_end_mm};
}

CutNumbers numbers_of(const PlannedJob& result) {
  CutNumbers out;
  out.coverage_factor = result.job.references.front().fit.coverage_factor;
  const std::vector<Reference> references = judged(result, references_of(result));
  out.coaxiality_before_mm = coaxiality_uncorrected(references, *result.job.target);
  const auto worst =
      std::ranges::max_element(result.target_axis->remainders, {}, &Remainder::limit_mm);
  out.files = cut_files(result);
  const CutFile& file = worst_file(out.files);
  out.file = file.name;
  out.coaxiality_after_mm = worst->coaxiality_mm + file.adds_mm;
  out.u_coaxiality_mm = worst->u_coaxiality_mm;
  const CoaxialityDistribution distribution = distribution_of(result, references);
  out.lower_mm = distribution.quantile(nonconformity_risk) + file.adds_mm;
  out.upper_mm = distribution.quantile(1.0 - nonconformity_risk) + file.adds_mm;
  return out;
}

/// The largest coaxiality, at the risk of the decision, if the open references are where the ideal
/// fit has them.
double upper_if_ideal_mm(const PlannedJob& result, const Reasons& open, double file_adds_mm) {
  std::vector<Reference> references = references_of(result);
  for (const Reason& one : open) {
    const std::size_t i = one.references.front();
    references[i].axis.axis = result.fits[i].axis.axis;
  }
  return distribution_of(result, judged(result, references)).quantile(1.0 - nonconformity_risk) +
         file_adds_mm;
}

/// A length to two digits of it, as it is shown.
double shown_mm(double length_mm) {
  const double unit = mm_per_um * std::pow(10.0, -decimals_of(length_mm / mm_per_um, 0));
  return unit * std::nearbyint(length_mm / unit);
}

/// By the tolerance alone (Eq. 120).
void decide_by_tolerance(const PlannedJob& result, double tolerance_mm, Verdict& verdict) {
  Reason reason{ReasonCode::tolerance_kept, {}, {{"tolerance", tolerance_mm, "mm"}}};
  reason.parts = {expected_cut(result, verdict)};
  const CutFile worst = worst_file(verdict.files);
  const double by_file_mm = worst.adds_mm - worst.actuator_mm;
  const double axis_mm = verdict.upper_mm - by_file_mm;
  if (verdict.upper_mm <= tolerance_mm) {
    verdict.decision = Decision::go;
  } else if (axis_mm <= tolerance_mm || by_file_mm > tolerance_mm) {  // not the axis forbids it
    const double allowed_mm = std::max(tolerance_mm - (verdict.upper_mm - worst.adds_mm),
                                       0.1 * tolerance_mm + worst.actuator_mm);
    reason.code = ReasonCode::file_too_coarse;
    reason.remedies = {what_would_do(result, worst, allowed_mm)};
  } else if (verdict.coaxiality_after_mm > tolerance_mm && verdict.lower_mm > tolerance_mm) {
    reason.code = ReasonCode::tolerance_exceeded;
    reason.numbers.push_back({"at_least", verdict.lower_mm, "mm"});
  } else {
    verdict.decision = Decision::not_proven;
    reason.code = ReasonCode::tolerance_not_proven;
    reason.remedies = {what_would_prove(result, tolerance_mm - worst.adds_mm)};
  }
  if (!verdict.go() && shown_mm(axis_mm) != shown_mm(verdict.upper_mm)) {
    reason.numbers.push_back({"by_file", by_file_mm, "mm"});
    reason.names.push_back({"file_that_adds", worst.name});
  }
  verdict.reasons = {std::move(reason)};
}

/// For numbers that keep the tolerance: what forbids the go, or makes it one with reservations.
void decide_about_go(const PlannedJob& result, double tolerance_mm, Verdict& verdict) {
  Reasons open = first_found(Weight::leaves_open, CheckedAt::tolerance, {result, verdict});
  if (const Reasons axes = open_axes(result); open.empty() && !axes.empty()) {
    const double if_ideal_mm = upper_if_ideal_mm(result, axes, worst_file(verdict.files).adds_mm);
    if (if_ideal_mm > tolerance_mm)
      open = {{ReasonCode::axis_open_beyond_tolerance,
               {},
               {{"if_ideal", if_ideal_mm, "mm"}, {"tolerance", tolerance_mm, "mm"}},
               {},
               {axes.front()}}};
  }
  if (!open.empty()) {
    verdict.decision = Decision::not_proven;
    verdict.reasons = std::move(open);
  } else if (!verdict.reservations.empty()) {
    verdict.decision = Decision::go_with_reservations;
  }
}

void decide_cut(const PlannedJob& result, Verdict& verdict) {
  verdict.reservations = all_found(Weight::reserves, {result, verdict});
  if (const auto tolerance_mm = result.job.coaxiality_tolerance_mm) {
    decide_by_tolerance(result, *tolerance_mm, verdict);
    std::ranges::copy(verdict.moved, std::back_inserter(verdict.reasons));
    if (verdict.decision == Decision::go) decide_about_go(result, *tolerance_mm, verdict);
  } else {
    verdict.decision = Decision::untoleranced;
    verdict.reasons = {expected_cut(result, verdict)};
    std::ranges::copy(verdict.moved, std::back_inserter(verdict.reasons));
  }
}

}  // namespace

Verdict decide(const PlannedJob& result, std::span<const PartForm> forms) {
  Verdict verdict;
  if (result.correction) static_cast<CutNumbers&>(verdict) = numbers_of(result);
  const CheckInput input{result, verdict};
  verdict.reasons = first_found(Weight::forbids, CheckedAt::cut, input);
  if (verdict.reasons.empty()) {
    verdict.moved = moved_part(result);
    verdict.reasons = first_found(Weight::leaves_open, CheckedAt::cut, input);
    if (!verdict.reasons.empty()) {
      verdict.decision = Decision::not_proven;
    } else if (result.correction) {
      decide_cut(result, verdict);
    } else {
      verdict.decision = Decision::identified;
      verdict.reasons = verdict.moved;
      verdict.reasons.insert(verdict.reasons.begin(), {ReasonCode::no_target});
    }
  }
  const Reasons of_form = form_reservations(forms);
  if (verdict.decision == Decision::go && !of_form.empty())
    verdict.decision = Decision::go_with_reservations;
  std::ranges::copy(of_form, std::back_inserter(verdict.reservations));
  return verdict;
}

Reasons Verdict::what_would_prove() const {
  if (reasons.empty()) return {};
  const ReasonCode code = reasons.front().code;
  // The others' sentences end in their remedies.
  const bool apart = code == ReasonCode::tolerance_not_proven ||
                     code == ReasonCode::file_too_coarse ||
                     code == ReasonCode::slipped_between_references;
  return apart ? reasons.front().remedies : Reasons{};
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

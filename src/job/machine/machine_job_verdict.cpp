// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <utility>

#include "compensate/largest_on_way.hpp"
#include "job/machine/machine_doubts.hpp"
#include "job/machine/machine_job_steps.hpp"

namespace trueaxis::machine_job {
namespace {

Reason expected(const MachineJobVerdict& v) {
  return {ReasonCode::program_expected,
          {},
          {{"at_most", v.upper_mm, "mm"},
           {"without", v.path_before_mm(), "mm"},
           {"risk", nonconformity_risk}}};
}

/// Why the new program is no better than the old one.
std::optional<Reason> worse(const MachineJobResult& result, const MachineJobVerdict& v) {
  if (!result.compensation || result.tips.empty()) return {};
  const double by_decimals_mm = 2.0 * result.compensation->rounding.position.value;
  if (v.path_after_mm() <= stated_to * v.path_before_mm() + by_decimals_mm) return {};
  return Reason{
      ReasonCode::program_worse,
      {},
      {{"after", v.path_after_mm(), "mm"}, {"before", v.path_before_mm(), "mm"}},
      {},
      {},
      {{v.between_mm > v.after_mm ? ReasonCode::cut_in_pieces : ReasonCode::more_decimals}}};
}

/// What would bring the tip within its tolerance: the largest part of what it is off by.
Reasons remedies(const MachineJobResult& result, const MachineJobVerdict& v, double tolerance_mm) {
  const double budget_mm = tolerance_mm - v.not_corrected_mm - v.U_mm;
  if (v.between_mm > v.after_mm && v.between_mm > std::max(v.U_mm, v.not_corrected_mm)) {
    Reason leaves{ReasonCode::leaves_line, {}, {{"between", v.between_mm, "mm"}}};
    const double pieces_um = std::floor(0.8 * budget_mm / mm_per_um);
    if (pieces_um >= 1.0) leaves.numbers.push_back({"pieces", pieces_um * mm_per_um, "mm"});
    return {leaves};
  }
  if (const auto between = between_positions(result.diagnosis)) return {*between};
  if (v.not_corrected_mm > v.U_mm)
    return {{ReasonCode::not_corrected, {}, {{"not_corrected", v.not_corrected_mm, "mm"}}}};
  const double room_mm = tolerance_mm - v.path_after_mm() - v.not_corrected_mm;
  std::size_t rows = 0;
  for (const MachineMeasurement& file : result.job.data) rows += file.rows();
  if (room_mm > 0.0 && v.U_mm > room_mm)
    return {{ReasonCode::more_rows_measured,
             {},
             {{"left", v.U_mm, "mm"},
              {"times", std::pow(v.U_mm / room_mm, 2)},
              {"rows", static_cast<double>(rows)}}}};
  std::optional<Reason> plan = next_plan(result.diagnosis);
  if (!plan) return {};
  plan->code = ReasonCode::measure_plan;
  return {*plan};
}

void decide_by_tolerance(const MachineJobResult& result, double tolerance_mm,
                         MachineJobVerdict& v) {
  Reason reason{ReasonCode::tolerance_kept, {}, {{"tolerance", tolerance_mm, "mm"}}};
  reason.parts = {expected(v)};
  v.decision = Decision::go;
  if (v.upper_mm > tolerance_mm) {
    const bool beyond_doubt = v.lower_mm > tolerance_mm;
    v.decision = beyond_doubt ? Decision::no_go : Decision::not_proven;
    reason.code = beyond_doubt ? ReasonCode::tolerance_exceeded : ReasonCode::tolerance_not_proven;
    if (beyond_doubt) reason.numbers.push_back({"at_least", v.lower_mm, "mm"});
    reason.remedies = v.next = remedies(result, v, tolerance_mm);
  }
  v.reasons = {std::move(reason)};
}

/// What to do where the tolerance names nothing.
Reason next_of(const MachineJobResult& result, const MachineJobVerdict& v) {
  if (!v.go()) return {ReasonCode::mend_and_run_again};
  if (!result.job.program) return {ReasonCode::name_the_program};
  Reason next{ReasonCode::probe_zero_and_run};
  if (v.reservations.empty()) return next;
  if (const auto between = between_positions(result.diagnosis))
    next.remedies = {*between};
  else if (const auto plan = next_plan(result.diagnosis))
    next.remedies = {*plan};
  return next;
}

}  // namespace

MachineJobVerdict decide(const MachineJobResult& result, MachineJobVerdict v) {
  const double left_mm = v.path_after_mm();
  v.upper_mm = left_mm + v.not_corrected_mm + v.U_mm;
  v.lower_mm = std::max(0.0, left_mm - v.U_mm);
  std::optional<Reason> why = machine_objection(result);
  if (!why) why = worse(result, v);
  if (why) {
    v.reasons = {*why};
  } else {
    v.reservations = machine_reservations(result);
    if (!result.job.program) {
      v.decision = Decision::identified;
      v.reasons = {{ReasonCode::no_program}};
    } else if (const auto beyond = extrapolated(result)) {
      v.decision = Decision::not_proven;
      v.reasons = {*beyond};
    } else if (!result.job.tolerance_mm) {
      v.decision = Decision::untoleranced;
      v.reasons = {expected(v)};
    } else {
      decide_by_tolerance(result, *result.job.tolerance_mm, v);
      if (v.decision == Decision::go && !v.reservations.empty())
        v.decision = Decision::go_with_reservations;
    }
  }
  if (v.next.empty()) v.next = {next_of(result, v)};
  return v;
}

}  // namespace trueaxis::machine_job

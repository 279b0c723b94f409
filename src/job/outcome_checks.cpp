// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "fit/plausible.hpp"
#include "job/checks.hpp"
#include "job/cut_files.hpp"
#include "job/doubts.hpp"

namespace trueaxis {
namespace {

/// "cec.ini, servo.nc or table.csv"
std::string names_of(const std::vector<CutFile>& files) {
  std::string names;
  for (std::size_t i = 0; i < files.size(); ++i)
    names += (i == 0 ? "" : i + 1 < files.size() ? ", " : " or ") + files[i].name;
  return names;
}

Reasons find_failed_fit(const CheckInput& in) {
  return first_of_references(in.job, [&](std::size_t i) -> std::optional<Reason> {
    const FitResult& fit = in.job.fits[i];
    if (fit.status == FitStatus::converged) return {};
    Reason reason{ReasonCode::fit_failed,
                  {i},
                  {},
                  {{"status", to_string(fit.status)}, {"message", fit.message}}};
    if (fit.status == FitStatus::implausible)
      reason.code = ReasonCode::fit_implausible;
    else
      reason.names.push_back({"turns", turns_text(in.job.streams[i])});
    return reason;
  });
}

Reasons find_actuator(const CheckInput& in) {
  if (!in.job.correction || in.job.correction->margin.follows) return {};
  const ActuatorMargin& margin = in.job.correction->margin;
  return {{ReasonCode::actuator_cannot_follow, {}, {}, {}, margin.breaks, margin.remedies},
          expected_cut(in.job, in.cut)};
}

Reasons find_rows_read(const CheckInput& in) {
  const Correction& correction = *in.job.correction;
  if (correction.tool.interpolation != Interpolation::not_stated) return {};
  const double tolerance_mm = *in.job.job.coaxiality_tolerance_mm;
  const double axis_mm =
      in.cut.upper_mm - std::ranges::max(in.cut.files, {}, &CutFile::adds_mm).adds_mm;
  const double held_mm = axis_mm + table_file(correction, Interpolation::none).adds_mm;
  if (held_mm <= tolerance_mm) return {};
  Reason reason{ReasonCode::interpolation_not_stated,
                {},
                {{"tolerance", tolerance_mm, "mm"}, {"held", held_mm, "mm"}},
                {},
                {expected_cut(in.job, in.cut)},
                {{ReasonCode::set_interpolation}}};
  const double once_mm = 0.5 * (tolerance_mm - axis_mm) - correction.margin.following_once_mm;
  const int rows =
      once_mm > 0.0 ? rows_that_would_do(correction, Interpolation::none, {2.0 * once_mm, once_mm})
                    : 0;
  if (rows > 0)
    reason.remedies.push_back({ReasonCode::set_rows, {}, {{"rows", static_cast<double>(rows)}}});
  return {reason};
}

Reasons find_no_uncertainty(const CheckInput& in) {
  if (!in.job.correction || std::isfinite(in.cut.upper_mm)) return {};
  return {{ReasonCode::no_uncertainty}};
}

Reasons find_refused_motion(const CheckInput& in) {
  if (!in.job.correction) return {};
  for (const Inclusion& one : in.job.inclusions)
    if (one.refused)
      return {{ReasonCode::motion_refused,
               {},
               {},
               {{"effect", one.effect}, {"reference", one.reference}},
               {one.why.value_or(Reason{})}}};
  return {};
}

Reasons find_refutation(const CheckInput& in) {
  return first_of_references(in.job, [&](std::size_t i) -> std::optional<Reason> {
    if (i >= in.job.resimulations.size()) return {};
    const auto& again = in.job.resimulations[i];
    if (!again || !again->why_not.empty() || !refuted(again->comparison)) return {};
    // Without a cause the two simulations differ by the average of the axis alone.
    const Diagnosis& diagnosis = *in.job.diagnoses[i];
    if (diagnosis.findings.empty() && diagnosis.unexplained.empty()) return {};
    const NextMeasurement& next = diagnosis.next;
    const Comparison& c = again->comparison;
    const bool asked = !next.plan.empty() && !next.what.empty();
    return Reason{ReasonCode::not_reproduced,
                  {i},
                  {{"after", c.after.rms_mm, "mm"},
                   {"share", c.after.share},
                   {"before", c.before.rms_mm, "mm"}},
                  {},
                  {},
                  {asked ? measure(next) : Reason{ReasonCode::probe_again}}};
  });
}

}  // namespace

constinit const JobCheck fits_converged{
    "fits_converged", CheckedAt::references, Weight::forbids, {}, find_failed_fit};
constinit const JobCheck actuator_follows{
    "actuator_follows", CheckedAt::cut, Weight::forbids, {}, find_actuator};
constinit const JobCheck rows_read{
    "rows_read", CheckedAt::tolerance, Weight::leaves_open, {}, find_rows_read};
constinit const JobCheck uncertainty_known{
    "uncertainty_known", CheckedAt::cut, Weight::forbids, {}, find_no_uncertainty};
constexpr Threshold of_motions[] = {
    {"probability", nonconformity_risk, "1", "what is copied by mistake a go may be wrong by"}};
constinit const JobCheck motions_allowed{"motions_allowed", CheckedAt::cut, Weight::forbids,
                                         of_motions, find_refused_motion};
constinit const JobCheck findings_reproduced{
    "findings_reproduced", CheckedAt::cut, Weight::forbids, {}, find_refutation};

Reason expected_cut(const PlannedJob& job, const CutNumbers& cut) {
  const Reason with = cut.files.size() < 2
                          ? Reason{ReasonCode::with_the_table}
                          : Reason{ReasonCode::with_files,
                                   {},
                                   {},
                                   {{"files", names_of(cut.files)}, {"worst", cut.file}}};
  return {job.job.target->kind == TargetKind::face ? ReasonCode::run_out_expected
                                                   : ReasonCode::coaxiality_expected,
          {},
          {{"at_most", cut.upper_mm, "mm"},
           {"without", cut.coaxiality_before_mm, "mm"},
           {"risk", nonconformity_risk}},
          {},
          {with}};
}

}  // namespace trueaxis

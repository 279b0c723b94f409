// SPDX-License-Identifier: Apache-2.0
#include "job/doubts.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <limits>
#include <optional>
#include <variant>

#include "base/angle.hpp"
#include "fit/moved.hpp"
#include "job/slip.hpp"
#include "math/statistics.hpp"
#include "measure/angles_alike.hpp"
#include "measure/column_checks.hpp"
#include "measure/passes.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

constexpr Threshold much_left{"left", 1.5, "of the noise",
                              "5/9 of the sum of squares is not noise"};
constexpr Threshold too_little{"left", 1e-4, "mm", "the last digit of a stream makes as much"};
constexpr Threshold far_jump{"jump", 8.0, "σ of the difference of neighbours",
                             "no noise, however slow, goes so far from one reading to the next"};
constexpr Threshold jump_among{"among", 200, "readings",
                               "fewer do not show how far neighbours usually differ"};
constexpr Threshold least_beats{"beats", 3.0, "turns over a pass",
                                "a line that beats less with the spindle is one with the axis"};
constexpr Threshold least_beside{"beside", 0.7, "of a line",
                                 "1 - 3/π², of a line that beats once along the sections"};
constexpr Threshold enough_angles{"angles", least_angles, "1",
                                  "six take five lobes, the commonest of ground parts, for an "
                                  "eccentricity"};
constexpr Threshold angles_apart{"apart", rad_per_deg, "rad", "angles nearer than that are one"};

/// Cycles per revolution of a term at the speed and feed of a pass; none: it is not a wave.
std::optional<double> order_in(const TermValue& term, const Pass& pass) {
  const double turns_per_s = std::abs(pass.speed_rad_per_s) / two_pi;
  const double feed_mm = pass.feed_mm_per_rev * pass.c_sign;
  const auto of = [&](double turns, double per_mm, double hz) {
    return std::abs(turns - per_mm * feed_mm - (turns_per_s > 0.0 ? hz / turns_per_s : 0.0));
  };
  if (!term.effect) {
    const Pattern& p = term.pattern;
    if (p.kind == Pattern::Kind::bump) return {};
    if (p.kind == Pattern::Kind::fourier_legendre) return p.order;
    return of(p.order, p.in_time ? 0.0 : p.frequency, p.in_time ? p.frequency : 0.0);
  }
  if (!term.effect->line) return {};
  if (const auto* wave = std::get_if<PeriodicInZ>(&term.effect->term))
    return of(wave->turns, 1.0 / term.shape.period_mm, 0.0);
  if (std::holds_alternative<PeriodicInTime>(term.effect->term))
    return of(0.0, 0.0, term.shape.frequency_hz);
  if (std::holds_alternative<Harmonic>(term.effect->term)) return term.shape.order;
  return {};
}

/// Whether it is the same all round the part, such as a waviness: however long, it moves no axis.
bool is_round(const TermValue& term) {
  const auto* wave = term.effect ? std::get_if<PeriodicInZ>(&term.effect->term) : nullptr;
  return wave != nullptr && wave->turns == 0.0;
}

/// The share of a vibration, as the sections of a part meet it, that no straight axis takes in.
double beside_axis(const ProbeStream& stream, double frequency_hz) {
  const auto n = static_cast<double>(stream.size());
  double middle = 0.0, squares = 0.0;
  for (const double z : stream.position_mm) middle += z / n;
  std::complex<double> mean = 0.0, slope = 0.0;
  for (std::size_t i = 0; i < stream.size(); ++i) {
    const auto off = std::polar(1.0, two_pi * frequency_hz * stream.time_s[i] - stream.c_rad[i]);
    const double z = stream.position_mm[i] - middle;
    mean += off / n, slope += z * off / n, squares += z * z / n;
  }
  return 1.0 - std::norm(mean) - (squares > 0.0 ? std::norm(slope) / squares : 0.0);
}

/// Whether Z stands still in every pass while it is read.
bool is_sections(const ProbeStream& stream, const std::vector<Pass>& passes) {
  return stream.has_position() && !stream.time_s.empty() && !passes.empty() &&
         std::ranges::all_of(passes, [](const Pass& pass) { return pass.feed_sign == 0; });
}

/// Whether a term goes with the eccentricity in every pass: it then beats with it so slowly that
/// the axis takes its amplitude in. So does a line that turns so slowly that it stands for other
/// slow forms. Without passes, a pattern of one undulation alone does.
bool goes_with_axis(const TermValue& term, const ProbeStream& stream,
                    const std::vector<Pass>& passes) {
  if (term.effect && std::holds_alternative<PeriodicInTime>(term.effect->term) &&
      is_sections(stream, passes))
    return beside_axis(stream, term.shape.frequency_hz) < least_beside.value;
  if (passes.empty()) return !term.effect && term.pattern.order == 1.0;
  bool turns = false;
  for (const Pass& pass : passes) {
    if (pass.c_sign == 0 || pass.readings_per_revolution <= 0.0) continue;
    const auto order = order_in(term, pass);
    const double turned = static_cast<double>(pass.end - pass.begin) / pass.readings_per_revolution;
    const bool line = term.effect || term.pattern.kind == Pattern::Kind::line;
    const bool slow = line && !is_round(term) && order && *order * turned <= least_beats.value;
    if (!order || (!slow && std::abs(*order - 1.0) * turned > least_beats.value)) return false;
    turns = true;
  }
  return turns;
}

/// What went with the axis, were it measured again.
Reasons next_of(const Diagnosis& diagnosis) {
  if (diagnosis.next.what.empty()) return {{ReasonCode::probe_at_other_speed}};
  return {measure(diagnosis.next)};
}

/// Angles at which a stream was read, each `angles_apart` from the next; `most`: as many or more.
std::size_t few_places(const ProbeStream& stream, std::size_t most) {
  std::vector<double> places;
  for (const double c : stream.c_rad) {
    const bool known = std::ranges::any_of(
        places, [&](double place) { return apart_rad(c, place) < angles_apart.value; });
    if (!known) places.push_back(c);
    if (places.size() >= most) break;
  }
  return places.size();
}

std::optional<Reason> left_unexplained_of(const ProbeStream&, const Diagnosis& diagnosis) {
  const NoiseReport& noise = diagnosis.noise;
  const double left_mm = diagnosis.gain.rms_after_mm;
  const double most_mm = much_left.value * (noise.sigma_mm + 2.0 * noise.u_sigma_mm);
  if (!(left_mm > std::max(most_mm, too_little.value))) return {};
  return Reason{ReasonCode::left_unexplained,
                {},
                {{"left", left_mm, "mm"}, {"noise", noise.sigma_mm, "mm"}},
                {{"source", to_string(noise.source)}}};
}

std::optional<Reason> moves_with_axis_of(const ProbeStream& stream, const Diagnosis& diagnosis) {
  const std::vector<Pass> passes = stream.size() > 0 ? find_passes(stream) : std::vector<Pass>{};
  for (const Unexplained& u : diagnosis.unexplained)
    if (goes_with_axis(u.term, stream, passes))
      return Reason{ReasonCode::pattern_with_axis,
                    {},
                    {{"amplitude", u.amplitude.value, "mm"}},
                    {},
                    {},
                    next_of(diagnosis)};
  for (const Finding& f : diagnosis.findings)
    if (goes_with_axis(f.term, stream, passes))
      return Reason{ReasonCode::finding_with_axis, {}, {{"turns", least_beats.value}},
                    {{"effect", f.effect()}},      {}, next_of(diagnosis)};
  return {};
}

/// Residuals of the readings that count; NaN: one that does not.
std::vector<double> left_of(const Diagnosis& diagnosis) {
  std::vector<double> left_mm = diagnosis.residual_after_mm;
  for (const Rejected& outlier : diagnosis.noise.masked)
    if (outlier.row >= 1 && outlier.row <= left_mm.size())
      left_mm[outlier.row - 1] = std::numeric_limits<double>::quiet_NaN();
  return left_mm;
}

/// Whether the residual stays at another level after a jump, as at an edge: the medians of three
/// differ by half of it. A spike comes back.
bool is_edge(std::span<const double> left_mm, const Jump& jump) {
  std::vector<double> before, after;
  for (std::size_t i = jump.after; i-- > 0 && before.size() < 3;)
    if (std::isfinite(left_mm[i])) before.push_back(left_mm[i]);
  for (std::size_t i = jump.after; i < left_mm.size() && after.size() < 3; ++i)
    if (std::isfinite(left_mm[i])) after.push_back(left_mm[i]);
  return std::abs(median(std::move(after)) - median(std::move(before))) > 0.5 * std::abs(jump.size);
}

std::optional<Reason> jump_left_of(const ProbeStream&, const Diagnosis& diagnosis) {
  if (diagnosis.residual_after_mm.size() < static_cast<std::size_t>(jump_among.value)) return {};
  const std::vector<double> left_mm = left_of(diagnosis);
  const auto jump = largest_jump(left_mm, far_jump.value);
  if (!jump || std::abs(jump->size) <= U_of_axis_mm(diagnosis.extended) || !is_edge(left_mm, *jump))
    return {};
  return Reason{ReasonCode::jump_left,
                {},
                {{"size", std::abs(jump->size), "mm"},
                 {"times", std::abs(jump->size) / jump->usual},
                 {"row", static_cast<double>(jump->after + 1)}}};
}

std::optional<Reason> moved_in_pass_of(const ProbeStream& stream, const Diagnosis& diagnosis) {
  return moved_reason(stream, left_of(diagnosis), diagnosis.extended);
}

std::optional<Reason> slip_unsure_of(const ProbeStream&, const Diagnosis& diagnosis) {
  if (!is_likely_slip(diagnosis) || leaves_axis_known(diagnosis)) return {};
  return Reason{ReasonCode::slip_unsure};
}

std::optional<Reason> late_or_slipped_of(const ProbeStream&, const Diagnosis& diagnosis) {
  if (!diagnosis.late_s) return {};
  Reason reason{ReasonCode::late_or_slipped};
  if (std::isfinite(*diagnosis.late_s)) reason.numbers.push_back({"delay", *diagnosis.late_s, "s"});
  return reason;
}

std::optional<Reason> statement_refuted_of(const ProbeStream&, const Diagnosis& diagnosis) {
  for (const RefutedStatement& one : diagnosis.refuted) {
    const InfluenceInfo& info = info_of(one.stated.kind);
    const char* unit = info.unit.data();
    return Reason{ReasonCode::statement_refuted,
                  {},
                  {{"stated", one.stated.value, unit, 2.0 * one.stated.u},
                   {"seen", one.seen.value, unit, 2.0 * one.seen.u}},
                  {{"key", std::string(info.stated)}}};
  }
  return {};
}

std::optional<Reason> few_angles_in(const ProbeStream& stream, const Diagnosis&) {
  return few_angles_of(stream);
}

std::optional<Reason> sensor_limit_in(const ProbeStream& stream, const Diagnosis&) {
  return sensor_limit_of(stream);
}

constexpr Threshold of_left[] = {much_left, too_little};
constexpr Threshold of_jump[] = {far_jump, jump_among};
constexpr Threshold of_beats[] = {least_beats, least_beside};
constexpr Threshold of_angles[] = {enough_angles, angles_apart};
constexpr Threshold of_limit[] = {
    {"at_limit", few_at_a_limit, "readings", "noise puts one or two at an extreme"},
    {"at_limit", more_at_a_limit, "of the readings of any value",
     "the extreme of a rounded stream has fewer readings than its other values"}};
constexpr Threshold of_move[] = {{"moved", 1.0, "of U", "what is less is within it"}};

constexpr Threshold of_statement[] = {{"off", refuted_by, "of its u and that of what is seen",
                                       "1 of 1000 that are right are beyond"}};
constinit const AxisDoubt statement_refuted{"statement_refuted", of_statement,
                                            statement_refuted_of};
constinit const AxisDoubt late_or_slipped{"late_or_slipped", {}, late_or_slipped_of};
constinit const AxisDoubt slip_unsure{"slip_unsure", {}, slip_unsure_of};
constinit const AxisDoubt moves_in_pass{"moves_in_pass", of_move, moved_in_pass_of};
constinit const AxisDoubt moves_with_axis{"moves_with_axis", of_beats, moves_with_axis_of};
constinit const AxisDoubt few_angles{"few_angles", of_angles, few_angles_in};
constinit const AxisDoubt sensor_at_limit{"sensor_at_limit", of_limit, sensor_limit_in};

Reasons find_axis_unknown(const CheckInput& in) {
  return first_diagnosed(in.job, [&](std::size_t i) {
    return why_axis_unknown(in.job.streams.at(i), *in.job.diagnoses[i]);
  });
}

}  // namespace

constinit const AxisDoubt left_unexplained{"left_unexplained", of_left, left_unexplained_of};
constinit const AxisDoubt jump_left{"jump_left", of_jump, jump_left_of};

constinit const JobCheck axis_known{
    "axis_known", CheckedAt::references, Weight::leaves_open, {}, find_axis_unknown};

std::span<const AxisDoubt* const> axis_doubts() {
  static constexpr std::array all{&statement_refuted,  &late_or_slipped,    &slip_unsure,
                                  &left_out_at_an_end, &far_off_at_the_end, &moves_in_pass,
                                  &left_unexplained,   &jump_left,          &moves_with_axis,
                                  &few_angles,         &sensor_at_limit,    &gauge_inverted};
  return all;
}

Reason measure(const NextMeasurement& next) {
  return {ReasonCode::measure, {}, {}, {{"plan", next.plan}, {"what", next.what}}};
}

std::optional<Reason> few_angles_of(const ProbeStream& stream) {
  if (stream.kind == StreamKind::face) return {};
  const auto enough = static_cast<std::size_t>(least_angles);
  std::size_t angles = few_places(stream, enough);
  if (const auto alike = angles_alike(stream))
    angles = std::min(angles, static_cast<std::size_t>(*alike));
  if (angles >= enough) return {};
  const auto count = static_cast<double>(angles);
  return Reason{ReasonCode::few_angles,
                {},
                {{"angles", count}, {"lobes", count - 1.0}, {"enough", enough_angles.value}}};
}

std::optional<Reason> moved_reason(const ProbeStream& stream, std::span<const double> left_mm,
                                   const FitResult& fit) {
  const auto step = moved_in_pass(stream, left_mm, fit);
  if (!step) return {};
  return Reason{ReasonCode::moved_in_pass,
                {},
                {{"size", step->size_mm, "mm"}, {"row", static_cast<double>(step->reading + 1)}},
                {{"text", moved_text(*step)}}};
}

std::optional<Reason> sensor_limit_of(const ProbeStream& stream) {
  const LimitsMet met = limits_met(stream);
  if (!stream.x_convention || !met.saturates) return {};
  const bool high = met.at_high >= met.at_low;
  return Reason{ReasonCode::sensor_at_limit,
                {},
                {{"count", static_cast<double>(high ? met.at_high : met.at_low)},
                 {"limit", high ? met.high_mm : met.low_mm, "mm"}}};
}

std::optional<Reason> why_axis_unknown(const ProbeStream& stream, const Diagnosis& diagnosis) {
  for (const AxisDoubt* doubt : axis_doubts())
    if (auto why = (*doubt)(stream, diagnosis)) return why;
  return {};
}

void withhold_axis(FitResult& fit, const std::string& why) {
  for (auto* parameters : {&fit.parameters, &fit.derived}) {
    for (auto& [name, estimate] : *parameters) {
      if (name == "half_angle" || name.starts_with("radius")) continue;
      estimate = {.unit = estimate.unit, .why_not = why};
    }
  }
}

void withhold_axis(Diagnosis& diagnosis, const std::string& why) {
  for (FitResult* fit : {&diagnosis.baseline, &diagnosis.named, &diagnosis.extended})
    withhold_axis(*fit, why);
}

const NextMeasurement* next_measurement(const JobResult& result) {
  if (std::ranges::find(result.verdict.reasons, ReasonCode::part_slipped, &Reason::code) !=
      result.verdict.reasons.end())
    return nullptr;
  const auto gain = [](const NextMeasurement& next) {
    return next.power_after - next.power_before;
  };
  const NextMeasurement* best = nullptr;
  for (const auto& diagnosis : result.diagnoses) {
    if (!diagnosis || diagnosis->next.plan.empty() ||
        (diagnosis->findings.empty() && diagnosis->unexplained.empty()))
      continue;
    if (best == nullptr || gain(diagnosis->next) > gain(*best)) best = &diagnosis->next;
  }
  return best;
}

}  // namespace trueaxis

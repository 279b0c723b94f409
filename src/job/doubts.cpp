// SPDX-License-Identifier: Apache-2.0
#include "job/doubts.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <variant>

#include "job/slip.hpp"
#include "measure/passes.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

constexpr Threshold much_left{"left", 1.5, "of the noise",
                              "5/9 of the sum of squares are no noise"};
constexpr Threshold too_little{"left", 1e-4, "mm", "the last digit of a stream makes as much"};
constexpr Threshold least_beats{"beats", 3.0, "turns over a pass",
                                "a line that beats less with the spindle is one with the axis"};
constexpr Threshold most_angles{"angles", 5.0, "1",
                                "n of them do not tell n - 1 lobes from an eccentricity"};
constexpr Threshold angles_apart{"apart", rad_per_deg, "rad", "angles nearer than that are one"};

/// Cycles per revolution of a term at the speed and feed of a pass; none: it is no wave.
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

/// Whether a term goes with the eccentricity in every pass: it then beats with it so slowly that
/// the axis takes its amplitude in. So does a line that turns so slowly that it stands for other
/// slow forms. Without passes, a pattern of one undulation alone does.
bool goes_with_axis(const TermValue& term, const std::vector<Pass>& passes) {
  if (passes.empty()) return !term.effect && term.pattern.order == 1.0;
  bool turns = false;
  for (const Pass& pass : passes) {
    if (pass.c_sign == 0 || pass.readings_per_revolution <= 0.0) continue;
    const auto order = order_in(term, pass);
    const double turned = static_cast<double>(pass.end - pass.begin) / pass.readings_per_revolution;
    const bool line = term.effect || term.pattern.kind == Pattern::Kind::line;
    const bool slow = line && order && *order * turned <= least_beats.value;
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

std::optional<Reason> left_unexplained_of(const Diagnosis& diagnosis) {
  const NoiseReport& noise = diagnosis.noise;
  const double left_mm = diagnosis.gain.rms_after_mm;
  const double most_mm = much_left.value * (noise.sigma_mm + 2.0 * noise.u_sigma_mm);
  if (!(left_mm > std::max(most_mm, too_little.value))) return {};
  return Reason{ReasonCode::left_unexplained,
                {},
                {{"left", left_mm, "mm"}, {"noise", noise.sigma_mm, "mm"}},
                {{"source", noise.source}}};
}

std::optional<Reason> moves_with_axis_of(const ProbeStream& stream, const Diagnosis& diagnosis) {
  const std::vector<Pass> passes = stream.size() > 0 ? find_passes(stream) : std::vector<Pass>{};
  for (const Unexplained& u : diagnosis.unexplained)
    if (goes_with_axis(u.term, passes))
      return Reason{ReasonCode::pattern_with_axis,
                    {},
                    {{"amplitude", u.amplitude.value, "mm"}},
                    {},
                    {},
                    next_of(diagnosis)};
  for (const Finding& f : diagnosis.findings)
    if (goes_with_axis(f.term, passes))
      return Reason{ReasonCode::finding_with_axis, {}, {{"turns", least_beats.value}},
                    {{"effect", f.effect()}},      {}, next_of(diagnosis)};
  return {};
}

std::optional<Reason> few_angles_of(const ProbeStream& stream) {
  if (stream.kind == StreamKind::face) return {};
  std::vector<double> angles;
  for (const double c : stream.c_rad) {
    const bool known = std::ranges::any_of(angles, [&](double angle) {
      return std::abs(std::remainder(c - angle, two_pi)) < angles_apart.value;
    });
    if (!known) angles.push_back(c);
    if (static_cast<double>(angles.size()) > most_angles.value) return {};
  }
  const auto count = static_cast<double>(angles.size());
  return Reason{ReasonCode::few_angles, {}, {{"angles", count}, {"lobes", count - 1.0}}};
}

Reasons find_left_unexplained(const CheckInput& in) {
  return first_diagnosed(in.job,
                         [&](std::size_t i) { return left_unexplained_of(*in.job.diagnoses[i]); });
}

Reasons find_moves_with_axis(const CheckInput& in) {
  return first_diagnosed(in.job, [&](std::size_t i) {
    return moves_with_axis_of(in.job.streams.at(i), *in.job.diagnoses[i]);
  });
}

Reasons find_few_angles(const CheckInput& in) {
  return first_diagnosed(in.job,
                         [&](std::size_t i) { return few_angles_of(in.job.streams.at(i)); });
}

constexpr Threshold of_left[] = {much_left, too_little};
constexpr Threshold of_beats[] = {least_beats};
constexpr Threshold of_angles[] = {most_angles, angles_apart};

}  // namespace

constinit const JobCheck left_unexplained{"left_unexplained", CheckedAt::references,
                                          Weight::leaves_open, of_left, find_left_unexplained};
constinit const JobCheck moves_with_axis{"moves_with_axis", CheckedAt::references,
                                         Weight::leaves_open, of_beats, find_moves_with_axis};
constinit const JobCheck few_angles{"few_angles", CheckedAt::references, Weight::leaves_open,
                                    of_angles, find_few_angles};

Reason measure(const NextMeasurement& next) {
  return {ReasonCode::measure, {}, {}, {{"plan", next.plan}, {"what", next.what}}};
}

std::optional<Reason> why_axis_unknown(const ProbeStream& stream, const Diagnosis& diagnosis) {
  if (diagnosis.slip() && !is_sure_slip(diagnosis)) return Reason{ReasonCode::slip_unsure};
  std::optional<Reason> why = moves_with_axis_of(stream, diagnosis);
  return why ? why : left_unexplained_of(diagnosis);
}

void withhold_axis(FitResult& fit, const std::string& why) {
  for (auto* parameters : {&fit.parameters, &fit.derived}) {
    for (auto& [name, estimate] : *parameters) {
      if (name == "half_angle" || name.starts_with("radius")) continue;
      estimate = {.unit = estimate.unit, .why_not = why};
    }
  }
}

}  // namespace trueaxis

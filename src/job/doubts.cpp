// SPDX-License-Identifier: Apache-2.0
#include "job/doubts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <variant>

#include "measure/passes.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

constexpr double least_beats = 1.5;  // of a line with the spindle, over a pass

std::string where(const JobResult& result, std::size_t i) {
  const std::string& name = result.job.references[i].name;
  return name.empty() ? "" : name + ": ";
}

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
    const bool slow = line && order && *order * turned <= least_beats;
    if (!order || (!slow && std::abs(*order - 1.0) * turned > least_beats)) return false;
    turns = true;
  }
  return turns;
}

/// What of a diagnosis is not settled; empty: every cause has its name.
std::string open_causes(const Diagnosis& diagnosis) {
  std::string text;
  for (const Finding& finding : diagnosis.findings) {
    if (finding.rivals.empty() || finding.cosmetic) continue;
    text += (text.empty() ? "" : ", ") + finding.effect() + " may be " + finding.rivals[0].effect;
  }
  if (!diagnosis.unexplained.empty())
    text += (text.empty() ? "" : ", ") + std::string("a pattern has no known cause");
  return text;
}

}  // namespace

std::vector<OpenAxis> open_axes(const JobResult& result) {
  std::vector<OpenAxis> list;
  for (std::size_t i = 0; i < result.diagnoses.size(); ++i) {
    if (!result.diagnoses[i] || !result.job.target) continue;
    const FitResult& used = fit_used(result, i);
    const std::string open = open_causes(*result.diagnoses[i]);
    if (&used == &result.fits[i] || open.empty()) continue;
    double moved_mm = 0.0, U_mm = 0.0;
    for (const double z_mm : {result.job.target->z_start_mm, result.job.target->z_end_mm}) {
      const auto [x, y] = used.axis.axis.at(z_mm);
      const auto [x_ideal, y_ideal] = result.fits[i].axis.axis.at(z_mm);
      moved_mm = std::max(moved_mm, std::hypot(x - x_ideal, y - y_ideal));
      U_mm = std::max(U_mm, used.coverage_factor * used.axis.u_at(z_mm));
    }
    if (moved_mm <= U_mm) continue;
    list.push_back(
        {i, fmt::format("{}the diagnosis moved the axis by {:.2g} µm (U = {:.2g} µm), and {}",
                        where(result, i), moved_mm / mm_per_um, U_mm / mm_per_um, open)});
  }
  return list;
}

std::string moves_with_axis(const JobResult& result) {
  for (std::size_t i = 0; i < result.diagnoses.size(); ++i) {
    if (!result.diagnoses[i]) continue;
    const Diagnosis& diagnosis = *result.diagnoses[i];
    const std::vector<Pass> passes =
        result.streams.at(i).size() > 0 ? find_passes(result.streams[i]) : std::vector<Pass>{};
    const std::string next = diagnosis.next.what.empty()
                                 ? "probe again at another speed and another feed"
                                 : diagnosis.next.what;
    for (const Unexplained& u : diagnosis.unexplained) {
      if (!goes_with_axis(u.term, passes)) continue;
      return fmt::format(
          "{}a pattern of {:.2g} µm near one undulation per revolution has no known cause, and the "
          "axis goes with it: {}",
          where(result, i), u.amplitude.value / mm_per_um, next);
    }
    for (const Finding& f : diagnosis.findings) {
      if (!goes_with_axis(f.term, passes)) continue;
      return fmt::format(
          "{}{} turns so nearly with the part that over the stream it makes at most {:.2g} turns "
          "beside it or beside the eccentricity, and the axis goes with it: {}",
          where(result, i), f.effect(), least_beats, next);
    }
  }
  return "";
}

}  // namespace trueaxis

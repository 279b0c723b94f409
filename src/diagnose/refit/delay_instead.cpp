// SPDX-License-Identifier: Apache-2.0
#include "diagnose/refit/delay_instead.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <variant>
#include <vector>

#include "diagnose/refit/timing.hpp"
#include "diagnose/search/coarse_to_fine.hpp"
#include "infer/classes.hpp"

namespace trueaxis::diagnose_detail {
namespace {

bool moves_part(const Hypothesis& h) { return h.effect && is_step(h.effect->term); }

/// When the part slipped; NaN: it did not.
double onset_of(const std::vector<Hypothesis>& terms) {
  const auto slip = std::ranges::find_if(terms, moves_part);
  return slip == terms.end() ? std::numeric_limits<double>::quiet_NaN() : slip->shape.onset_s;
}

const Effect* find_delay(const std::vector<const Effect*>& effects) {
  const auto found = std::ranges::find_if(effects, [](const Effect* effect) {
    const auto* shift = std::get_if<ArgumentShift>(&effect->term);
    return shift && shift->by == ArgumentShift::By::delay;
  });
  return found == effects.end() ? nullptr : *found;
}

Problem with(const Problem& of, const ObservationMask& mask, const LinearisationPoint& point,
             std::span<const double> deviation_mm) {
  return {point,      mask,          of.resolution, deviation_mm,  of.false_alarm,
          of.threads, of.most_terms, of.effects,    of.rounding_mm};
}

double count_of(const std::vector<Hypothesis>& terms) {
  return static_cast<double>(columns_of(terms));
}

/// Whether the second order of what turns that far is worth a parameter (Schwarz 1978): a slip has
/// it, and the column of a delay does not.
bool bends(double turned_rad, const IdealModel& ideal, const Joint& found) {
  const LinearisationPoint& point = ideal.point;
  const Axis& axis = ideal.fit.axis.axis;
  const auto [x_mm, y_mm] = axis.at(point.z_mid_mm);
  const double runs_mm = point.base.face ? point.end_mm() * std::hypot(axis.slope_x, axis.slope_y)
                                         : std::hypot(x_mm, y_mm);
  const double second_mm = 0.5 * turned_rad * turned_rad * runs_mm;
  const auto rows = static_cast<double>(found.equations.count());
  return 0.5 * rows * std::pow(second_mm / found.sigma_mm, 2) > std::log(rows);
}

}  // namespace

std::optional<DelayInstead> delay_instead(const IdealModel& ideal, const RelinearisedFit& found) {
  const std::vector<Hypothesis>& terms = found.joint().terms;
  const Effect* delay = find_delay(ideal.problem.effects);
  const double onset_s = onset_of(terms);
  if (!delay || terms.empty() || (!ideal.point.has_time && std::isnan(onset_s))) return {};
  const TurnedPasses passes(ideal.stream, ideal.point, onset_s);
  if (passes.at_one_speed()) return {};
  DelayInstead out;
  out.delay_s = passes.best(ideal.mask);
  // Shorter ones are seen by their columns, but for a slip that turns the part farther than those
  // reach.
  const bool ordinary = std::abs(out.delay_s) <= delay->parameters.front().high;
  const bool turns =
      !std::isnan(onset_s) && bends(passes.turned_apart(out.delay_s), ideal, found.joint());
  if (ideal.point.has_time && ordinary && !turns) return {};

  const Problem& first = ideal.problem;
  const ObservationMask mask = passes.counted(ideal.mask, out.delay_s);
  const ProbeStream stream = passes.without(out.delay_s);
  FitOptions bare = ideal.fit_options;
  bare.influences.clear();
  const FitResult about = fit(stream, bare);
  if (!is_diagnosable(about)) return {};
  const LinearisationPoint point = linearise_at(stream, clampings_of(about, ideal.ball_mm),
                                                first.point.base, first.point.bore, first.threads);
  const std::vector<double> deviation_mm = deviation_from(stream, point, first.threads);
  Problem late = with(first, mask, point, deviation_mm);
  late.most_terms = std::min(late.most_terms, terms.size() + 1);  // more are not simpler
  std::vector<Hypothesis> besides = CoarseToFineSearch(late).model.terms;
  std::erase_if(besides, moves_part);

  const std::vector<double>& phi = found.joint().equations.autoregression();
  const Joint as_found(with(first, mask, found.problem().point, found.problem().deviation_mm), phi,
                       terms, terms.size());
  const Joint as_delay(late, phi, besides, besides.size());
  const double rss = as_found.solution.rss, rss_late = as_delay.solution.rss;
  const auto rows = static_cast<double>(as_found.equations.count());
  // The delay is a parameter, and so is the date of a slip (Schwarz 1978).
  const auto dates = static_cast<double>(std::ranges::count_if(terms, moves_part));
  const double worse = rows * std::log(rss_late / rss) +
                       std::log(rows) * (count_of(besides) + 1.0 - count_of(terms) - dates);
  const double probability = 1.0 / (1.0 + std::exp(0.5 * worse));
  if (!(probability >= infer::in_no_class)) return {};
  if (!ideal.point.has_time) out.delay_s = std::numeric_limits<double>::quiet_NaN();
  out.rival = {std::string(delay->id), std::sqrt(std::max(rss_late - rss, 0.0)) / as_found.sigma_mm,
               worse, probability, false};
  return out;
}

}  // namespace trueaxis::diagnose_detail

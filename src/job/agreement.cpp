// SPDX-License-Identifier: Apache-2.0
#include "job/agreement.hpp"

#include <algorithm>
#include <boost/math/tools/minima.hpp>
#include <cmath>
#include <vector>

#include "job/mistakes.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

constexpr Threshold by_chance{"p", 1e-3, "1", "of a disagreement by the noise alone"};
constexpr Threshold tried_from{"apart", 0.01, "mm", "a smaller disagreement is that of parts"};
constexpr double tilt_arm_mm = 100.0;  // at which a tilt counts as an offset
constexpr Threshold much_more_likely{"odds", 1e3, "1", "surfaces of parts are not quite coaxial"};
constexpr Threshold more_likely{"odds", 20.0, "1", "among disagreements that no part has"};
constexpr Threshold taken_to{"left", 0.2, "of the disagreement", "by a mistake that is named"};
constexpr Threshold as_likely{"odds", 10.0, "1", "another mistake is named too"};
constexpr Threshold noises_apart{"factor", 2.0, "1", "one standard deviation, for one probe"};
constexpr const char* of_one_part = "beyond it the surfaces cannot be those of one part";
constexpr Threshold no_part_apart{"apart", 0.5, "mm", of_one_part};
constexpr Threshold no_part_slope{"apart", 1e-3, "mm per mm between", of_one_part};
constexpr Threshold no_part_tilt{"tilt", 0.01, "rad", of_one_part};

double size_mm(const Disagreement& d) { return std::hypot(d.offset_mm, tilt_arm_mm * d.tilt_rad); }

bool of_no_part(const Disagreement& d) {
  return d.offset_mm - d.U_offset_mm > no_part_apart.value + no_part_slope.value * d.between_mm ||
         d.tilt_rad - d.U_tilt_rad > no_part_tilt.value;
}

/// The references that have an axis.
struct Held {
  std::vector<std::size_t> reference;
  std::vector<HeldAxis> axis;
  std::vector<double> noise_mm;
  double coverage_factor = 2.0;

  /// ln of how much likelier the noise of one among the others is, if its readings are scaled: one
  /// probe has one noise.
  double log_odds_of_noise(std::size_t at, const Mistake& mistake) const {
    double apart = 0.0;
    for (std::size_t i = 0; i < noise_mm.size(); ++i) {
      if (!(noise_mm[i] > 0.0)) return 0.0;
      if (i != at)
        apart += std::log(noise_mm[at] / noise_mm[i]) / static_cast<double>(noise_mm.size() - 1);
    }
    const double right = apart + std::log(std::abs(axis[at].plane ? mistake.z : mistake.x));
    return 0.5 * (apart * apart - right * right) / std::pow(std::log(noises_apart.value), 2);
  }

  std::vector<Disagreement> pairs() const {
    std::vector<Disagreement> list;
    for (std::size_t i = 0; i < axis.size(); ++i) {
      for (std::size_t j = i + 1; j < axis.size(); ++j) {
        list.push_back(difference_of(axis[i], axis[j], coverage_factor));
        list.back().first = reference[i], list.back().second = reference[j];
      }
    }
    std::ranges::stable_sort(list, std::ranges::greater{}, size_mm);
    return list;
  }
};

Held held_of(const IdentifiedJob& result) {
  Held held;
  held.coverage_factor = result.job.references.front().fit.coverage_factor;
  for (std::size_t i = 0; i < result.fits.size(); ++i) {
    const FitResult& fit = result.fits[i];
    if (fit.status != FitStatus::converged || fit.surface == SurfaceKind::section) continue;
    held.reference.push_back(i);
    held.axis.push_back(held_axis(fit));
    const bool diagnosed = i < result.diagnoses.size() && result.diagnoses[i];
    held.noise_mm.push_back(diagnosed ? result.diagnoses[i]->noise.sigma_mm : fit.rms_mm);
  }
  return held;
}

/// A mistake that would explain a disagreement.
struct Explanation {
  const Mistake* mistake = nullptr;
  std::size_t at = 0;     ///< place among the references held
  double number = 0.0;    ///< that it leaves open
  double log_odds = 0.0;  ///< against none
  Disagreement left;      ///< the worst pair with it
};

double likelihood_with(std::vector<HeldAxis> axes, std::size_t at, const Mistake& mistake,
                       double number, bool width) {
  axes[at] = mended(axes[at], mistake, number);
  std::optional<OpenMistake> open;
  if (width && mistake.open) open = {at, *mistake.open, number};
  return log_likelihood(axes, open) + log_shrinkage(mistake, axes[at].plane);
}

/// The open number at which the axes are most likely: the best of a ladder, refined.
double best_number(const Held& held, std::size_t at, const Mistake& mistake) {
  if (!mistake.open) return 0.0;
  const bool turn = *mistake.open == OpenNumber::c_zero;
  const double reach = turn ? 0.5 * two_pi : 500.0;
  const int steps = turn ? 36 : 50;
  const auto cost = [&](double number) {
    return -likelihood_with(held.axis, at, mistake, number, false);
  };
  double best = 0.0, least = cost(0.0);
  for (int i = -steps; i <= steps; ++i) {
    const double number = reach * i / steps, here = cost(number);
    if (here < least) least = here, best = number;
  }
  const double step = reach / steps;
  return boost::math::tools::brent_find_minima(cost, best - step, best + step, 20).first;
}

/// Whether the readings of a reference can be of a mistake at all.
bool applies(const Mistake& mistake, const HeldAxis& axis) {
  if (mistake.x == 0.5 && axis.diameter) return false;   // a diameter that was read as one
  if (mistake.x == 2.0 && !axis.diameter) return false;  // a radius likewise
  return !axis.plane || mistake.open != OpenNumber::z_zero;
}

/// Axes of one part, or of a part that was clamped anew.
double without_mistake(const Held& held) {
  return std::max(log_likelihood(held.axis), log_likelihood_clamped_anew(held.axis));
}

std::vector<Explanation> explanations(const Held& held, const Disagreement& worst) {
  const double as_is = without_mistake(held);
  std::vector<Explanation> list;
  for (std::size_t at = 0; at < held.axis.size(); ++at) {
    for (const Mistake& mistake : mistakes()) {
      if (!applies(mistake, held.axis[at])) continue;
      Explanation e{&mistake, at, best_number(held, at, mistake), 0.0, {}};
      e.log_odds = likelihood_with(held.axis, at, mistake, e.number, true) - as_is +
                   held.log_odds_of_noise(at, mistake);
      Held right = held;
      right.axis[at] = mended(held.axis[at], mistake, e.number);
      e.left = right.pairs().front();
      if (size_mm(e.left) <= taken_to.value * size_mm(worst) ||
          held.log_odds_of_noise(at, mistake) > std::log(much_more_likely.value))
        list.push_back(e);
    }
  }
  std::ranges::stable_sort(list, std::ranges::greater{}, &Explanation::log_odds);
  return list;
}

/// The same by a fit of the readings as they should have been read; false: it does not fit them.
bool holds_on_data(const IdentifiedJob& result, const Held& held, Explanation& e) {
  const std::size_t i = held.reference[e.at];
  const FitResult again =
      fit(mended(result.streams[i], *e.mistake, e.number), result.job.references[i].fit);
  const bool face = result.streams[i].kind == StreamKind::face;
  const double scale = std::abs(face ? e.mistake->z : e.mistake->x);
  if (again.status != FitStatus::converged ||
      again.rms_mm > 1.2 * scale * result.fits[i].rms_mm + 1e-6)
    return false;
  Held right = held;
  right.axis[e.at] = held_axis(again);
  e.left = right.pairs().front();
  std::optional<OpenMistake> open;
  if (e.mistake->open) open = {e.at, *e.mistake->open, e.number};
  e.log_odds = log_likelihood(right.axis, open) +
               log_shrinkage(*e.mistake, right.axis[e.at].plane) - without_mistake(held) +
               held.log_odds_of_noise(e.at, *e.mistake);
  return true;
}

/// The numbers of a disagreement; the offset only where both have a place.
std::vector<ReasonNumber> numbers_of(const Disagreement& d, const char* offset, const char* tilt) {
  std::vector<ReasonNumber> numbers{{tilt, d.tilt_rad, "rad", d.U_tilt_rad}};
  if (d.offset_mm != 0.0 || d.U_offset_mm != 0.0)
    numbers.push_back({offset, d.offset_mm, "mm", d.U_offset_mm});
  return numbers;
}

Reason apart(const Disagreement& d, ReasonCode code) {
  Reason reason{code, {d.first, d.second}, numbers_of(d, "offset", "tilt")};
  if (d.U_offset_mm > 0.0) reason.numbers.push_back({"U_offset", d.U_offset_mm, "mm"});
  return reason;
}

Reason said(const Held& held, const Explanation& e) {
  Reason reason{e.mistake->what, {held.reference[e.at]}, {}, e.mistake->of};
  if (e.mistake->open)
    reason.numbers = {{"to_add", e.number, *e.mistake->open == OpenNumber::c_zero ? "rad" : "mm"}};
  return reason;
}

/// The most likely mistake, and what is nearly as likely.
void name_mistake(const IdentifiedJob& result, const Held& held, const Disagreement& worst,
                  Agreement& out) {
  const double least = of_no_part(worst) ? more_likely.value : much_more_likely.value;
  std::vector<Explanation> likely = explanations(held, worst);
  std::erase_if(likely, [&](Explanation& e) {
    return e.log_odds < std::log(least) || !holds_on_data(result, held, e) ||
           e.log_odds < std::log(least);
  });
  if (likely.empty()) return;
  std::ranges::stable_sort(likely, std::ranges::greater{}, &Explanation::log_odds);
  const Explanation& best = likely.front();
  Reason reason = apart(worst, ReasonCode::streams_misread);
  for (const ReasonNumber& left : numbers_of(best.left, "offset_left", "tilt_left"))
    reason.numbers.push_back(left);
  for (const Explanation& e : likely) {
    if (e.log_odds < best.log_odds - std::log(as_likely.value)) break;
    if (e.mistake->open && !best.mistake->open) continue;  // what explains it needs no number
    reason.parts.push_back(said(held, e));
    reason.remedies.push_back({e.mistake->mend, {held.reference[e.at]}, {}, e.mistake->of});
  }
  out.odds = std::exp(std::min(best.log_odds, 600.0));
  out.reason = std::move(reason);
}

/// Whether all readings are of one file, whose signs, units and zeros are those of all.
bool of_one_file(const IdentifiedJob& result) {
  return std::ranges::all_of(result.streams, [&](const ProbeStream& stream) {
    return !stream.input_hash.empty() && stream.input_hash == result.streams.front().input_hash;
  });
}

void hold_axes(const IdentifiedJob& result, Agreement& out) {
  const Held held = held_of(result);
  if (held.axis.size() < 2) return;
  out.disagreements = held.pairs();
  std::erase_if(out.disagreements,
                [](const Disagreement& d) { return d.p_value >= by_chance.value; });
  if (out.disagreements.empty() || size_mm(out.disagreements.front()) < tried_from.value ||
      of_one_file(result))
    return;
  const Disagreement& worst = out.disagreements.front();
  name_mistake(result, held, worst, out);
  if (!out.reason && of_no_part(worst)) out.reason = apart(worst, ReasonCode::axes_of_no_part);
}

Reasons find_disagreement(const CheckInput& in) {
  const auto& reason = in.job.agreement.reason;
  return reason ? Reasons{*reason} : Reasons{};
}

constexpr Threshold of_agreement[] = {by_chance,    tried_from,       much_more_likely,
                                      more_likely,  taken_to,         as_likely,
                                      noises_apart, no_part_apart,    no_part_slope,
                                      no_part_tilt, exchanged_better, exchanged_as_good};

}  // namespace

constinit const JobCheck references_agree{"references_agree", CheckedAt::references,
                                          Weight::forbids, of_agreement, find_disagreement};

Reason how_apart(const Disagreement& disagreement) {
  return apart(disagreement, ReasonCode::axes_apart);
}

Agreement hold_together(const IdentifiedJob& result) {
  Agreement out;
  if (!of_one_file(result)) out.reason = exchanged_streams(result);
  if (!out.reason) hold_axes(result, out);
  return out;
}

}  // namespace trueaxis

// SPDX-License-Identifier: Apache-2.0
#include "job/doubts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <variant>

#include "fit/moved.hpp"
#include "job/ends_of_stream.hpp"
#include "job/references.hpp"
#include "job/slip.hpp"
#include "measure/angles_alike.hpp"
#include "measure/passes.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

constexpr double much_left = 1.5;       // of the noise: 5/9 of the sum of squares are no noise
constexpr double too_little_mm = 1e-4;  // the last digit of a stream makes as much
constexpr double least_beats = 3.0;     // of a line with the spindle, over a pass

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

/// Whether all passes that turn run at one speed and not in both directions of Z.
bool one_manner(const std::vector<Pass>& passes) {
  const Pass* first = nullptr;
  for (const Pass& p : passes) {
    if (p.c_sign == 0 || p.readings_per_revolution <= 0.0) continue;
    if (!first) first = &p;
    const double apart = std::abs(p.speed_rad_per_s - first->speed_rad_per_s);
    if (apart > 0.01 * std::abs(first->speed_rad_per_s) || p.feed_sign != first->feed_sign)
      return false;
  }
  return true;
}

bool is_bow(const Finding& finding) {
  const auto* harmonic = std::get_if<Harmonic>(&finding.term.effect->term);
  return harmonic && harmonic->fixed_order == 1.0 &&
         harmonic->envelope == Harmonic::Envelope::parabola;
}

/// Angles at which a stream was read, to 1°; `most`: as many or more.
int few_places(const ProbeStream& stream, int most) {
  std::vector<double> places;
  for (const double c : stream.c_rad) {
    const bool known = std::ranges::any_of(places, [&](double place) {
      return std::abs(std::remainder(c - place, two_pi)) < rad_per_deg;
    });
    if (!known) places.push_back(c);
    if (static_cast<int>(places.size()) >= most) break;
  }
  return static_cast<int>(places.size());
}

}  // namespace

std::string left_unnamed(const Diagnosis& diagnosis) {
  const NoiseReport& noise = diagnosis.noise;
  const double left_mm = diagnosis.gain.rms_after_mm;
  const double most_mm = much_left * (noise.sigma_mm + 2.0 * noise.u_sigma_mm);
  if (!(left_mm > std::max(most_mm, too_little_mm))) return "";
  return fmt::format(
      "what was found leaves {:.2g} µm where the {} show a noise of {:.2g} µm: the readings "
      "hold "
      "something that no cause and no pattern explains, and the axis may go with it. See whether "
      "the part slipped, clamp it again and probe again",
      left_mm / mm_per_um, noise.source, noise.sigma_mm / mm_per_um);
}

std::vector<std::string> model_reservations(const JobResult& result) {
  std::vector<std::string> list;
  for (std::size_t i = 0; i < result.fits.size(); ++i) {
    if (!result.diagnoses[i]) {
      if (result.fits[i].u_factor > 1.0)
        list.push_back(of_reference(result, i) +
                       "its readings are not diagnosed, and what they leave correlates");
      continue;
    }
    const Diagnosis& diagnosis = *result.diagnoses[i];
    const double stated_mm = diagnosis.noise.stated_mm.value_or(0.0);
    const double left_mm = std::max(diagnosis.noise.sigma_mm, diagnosis.gain.rms_after_mm);
    if (stated_mm > 0.0 &&
        left_mm - stated_mm > std::max(0.5 * stated_mm, 3.0 * diagnosis.noise.u_sigma_mm)) {
      list.push_back(fmt::format(
          "{}after all that was found a reading scatters by {:.2g} µm, {:.2g} times the stated "
          "noise: the readings hold something that was not found, or the noise was stated too "
          "small",
          of_reference(result, i), left_mm / mm_per_um, left_mm / stated_mm));
    }
    const bool one_pass =
        result.streams.at(i).size() > 0 && one_manner(find_passes(result.streams[i]));
    if (one_pass && std::ranges::any_of(diagnosis.findings, is_bow))
      list.push_back(
          of_reference(result, i) +
          "a bow that was seen in one pass, or in passes alike, may as well be a vibration "
          "near the spindle's frequency, which would move the axis: a pass back at "
          "another speed tells");
  }
  return list;
}

std::vector<OpenAxis> open_axes(const JobResult& result) {
  std::vector<OpenAxis> list;
  for (std::size_t i = 0; i < result.diagnoses.size(); ++i) {
    if (!result.diagnoses[i] || !result.job.target) continue;
    const FitResult& used = fit_used(result, i);
    const std::string open = open_causes(*result.diagnoses[i]);
    if (&used == &result.fits[i] || open.empty()) continue;
    double moved_mm = 0.0, U_mm = 0.0;
    if (used.surface == SurfaceKind::plane) {  // what its tilt makes at the outer end
      const Axis &now = used.axis.axis, &ideal = result.fits[i].axis.axis;
      const double end_mm = std::max(std::abs(used.position_min_mm), used.position_max_mm);
      moved_mm = end_mm * std::hypot(now.slope_x - ideal.slope_x, now.slope_y - ideal.slope_y);
      U_mm = used.coverage_factor * end_mm * used.axis.u_slopes();
    }
    for (const double z_mm : {result.job.target->z_start_mm, result.job.target->z_end_mm}) {
      if (used.surface == SurfaceKind::plane) break;
      const auto [x, y] = used.axis.axis.at(z_mm);
      const auto [x_ideal, y_ideal] = result.fits[i].axis.axis.at(z_mm);
      moved_mm = std::max(moved_mm, std::hypot(x - x_ideal, y - y_ideal));
      U_mm = std::max(U_mm, used.coverage_factor * used.axis.u_at(z_mm));
    }
    if (moved_mm <= U_mm) continue;
    list.push_back(
        {i, fmt::format("{}the diagnosis moved the axis by {:.2g} µm (U = {:.2g} µm), and {}",
                        of_reference(result, i), moved_mm / mm_per_um, U_mm / mm_per_um, open)});
  }
  return list;
}

std::string improbable_and_far(const JobResult& result, double tolerance_mm) {
  constexpr double listed = 1e-3;  // what is less probable is in no class
  constexpr double far_out = 3.0;  // times the tolerance, which is a diameter
  for (std::size_t i = 0; i < result.diagnoses.size(); ++i) {
    if (!result.diagnoses[i]) continue;
    for (const AxisShare& share : result.diagnoses[i]->shares) {
      const double out_mm = 2.0 * share.axis_shift.value;
      if (share.probability >= listed || share.effect.empty() || share.instead_of.empty() ||
          out_mm <= far_out * tolerance_mm)
        continue;
      const Effect* effect = result.diagnoses[i]->entry(share.effect);
      if (!effect || effect->separations.empty()) continue;
      const Separation& tells = effect->separations.front();
      const auto plan =
          std::ranges::find(result.diagnoses[i]->plans, tells.code, &Separating::plan);
      return fmt::format(
          "{}{} may be {} too, improbable as its size is, and the axis were then {:.0f} µm "
          "elsewhere: measure it, or {}",
          of_reference(result, i), share.instead_of, share.effect,
          share.axis_shift.value / mm_per_um,
          plan == result.diagnoses[i]->plans.end() ? std::string(tells.how) : plan->what);
    }
  }
  return "";
}

std::string moves_with_axis(const ProbeStream& stream, const Diagnosis& diagnosis) {
  const std::vector<Pass> passes = stream.size() > 0 ? find_passes(stream) : std::vector<Pass>{};
  const std::string next = diagnosis.next.what.empty()
                               ? "probe again at another speed and another feed"
                               : diagnosis.next.what;
  for (const Unexplained& u : diagnosis.unexplained) {
    if (!goes_with_axis(u.term, passes)) continue;
    return fmt::format(
        "a pattern of {:.2g} µm near one undulation per revolution has no known cause, and the "
        "axis goes with it: {}",
        u.amplitude.value / mm_per_um, next);
  }
  for (const Finding& f : diagnosis.findings) {
    if (!goes_with_axis(f.term, passes)) continue;
    return fmt::format(
        "{} is so near to once a revolution that over the stream it gains at most {:.2g} turns "
        "on the part or its eccentricity, and cannot be told from a shift of the axis: {}",
        f.effect(), least_beats, next);
  }
  return "";
}

std::string few_angles(const ProbeStream& stream) {
  constexpr int enough = 7;  // six see five lobes as eccentricity, the commonest of ground parts
  if (stream.kind == StreamKind::face) return "";
  int angles = few_places(stream, enough);
  if (const auto alike = angles_alike(stream)) angles = std::min(angles, *alike);
  if (angles >= enough) return "";
  return fmt::format(
      "{0} angles, the same in every revolution or nearly so, cannot tell {1} lobes from an "
      "eccentricity: probe at {2} angles or more",
      angles, angles - 1, enough);
}

std::string why_axis_unknown(const ProbeStream& stream, const Diagnosis& diagnosis) {
  if (diagnosis.slip() && !is_sure_slip(diagnosis))
    return "the part slipped, and where it is now is not known";
  for (const std::string& why :
       {left_out_at_an_end(stream, diagnosis), far_off_at_the_end(diagnosis),
        moved_in_pass(stream, diagnosis.residual_after_mm, diagnosis.extended),
        left_unnamed(diagnosis), moves_with_axis(stream, diagnosis), few_angles(stream)})
    if (!why.empty()) return why;
  return "";
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

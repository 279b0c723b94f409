// SPDX-License-Identifier: Apache-2.0
#include "diagnose/search/ideal_model.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <optional>
#include <utility>

#include "base/threads.hpp"
#include "diagnose/geometry/condense.hpp"
#include "diagnose/regression/noise.hpp"
#include "diagnose/regression/outliers.hpp"
#include "diagnose/search/dictionary.hpp"
#include "diagnose/search/scan_steps.hpp"
#include "math/statistics.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis::diagnose_detail {
namespace {

constexpr int dates_to_start = 8;         // of a step, less one: every slip found with 12 was
constexpr int harmonics_of_rounding = 8;  // the others have a fifteenth of its square

LinearisationPoint about(const ProbeStream& stream, const FitResult& fit, double ball_mm,
                         int threads) {
  const std::vector<Clamping> clampings = clampings_of(fit, ball_mm);
  LinearisationPoint out =
      linearise_at(stream, clampings, base_of(stream, fit, clampings), fit.bore, threads);
  out.as_read = true;
  out.ball_radius_mm = ball_mm;
  return out;
}

int threads_of(const DiagnoseOptions& options, const ProbeStream& stream) {
  return static_cast<int>(threads_for(options.threads, stream.size()));
}

std::vector<const Effect*> causes_of(const BaseKind& base, const Resolution& resolution,
                                     std::span<const Effect> own) {
  std::vector<const Effect*> list = possible_causes(base, own);
  std::erase_if(list, [&](const Effect* e) { return e->needs.turning && resolution.sparse; });
  return list;
}

/// A step below the σ of the noise is drowned: its first harmonic keeps exp(−2π²) = 3e-9 of its
/// size.
double rounding_that_shows(double step_mm, std::span<const double> deviation_mm) {
  return step_mm > 0.0 && step_mm > mad_sigma(deviation_mm) ? step_mm : 0.0;
}

/// Readings with hardly any noise, of true values that are alike, have the same error of rounding,
/// which no repetition averages. Its variance as if each had it alone, beyond that of its own
/// (Eq. 329).
double alike_by_rounding(const Problem& problem, std::span<const double> reading_mm) {
  const double step_mm = problem.rounding_mm;
  if (!(step_mm > 0.0) || !problem.resolution.sparse) return 0.0;
  const double spread = mad_sigma(problem.deviation_mm) / step_mm;
  const double noise = std::max(spread * spread - 1.0 / 12.0, 0.0);
  const auto count = static_cast<double>(reading_mm.size());
  double sum = 0.0;
  for (int k = 1; k <= harmonics_of_rounding; ++k) {
    std::complex<double> alike = 0.0;
    for (std::size_t i = 0; i < reading_mm.size(); ++i)
      alike += std::polar(1.0, two_pi * k * (reading_mm[i] - problem.deviation_mm[i]) / step_mm);
    const double amplitude =
        2.0 * step_mm / (two_pi * k) * std::exp(-0.5 * std::pow(two_pi * k, 2) * noise);
    sum += 0.5 * amplitude * amplitude * (std::norm(alike) / count - 1.0);
  }
  return std::sqrt(std::max(sum, 0.0));
}

Problem without(const Problem& all, const ObservationMask& mask) {
  return {all.point,       mask,        all.resolution, all.deviation_mm,
          all.false_alarm, all.threads, all.most_terms, all.effects};
}

/// Steps dated among the two thirds of the readings nearest to the surface with a step there, until
/// the date is the same: from dates all over the stream, because grooves draw one that is dated in
/// all readings.
std::vector<Hypothesis> dated_about_most(const Problem& all, std::vector<Hypothesis> basis) {
  const std::span<const double> time = all.point.time;
  std::vector<Hypothesis> out;
  const auto known = [&](const Hypothesis& h) {
    return std::ranges::find(out, h.shape.onset_s,
                             [](const Hypothesis& o) { return o.shape.onset_s; }) != out.end();
  };
  double tests = 0.0;
  const auto shift_in = [&](const Problem& readings) {
    std::vector<Hypothesis> steps = scan_steps(readings, {}, basis, tests);
    return steps.empty() ? std::optional<Hypothesis>() : std::move(steps.front());
  };
  std::optional<Hypothesis> step = shift_in(all);
  for (int start = 1; step && start < dates_to_start; ++start) {
    step->shape.onset_s =
        std::lerp(time.front(), time.back(), static_cast<double>(start) / dates_to_start);
    for (int look = 0; look < 4; ++look) {
      basis.push_back(*step);
      const ObservationMask most =
          nearest_two_thirds(all.point, basis, all.deviation_mm, all.mask, all.threads);
      basis.pop_back();
      std::optional<Hypothesis> next = shift_in(without(all, most));
      if (!next || next->shape.onset_s == step->shape.onset_s) break;
      step = next;
    }
    if (!known(*step)) out.push_back(*step);
  }
  return out;
}

/// The readings that do not count. A large step leaves those about it far from any smooth
/// form. If one of the steps dated in all readings takes back more than half of them, it joins what
/// readings may deviate by.
Outliers exclude(const Problem& all) {
  std::vector<Hypothesis> basis = small_fourier_legendre_basis(all.point, all.resolution);
  Outliers out = find_outliers(all.point, basis, all.deviation_mm, all.mask, all.threads);
  if ((out.list.empty() && !out.jumps) || is_condensed(all.point)) return out;
  double tests = 0.0;
  std::size_t fewest = out.jumped ? out.list.size() * 3 / 4 : (out.list.size() + 1) / 2;
  for (const Hypothesis& step :
       out.jumped ? dated_about_most(all, basis) : scan_steps(all, {}, basis, tests)) {
    basis.push_back(step);
    Outliers own = find_outliers(all.point, basis, all.deviation_mm, all.mask, all.threads,
                                 step.shape.onset_s);
    basis.pop_back();
    const bool better = out.jumps != own.jumps ? out.jumps : own.list.size() < fewest;
    if (!better) continue;
    fewest = own.list.size();
    out = std::move(own);
  }
  return out;
}

}  // namespace

IdealModel::IdealModel(const ProbeStream& measured, const DiagnoseOptions& options,
                       const FitResult& ideal, const DistinctValues& indicated)
    : stream(measured),
      fit_options(options.fit),
      fit(ideal),
      indication(indicated),
      ball_mm(std::max(measured.ball_radius_mm.value_or(0.0), options.fit.ball_radius_mm)),
      point(about(measured, ideal, ball_mm, threads_of(options, measured))),
      mask(make_observation_mask(point)),
      resolution(resolution_of(point, mask)),
      deviation_mm(deviation_from(measured, point, threads_of(options, measured))),
      problem{point,
              mask,
              resolution,
              deviation_mm,
              options.false_alarm,
              threads_of(options, measured),
              static_cast<std::size_t>(options.max_findings),
              causes_of(point.base, resolution, options.own_effects),
              rounding_that_shows(indicated.step, deviation_mm)} {
  Outliers out = exclude(problem);
  mask = std::move(out.mask);
  masked = std::move(out.list);
  mask.alike_mm = alike_by_rounding(problem, measured.reading_mm);
}

bool IdealModel::exclude_far_from(const std::vector<double>& residual_mm, std::size_t columns) {
  if (residual_mm.size() < 2 * columns) return false;  // half of them would be 0
  const std::vector<Rejected> far = mask_far_from(point, residual_mm, mask);
  masked.insert(masked.end(), far.begin(), far.end());
  std::ranges::sort(masked, {}, &Rejected::row);
  return !far.empty();
}

}  // namespace trueaxis::diagnose_detail

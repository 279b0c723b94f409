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

constexpr int harmonics_of_rounding = 8;  // the others have a fifteenth of its square

LinearisationPoint about(const ProbeStream& stream, const FitResult& fit, double ball_mm,
                         int threads) {
  const std::vector<Clamping> clampings = clampings_of(fit, ball_mm);
  LinearisationPoint out =
      linearise_at(stream, clampings, base_of(stream, fit, clampings), fit.bore, threads);
  out.as_read = true;
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

/// Masks the readings that do not count. A large step leaves those about it far from any smooth
/// form. If one of the steps dated in all readings takes back more than half of them, it joins what
/// readings may deviate by.
std::vector<Rejected> exclude(const Problem& problem, ObservationMask& mask) {
  const LinearisationPoint& point = problem.point;
  std::vector<Hypothesis> basis = small_fourier_legendre_basis(point, problem.resolution);
  const auto with = [&](std::span<const Hypothesis> list, ObservationMask& to) {
    return mask_outliers(point, list, problem.deviation_mm, to, problem.threads);
  };
  ObservationMask all = mask;
  std::vector<Rejected> out = with(basis, mask);
  if (out.empty() || is_condensed(point)) return out;
  double tests = 0.0;
  const Problem unmasked{point,
                         all,
                         problem.resolution,
                         problem.deviation_mm,
                         problem.false_alarm,
                         problem.threads,
                         problem.most_terms,
                         problem.effects};
  std::optional<std::pair<std::vector<Rejected>, ObservationMask>> best;
  for (const Hypothesis& step : scan_steps(unmasked, {}, basis, tests)) {
    ObservationMask own = all;
    basis.push_back(step);
    std::vector<Rejected> left = with(basis, own);
    basis.pop_back();
    const std::size_t fewest = best ? best->first.size() : (out.size() + 1) / 2;
    if (left.size() < fewest) best.emplace(std::move(left), std::move(own));
  }
  if (!best) return out;
  mask = std::move(best->second);
  return std::move(best->first);
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
              rounding_that_shows(indicated.step, deviation_mm)},
      masked(exclude(problem, mask)) {
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

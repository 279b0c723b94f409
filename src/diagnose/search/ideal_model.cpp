// SPDX-License-Identifier: Apache-2.0
#include "diagnose/search/ideal_model.hpp"

#include <algorithm>

#include "base/threads.hpp"
#include "diagnose/regression/noise.hpp"
#include "diagnose/search/dictionary.hpp"
#include "math/statistics.hpp"

namespace trueaxis::diagnose_detail {
namespace {

LinearisationPoint about(const ProbeStream& stream, const FitResult& fit, double ball_mm,
                         int threads) {
  const std::vector<Clamping> clampings = clampings_of(fit, ball_mm);
  return linearise_at(stream, clampings, base_of(stream, fit, clampings), fit.bore, threads);
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
      masked(mask_outliers(point, small_fourier_legendre_basis(point, resolution), deviation_mm,
                           mask, threads_of(options, measured))),
      problem{point,
              mask,
              resolution,
              deviation_mm,
              options.false_alarm,
              threads_of(options, measured),
              static_cast<std::size_t>(options.max_findings),
              causes_of(point.base, resolution, options.own_effects),
              rounding_that_shows(indicated.step, deviation_mm)} {}

}  // namespace trueaxis::diagnose_detail

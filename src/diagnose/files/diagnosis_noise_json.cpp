// SPDX-License-Identifier: Apache-2.0
#include "diagnose/files/diagnosis_noise_json.hpp"

#include <limits>

#include "diagnose/files/diagnosis_objects.hpp"

namespace trueaxis {
namespace {

Json maybe_length(const std::optional<double>& value_mm) {
  return value_mm ? quantity_object(*value_mm, "mm", "not determined")
                  : Json{{"value", nullptr}, {"unit", "mm"}, {"why", "the data have no such part"}};
}

Json rows(const std::vector<Rejected>& rejected) {
  Json list = Json::array();
  for (const Rejected& r : rejected) list.push_back({{"row", r.row}, {"why", r.why}});
  return list;
}

}  // namespace

// The impulse response ψ_k = Σ φ_j ψ_{k−j} gives γ(1)/γ(0) = Σ ψ_k ψ_{k+1} / Σ ψ_k².
double neighbour_correlation(const std::vector<double>& autoregression) {
  constexpr std::size_t most = 100000;  // a root of 0.9999 has died out by then
  std::vector<double> response{1.0};
  double lag_0 = 1.0, lag_1 = 0.0, last = 1.0;
  for (std::size_t k = 1; k < most && last > 1e-24 * lag_0; ++k) {
    double next = 0.0;
    for (std::size_t j = 1; j <= autoregression.size() && j <= k; ++j) {
      next += autoregression[j - 1] * response[k - j];
    }
    lag_1 += next * response.back();
    lag_0 += next * next;
    response.push_back(next);
    last = 0.0;  // of a whole order's span: one of them may be 0 by chance
    for (std::size_t j = 0; j < autoregression.size() && j < response.size(); ++j) {
      last += response[k - j] * response[k - j];
    }
    if (!(lag_0 < 1e12)) return std::numeric_limits<double>::quiet_NaN();
  }
  return lag_1 / lag_0;
}

Json noise_object(const NoiseReport& noise) {
  return {{"sigma", estimate_object({noise.sigma_mm, noise.u_sigma_mm, "mm", ""})},
          {"source", noise.source},
          {"note", noise.note},
          {"autocorrelation", number(neighbour_correlation(noise.autoregression))},
          {"autoregression", noise.autoregression},
          {"stationary", maybe_length(noise.stationary_mm)},
          {"repeated", maybe_length(noise.repeated_mm)},
          {"revolutions", maybe_length(noise.revolutions_mm)},
          {"stated", maybe_length(noise.stated_mm)},
          {"masked", rows(noise.masked)},
          {"gaps", noise.gaps},
          {"interruptions", rows(noise.interruptions)}};
}

Json check_object(const QualityCheck& check) {
  return {{"effect", check.effect}, {"found", check.found}, {"text", check.text}};
}

}  // namespace trueaxis

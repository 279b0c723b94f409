// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "fit/plausible.hpp"
#include "job/mistakes.hpp"
#include "math/statistics.hpp"
#include "measure/feature.hpp"

namespace trueaxis {
std::optional<Reason> exchanged_streams(const IdentifiedJob &result) {
  for (std::size_t i = 0; i < result.streams.size(); ++i) {
    for (std::size_t j = i + 1; j < result.streams.size(); ++j) {
      const FitOptions &of_i = result.job.references[i].fit, &of_j = result.job.references[j].fit;
      const FitResult &a = result.fits[i], &b = result.fits[j];
      if (of_i.surface == of_j.surface || of_i.profile || of_j.profile ||
          result.streams[i].kind != result.streams[j].kind || a.status == FitStatus::too_few ||
          b.status == FitStatus::too_few || of_i.surface == SurfaceKind::section ||
          of_j.surface == SurfaceKind::section ||
          states_other_feature(result.streams[i], of_j.bore) ||
          states_other_feature(result.streams[j], of_i.bore))
        continue;
      const double a_mm = left_mm(result.streams[i], a), b_mm = left_mm(result.streams[j], b);
      const FitResult a_by_j = fit(result.streams[i], of_j), b_by_i = fit(result.streams[j], of_i);
      const bool fits = a_by_j.status == FitStatus::converged &&
                        b_by_i.status == FitStatus::converged &&
                        a_by_j.rms_mm <= exchanged_as_good.value * a_mm &&
                        b_by_i.rms_mm <= exchanged_as_good.value * b_mm;
      const bool better = a_by_j.rms_mm <= exchanged_better.value * a_mm ||
                          b_by_i.rms_mm <= exchanged_better.value * b_mm;
      if (!fits || !better) continue;
      return Reason{ReasonCode::streams_exchanged,
                    {i, j},
                    {{"left", a_mm, "mm"},
                     {"left_of_other", b_mm, "mm"},
                     {"exchanged", b_by_i.rms_mm, "mm"},
                     {"exchanged_of_other", a_by_j.rms_mm, "mm"}}};
    }
  }
  return {};
}

}  // namespace trueaxis

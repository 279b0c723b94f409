// SPDX-License-Identifier: Apache-2.0
#include "cli/checked_fit.hpp"

#include "format/reason_words.hpp"
#include "job/doubts.hpp"

namespace trueaxis::cli {

FitResult checked_fit(const ProbeStream& stream, const FitOptions& options) {
  FitResult result = fit(stream, options);
  if (const auto why = moved_reason(stream, result.residual_mm, result))
    withhold_axis(result, words_of(*why));
  if (const auto why = sensor_limit_of(stream); why && result.axis_known())
    withhold_axis(result, words_of(*why));
  if (const auto why = few_angles_of(stream); why && result.axis_known())
    result.notes.push_back(words_of(*why));
  return result;
}

}  // namespace trueaxis::cli

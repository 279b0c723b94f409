// SPDX-License-Identifier: Apache-2.0
#include "cli/checked_fit.hpp"

#include <utility>

#include "cli/guarded.hpp"
#include "format/reason_words.hpp"
#include "job/doubts.hpp"

namespace trueaxis::cli {

ProbeStream read_one_surface(const StreamOptions& stream, const AssociationOptions& association,
                             const Results& results, Outputs& outputs) {
  results.name_to(outputs, {stream.path});
  ProbeStream readings;
  all_of({[&] {
            readings = stream.read();
            expect_one_surface(readings, association.chosen().surface, RangesAs::options);
          },
          [&] { outputs.check(); }});
  return readings;
}

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

CheckedDiagnosis checked_diagnosis(ProbeStream stream, const DiagnoseOptions& options) {
  CheckedDiagnosis out;
  out.stream = corrected_by_known(std::move(stream), options.fit);
  out.diagnosis = diagnose(out.stream, options);
  if (const auto why = why_axis_unknown(out.stream, out.diagnosis))
    withhold_axis(out.diagnosis, words_of(*why));
  out.form = part_form({out.stream, &out.diagnosis}, options.fit, {});
  return out;
}

const FitResult& CheckedDiagnosis::deciding_fit() const {
  return diagnosis.baseline.status != FitStatus::converged ? diagnosis.baseline
                                                           : diagnosis.extended;
}

}  // namespace trueaxis::cli

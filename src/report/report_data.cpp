// SPDX-License-Identifier: Apache-2.0
#include "report/report_data.hpp"

#include <limits>

namespace trueaxis {
namespace {

/// What the banner says in one word: without tolerance or target nothing is met or missed.
const char* outcome(const JobResult& result) {
  const bool judged = result.job.coaxiality_tolerance_mm && result.target_axis;
  if (!result.verdict.go) return "no-go";
  return judged ? "go" : "done";
}

nlohmann::json verdict_data(const JobResult& result) {
  const Verdict& verdict = result.verdict;
  nlohmann::json data{
      {"outcome", outcome(result)}, {"line", verdict.line}, {"k", verdict.coverage_factor}};
  data["tolerance_mm"] =
      result.job.coaxiality_tolerance_mm.value_or(std::numeric_limits<double>::quiet_NaN());
  if (result.target_axis) {
    data["coaxiality_before_mm"] = verdict.coaxiality_before_mm;
    data["coaxiality_after_mm"] = verdict.coaxiality_after_mm;
    data["u_coaxiality_mm"] = verdict.u_coaxiality_mm;
  }
  return data;
}

nlohmann::json reference_data(const JobResult& result, std::size_t i) {
  nlohmann::json data = fit_data(result.fits[i]);
  const bool named = i < result.job.references.size() && !result.job.references[i].name.empty();
  data["name"] = named ? result.job.references[i].name : "reference " + std::to_string(i + 1);
  data["source"] = result.fits[i].source;
  data["input_hash"] = result.fits[i].input_hash;
  if (i < result.streams.size()) {
    data["readings"] = readings_data(result.streams[i], result.fits[i]);
    if (i < result.diagnoses.size() && result.diagnoses[i]) {
      const bool again = i < result.resimulations.size() && result.resimulations[i];
      data["diagnosis"] = diagnosis_data(result.streams[i], *result.diagnoses[i],
                                         again ? &*result.resimulations[i] : nullptr);
    }
    data["extended"] = &fit_used(result, i) != &result.fits[i];
    data["relative"] = result.streams[i].indication == Indication::relative;
  }
  return data;
}

}  // namespace

std::string job_title(const Job& job) { return job.name.empty() ? job.path : job.name; }

nlohmann::json report_data(const JobResult& result) {
  nlohmann::json data{{"schema", "trueaxis.report/1"},   {"version", TRUEAXIS_VERSION},
                      {"title", job_title(result.job)},  {"file", result.job.path},
                      {"verdict", verdict_data(result)}, {"inputs", inputs_data(result)},
                      {"target", target_data(result)},   {"references", nlohmann::json::array()}};
  for (std::size_t i = 0; i < result.fits.size(); ++i) {
    data["references"].push_back(reference_data(result, i));
  }
  if (result.correction) data["correction"] = correction_data(*result.correction);
  return data;
}

}  // namespace trueaxis

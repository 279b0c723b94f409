// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "fit/files/fit_files.hpp"
#include "format/text_layout.hpp"
#include "job/agreement.hpp"
#include "job/doubts.hpp"
#include "job/files/job_results.hpp"
#include "job/files/job_words.hpp"
#include "job/seat_distance.hpp"
#include "job/slip.hpp"
#include "report/page_data.hpp"

namespace trueaxis {
namespace {

/// What is to be minded, each text once, with the references that it is of.
class Warnings {
 public:
  void add(const std::string& text, const std::string& of = {}) {
    if (text.empty()) return;
    const auto same = [&](const Json& one) { return one.at("text") == text; };
    auto found = std::find_if(list_.begin(), list_.end(), same);
    if (found == list_.end()) {
      list_.push_back(Json{{"text", text}, {"of", Json::array()}});
      found = list_.end() - 1;
    }
    if (!of.empty()) (*found)["of"].push_back(of);
  }
  const Json& list() const { return list_; }

 private:
  Json list_ = Json::array();
};

void add_reference(Warnings& warnings, const JobResult& result, std::size_t i) {
  const FitResult& fit = result.fits[i];
  const std::string name = result.fits.size() > 1 && i < result.job.references.size()
                               ? result.job.references[i].name
                               : std::string();
  warnings.add(fit.message, name);
  for (const std::string& open : fit.not_determined)
    warnings.add("The readings leave open: " + open, name);
  for (const std::string& note : fit.input_notes) warnings.add(note, name);
  if (i >= result.diagnoses.size() || !result.diagnoses[i]) {
    for (const std::string& note : fit.notes) warnings.add(note, name);
    return;
  }
  const Diagnosis& diagnosis = *result.diagnoses[i];
  if (diagnosis.extended.status != FitStatus::converged)
    warnings.add(diagnosis.extended.message, name);
  for (const QualityCheck& check : diagnosis.checks)
    if (check.found && check.effect != entry_of(DataCheck::correlated_noise).id)
      warnings.add(check.text, name);
}

/// What the diagnosis asks to be measured next, and what it would tell. The probability with which
/// the right cause is known now is at each cause.
std::string measurement_text(const NextMeasurement& next) {
  return fmt::format(
      "To tell the causes apart: {} (about {:.0f} min). The right cause is then named with a "
      "probability of {}",
      next.what, std::ceil(next.minutes), layout::probability(next.power_after));
}

/// Whether the verdict itself is that of a slip.
bool is_of_slip(const Verdict& verdict) {
  return std::ranges::any_of(verdict.reasons, [](const Reason& reason) {
    return reason.code == ReasonCode::part_slipped ||
           reason.code == ReasonCode::part_may_have_slipped;
  });
}

/// "cec.ini or servo.nc"; of a job without files for controls its table.
std::string files_asked_for(const JobResult& result) {
  std::string names;
  for (const ControlTable& output : result.job.outputs)
    names += (names.empty() ? "" : " or ") + output.file;
  return names.empty() ? "table.csv" : names;
}

std::string cut_text(const JobResult& result) {
  const ActuatorMargin& margin = result.correction->margin;
  if (result.verdict.go())
    return fmt::format("Run {} at {:.6g} rpm", files_asked_for(result),
                       result.correction->tool.speed_rpm);
  if (!margin.follows && margin.max_speed_rpm > 0.0)
    return fmt::format("Lower the speed to {:.4g} rpm, at which the actuator follows",
                       margin.max_speed_rpm);
  return "Do not run the cut. Mend what the verdict names, and run the job again";
}

}  // namespace

Json warnings_data(const JobResult& result) {
  Warnings warnings;
  for (const Reason& one : result.verdict.reservations) warnings.add(words_of(one, result));
  warnings.add(words_of(result.verdict.moved, "; ", result));
  if (const Reasons slip = part_slipped(result); !slip.empty() && !is_of_slip(result.verdict))
    warnings.add(words_of(slip, "; ", result) + ". So no axis is given");
  for (const Inclusion& inclusion : result.inclusions) {
    std::string text = inclusion_text(inclusion);
    while (text.ends_with('\n')) text.pop_back();
    if (!inclusion.included || inclusion.why) warnings.add(text);
  }
  for (std::size_t i = 0; i < result.fits.size(); ++i) add_reference(warnings, result, i);
  const bool answered = !result.job.target && !seat_distances(result).empty();
  for (const Disagreement& apart : result.agreement.disagreements)
    if (!answered)
      warnings.add("More than U: " + words_of(how_apart(apart), result) +
                   ", half-way between the two");
  return warnings.list();
}

Json next_data(const JobResult& result) {
  Json steps = Json::array();
  const Reasons would_prove = result.verdict.what_would_prove();
  if (result.correction && would_prove.empty()) steps.push_back(cut_text(result));
  if (!would_prove.empty())
    steps.push_back(words_of(would_prove, "; ", result));
  else if (const NextMeasurement* next = next_measurement(result))
    steps.push_back(measurement_text(*next));
  if (result.correction) return steps;
  if (result.verdict.decision == Decision::no_go)
    steps.push_back("Mend what the verdict names, and run the job again");
  else if (std::ranges::none_of(result.fits, [](const FitResult& fit) {
             return fit.surface == SurfaceKind::section || fit.status != FitStatus::converged;
           }))
    steps.push_back(
        "For a table that cuts the next surface true to this, give a job a [target] and "
        "a [cut]");
  return steps;
}

}  // namespace trueaxis

// SPDX-License-Identifier: Apache-2.0
#include "job/files/job_words.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>

#include "job/cut_files.hpp"
#include "job/doubts.hpp"

namespace trueaxis {
namespace {

std::vector<SpokenReference> spoken(const IdentifiedJob& job) {
  std::vector<SpokenReference> out;
  for (std::size_t i = 0; i < job.job.references.size(); ++i)
    out.push_back({job.job.references[i].name,
                   i < job.streams.size()
                       ? std::filesystem::path(job.streams[i].source).filename().string()
                       : ""});
  return out;
}

const char* head_of(Decision decision) {
  switch (decision) {
    case Decision::identified:
      return "DONE: ";
    case Decision::untoleranced:
      return "DONE, no tolerance given: ";
    case Decision::go:
      return "GO: ";
    case Decision::go_with_reservations:
      return "GO with reservations: ";
    case Decision::not_proven:
      return "NOT PROVEN: ";
    case Decision::no_go:
      break;
  }
  return "NO-GO: ";
}

/// If a cut is not run, only what is not of the cut comes with the reason.
bool is_on_the_line(const Reason& reservation, const Verdict& verdict) {
  const ReasonCode code = reservation.code;
  return verdict.go() || code == ReasonCode::form_not_met || code == ReasonCode::form_not_proven ||
         code == ReasonCode::form_not_judged;
}

bool is_face(const IdentifiedJob& job, const std::string& name) {
  const auto found = std::ranges::find(job.job.references, name, &JobReference::name);
  return job.fits[static_cast<std::size_t>(found - job.job.references.begin())].surface ==
         SurfaceKind::plane;
}

}  // namespace

std::string words_of(const Reason& reason, const IdentifiedJob& job) {
  return words_of(reason, spoken(job));
}

std::string words_of(const Reasons& reasons, std::string_view between, const IdentifiedJob& job) {
  return words_of(reasons, between, spoken(job));
}

Json reasons_array(const Reasons& reasons, const IdentifiedJob& job) {
  return reasons_array(reasons, spoken(job));
}

std::vector<std::string> sentences_of(const Reasons& reasons, const IdentifiedJob& job) {
  std::vector<std::string> out;
  for (const Reason& one : reasons) out.push_back(words_of(one, job));
  return out;
}

std::string decision_line(Decision decision, const Reasons& reasons, const IdentifiedJob& job) {
  return head_of(decision) + words_of(reasons, "; ", job);
}

std::string verdict_line_alone(const JobResult& result) {
  return decision_line(result.verdict.decision, result.verdict.reasons, result);
}

std::string verdict_line(const JobResult& result) {
  std::string line = verdict_line_alone(result);
  for (const Reason& one : result.verdict.reservations)
    if (is_on_the_line(one, result.verdict)) line += "; " + words_of(one, result);
  return line;
}

std::string coarse_rows_words(const PlannedJob& job) { return words_of(coarse_rows(job), "; "); }

std::string coarse_rows_lines(const PlannedJob& job, std::string_view label) {
  std::string lines;
  if (job.correction)
    for (const Reason& coarse : coarse_rows(job))
      lines += std::string(label) + words_of(coarse) + "\n";
  return lines;
}

std::string datum_words(const IdentifiedJob& job) {
  const DatumSystem& datums = job.job.datums;
  const std::string first = fmt::format("{}", fmt::join(datums.front(), " and "));
  if (is_face(job, datums.front().front()))
    return datums.size() < 2 ? fmt::format("the direction is that of {}", first)
                             : fmt::format(
                                   "the direction is that of {}; the place is that of {}, fitted "
                                   "with this direction",
                                   first, fmt::join(datums[1], " and "));
  std::string how = datums.front().size() < 2
                        ? fmt::format("the axis is that of {}", first)
                        : fmt::format(
                              "{} share one axis with radii of their own, by least squares, each "
                              "with its weight, whatever its number of readings",
                              first);
  if (datums.size() > 1)
    how += fmt::format("; {} fixes Z, which no axis depends on", fmt::join(datums[1], " and "));
  return how;
}

void word_unknown_axes(JobResult& result) {
  for (std::size_t i = 0; i < result.axis_unknown.size(); ++i) {
    if (!result.axis_unknown[i]) continue;
    const std::string words = words_of(*result.axis_unknown[i], result);
    withhold_axis(result.fits[i], words);
    if (result.diagnoses[i]) withhold_axis(*result.diagnoses[i], words);
  }
}

}  // namespace trueaxis

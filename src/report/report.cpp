// SPDX-License-Identifier: Apache-2.0
#include "report/report.hpp"

#include <algorithm>
#include <array>
#include <limits>

#include "diagnose/files/axes_text.hpp"
#include "diagnose/files/diagnosis_json.hpp"
#include "diagnose/files/diagnosis_screen.hpp"
#include "diagnose/files/seen.hpp"
#include "fit/files/fit_files.hpp"
#include "job/files/job_results.hpp"
#include "job/files/job_words.hpp"
#include "job/slip.hpp"
#include "report/page.hpp"
#include "report/page_data.hpp"

namespace trueaxis {
namespace {

/// The name of the job, or its file when it has none.
const std::string& job_title(const JobResult& result, const std::string& file) {
  return result.job.name.empty() ? file : result.job.name;
}

std::string reference_name(const JobResult& result, std::size_t i) {
  const bool named = i < result.job.references.size() && !result.job.references[i].name.empty();
  return named ? result.job.references[i].name : "reference " + std::to_string(i + 1);
}

/// What the banner says in one word: without tolerance or target nothing is met or missed.
const char* outcome(const JobResult& result) {
  const bool judged = result.job.coaxiality_tolerance_mm && result.target_axis;
  return outcome_of(result.verdict.decision, judged);
}

/// Where and how far to tap each seat: nothing after a slip, nor if there is a table, which holds
/// for the part as it is clamped.
Json tap_data(const JobResult& result) {
  Json sentences = Json::array();
  if (result.correction || !part_slipped(result).empty()) return sentences;
  for (std::size_t i = 0; i < result.fits.size(); ++i)
    if (const std::string tap = tap_text(fit_used(result, i)); !tap.empty())
      sentences.push_back(result.fits.size() == 1 ? tap : reference_name(result, i) + ": " + tap);
  return sentences;
}

Json verdict_data(const JobResult& result) {
  const Verdict& verdict = result.verdict;
  Json data{{"outcome", outcome(result)},
            {"line", verdict_line_alone(result)},
            {"k", verdict.coverage_factor}};
  data["tolerance_mm"] =
      result.job.coaxiality_tolerance_mm.value_or(std::numeric_limits<double>::quiet_NaN());
  data["tap"] = tap_data(result);
  if (result.target_axis && result.refused.empty()) {
    data["coaxiality_before_mm"] = verdict.coaxiality_before_mm;
    data["coaxiality_after_mm"] = verdict.coaxiality_after_mm;
    data["u_coaxiality_mm"] = verdict.u_coaxiality_mm;
    data["coaxiality_at_most_mm"] = verdict.upper_mm;
  }
  return data;
}

/// Ids of effects and codes of measurements in words, for texts that hold them.
Json words_data() {
  Json words{{"effects", Json::object()}, {"measurements", Json::object()}};
  for (const Effect& effect : effect_catalogue())
    words["effects"][std::string(effect.id)] = short_title(effect);
  for (const Separator& separator : separators())
    words["measurements"][std::string(separator.code)] = std::string(separator.what);
  return words;
}

/// What each effect that the page names is called.
Json titles_of(const Diagnosis& diagnosis) {
  Json titles = Json::object();
  for (const Effect& effect : effect_catalogue()) titles[std::string(effect.id)] = effect.title;
  for (const Finding& finding : diagnosis.findings)
    titles[finding.effect()] = finding.term.effect->title;
  return titles;
}

/// What was seen, cause by cause.
void add_words(Json& data, const Diagnosis& diagnosis) {
  const double k = diagnosis.baseline.coverage_factor;
  const auto seen = [k](const auto& one) { return seen_text(one, k); };
  data["seen"] = {{"findings", list_of(diagnosis.findings, seen)},
                  {"unexplained", list_of(diagnosis.unexplained, seen)}};
}

/// x, y and u of an axis at both ends of what was probed, mm.
Json axis_ends(const FitResult& fit) {
  if (fit.status != FitStatus::converged) return Json::array();
  return list_of(std::array{fit.position_min_mm, fit.position_max_mm}, [&](double z) -> Json {
    const auto [x, y] = fit.axis.axis.at(z);
    return {{"z", z}, {"x", x}, {"y", y}, {"u", fit.axis.u_at(z)}};
  });
}

/// A diagnosis as in its file, without what the page has elsewhere or only counts.
Json diagnosis_data(const ProbeStream& stream, const Diagnosis& diagnosis,
                    const Resimulation* again, const char* axis_of_cut) {
  Json data = diagnosis_object(diagnosis);
  for (const char* key : {"baseline", "named", "spectrum", "u_frame"}) data.erase(key);
  data["axes"] = {{"stated", axis_ends(diagnosis.extended)},
                  {"named", axis_ends(diagnosis.named)},
                  {"ideal", axis_ends(diagnosis.baseline)}};
  data["extended"] = {{"status", to_string(diagnosis.extended.status)},
                      {"message", diagnosis.extended.message}};
  data["noise"]["masked"] = diagnosis.noise.masked.size();
  data["noise"]["interruptions"] = diagnosis.noise.interruptions.size();
  if (diagnosis.extended.surface != SurfaceKind::plane) {
    data["shares"] = list_of(telling_shares(diagnosis), share_object);
  }
  data["titles"] = titles_of(diagnosis);
  add_words(data, diagnosis);
  data["axis_of_cut"] = axis_of_cut;
  data["limit"] = limit_text(diagnosis);
  data["rms_shown_mm"] = rms_shown_mm(diagnosis);
  data["simulation"] = simulation_data(stream, diagnosis, again);
  return data;
}

Json reference_data(const JobResult& result, std::size_t i) {
  Json data = fit_data(result.fits[i]);
  data["name"] = reference_name(result, i);
  if (i < result.streams.size()) {
    const Diagnosis* found =
        i < result.diagnoses.size() && result.diagnoses[i] ? &*result.diagnoses[i] : nullptr;
    data["readings"] = readings_data(result.streams[i], result.fits[i], found);
    if (result.fits[i].surface == SurfaceKind::section)
      data["roundness"] = roundness_data(result.streams[i], result.fits[i]);
    if (i < result.diagnoses.size() && result.diagnoses[i]) {
      const bool again = i < result.resimulations.size() && result.resimulations[i];
      data["diagnosis"] = diagnosis_data(
          result.streams[i], *result.diagnoses[i], again ? &*result.resimulations[i] : nullptr,
          result.job.target ? to_string(result.job.axis_of_cut) : "");
    }
    data["extended"] = &fit_used(result, i) != &result.fits[i] &&
                       result.diagnoses[i]->verdict != DiagnosisVerdict::ideal;
    if (i < result.datum_axes.size() && !result.datum_axes[i].empty())
      data["datums"] = datum_axes_array(result.datum_axes[i], fit_used(result, i));
    if (const auto& association = result.job.references[i].association)
      data["association"] = name_of(*association);
    if (i < result.forms.size()) data["form"] = part_form_data(result.forms[i]);
    data["relative"] = result.streams[i].indication == Indication::relative;
  }
  return data;
}

}  // namespace

const char* outcome_of(Decision decision, bool judged) {
  switch (decision) {
    case Decision::not_proven:
      return "not-proven";
    case Decision::go_with_reservations:
      return "reserved";
    case Decision::no_go:
      return "no-go";
    default:
      return judged ? "go" : "done";
  }
}

Json fit_data(const FitResult& fit) {
  Json data = fit_object(fit);
  const auto listed =
      static_cast<std::ptrdiff_t>(std::min(fit.rejected.size(), max_rejected_listed));
  const Json rows = data["rejected"];
  data["rejected"] = {{"count", fit.rejected.size()},
                      {"listed", Json::array_t(rows.begin(), rows.begin() + listed)}};
  return data;
}

Json report_data(const JobResult& result, const std::string& file) {
  const std::size_t count = result.fits.size();
  const auto reference = [&](std::size_t i) { return reference_data(result, i); };
  Json data{{"schema", "trueaxis.report/2"},
            {"version", TRUEAXIS_VERSION},
            {"title", job_title(result, file)},
            {"file", file},
            {"verdict", verdict_data(result)},
            {"inputs", inputs_data(result)},
            {"target", target_data(result)},
            {"seats", seats_data(result)},
            {"header", result.job.header},
            {"warnings", warnings_data(result)},
            {"next", next_data(result)},
            {"words", words_data()},
            {"references", list_of_first(count, reference)}};
  if (count > 1 && !result.job.target) {
    data["seats_apart"] = seats_apart_array(result);
    data["seat_axes"] =
        list_of_first(count, [&](std::size_t i) { return seat_axis_object(result, i); });
  }
  if (result.correction) data["correction"] = correction_data(*result.correction);
  return data;
}

Json job_tables(const JobResult& result) {
  Json tables = job_object(result);
  for (const char* key : {"reasons", "reserved"}) tables["verdict"].erase(key);
  if (result.correction)
    for (const char* key : {"broken", "remedies"}) tables["correction"]["margin"].erase(key);
  if (tables.contains("included"))
    for (Json& one : tables["included"]) one.erase("code");
  return tables;
}

std::string render_report(const JobResult& result, const std::string& file) {
  const Json tables = job_tables(result);
  return page_of("TrueAxis report: " + job_title(result, file), verdict_line(result),
                 report_data(result, file), job_script(), &tables);
}

}  // namespace trueaxis

// SPDX-License-Identifier: Apache-2.0
#include <filesystem>

#include "diagnose/files/diagnosis_screen.hpp"
#include "fit/files/fit_files.hpp"
#include "job/datum_axes.hpp"
#include "job/files/job_results.hpp"
#include "report/page.hpp"
#include "report/page_data.hpp"
#include "report/report.hpp"

namespace trueaxis {
namespace {

JobResult job_of(const ProbeStream& stream, const FitResult& fit, const FitOptions& options) {
  JobResult result;
  result.job.name = stream.source == "-" ? "Stream of standard input"
                                         : std::filesystem::path(stream.source).filename().string();
  JobReference reference;
  reference.name = to_string(fit.surface);
  reference.fit = options;
  result.job.references.push_back(std::move(reference));
  result.streams.push_back(stream);
  result.fits.push_back(fit);
  result.verdict.decision = Decision::identified;
  return result;
}

std::string first_line(const std::string& screen) { return screen.substr(0, screen.find('\n')); }

std::string command(const char* verb, const FitResult& fit) {
  return std::string("trueaxis ") + verb + " " + (fit.source == "-" ? "STREAM" : fit.source) +
         " --surface " + to_string(fit.surface);
}

/// @param outcome what the banner says in one word
std::string page(JobResult result, const char* outcome, const std::string& line, Json first_steps) {
  Json data = report_data(result, result.streams.front().source);
  data["verdict"]["outcome"] = outcome;
  data["verdict"]["line"] = line;
  data["of_stream"] = true;
  for (const Json& step : next_data(result)) first_steps.push_back(step);
  data["next"] = std::move(first_steps);
  Json tables = job_tables(result);
  tables["verdict"]["line"] = line;
  return page_of("TrueAxis report: " + result.job.name, line, data, job_script(), &tables);
}

}  // namespace

std::string render_fit_report(const ProbeStream& stream, const FitResult& fit,
                              const FitOptions& options) {
  const bool fitted = fit.status == FitStatus::converged;
  JobResult result = job_of(stream, fit, options);
  // Of one section its roundness is what is looked for.
  if (fitted && fit.surface == SurfaceKind::section)
    result.forms.push_back(part_form({stream}, options, {}));
  Json steps = Json::array();
  if (fitted && is_diagnosed(fit.surface))
    steps.push_back("See what the surface does not explain: " + command("diagnose", fit));
  return page(std::move(result), fitted ? "fitted" : "not-determined", first_line(fit_screen(fit)),
              std::move(steps));
}

std::string render_diagnosis_report(const ProbeStream& stream, const Diagnosis& diagnosis,
                                    const FitOptions& options, const PartForm& form) {
  JobResult result = job_of(stream, diagnosis.baseline, options);
  const bool fitted = diagnosis.baseline.status == FitStatus::converged;
  result.diagnoses.emplace_back();
  result.resimulations.emplace_back();
  if (fitted) {
    result.diagnoses.front() = diagnosis;
    result.forms.push_back(form);
    result.datum_axes.push_back(datum_axes(result, 0));
    result.resimulations.front() = resimulate(diagnosis, stream, options.ball_radius_mm);
  }
  const char* outcome = !fitted                                          ? "not-determined"
                        : diagnosis.verdict == DiagnosisVerdict::ideal   ? "ideal"
                        : diagnosis.verdict == DiagnosisVerdict::effects ? "effects"
                                                                         : "unexplained";
  const bool ideal = fitted && diagnosis.verdict == DiagnosisVerdict::ideal;
  return page(std::move(result), outcome, first_line(diagnosis_screen(diagnosis)),
              ideal && diagnosis.extended.axis_known()
                  ? Json::array({"Nothing more is needed: the axis may be used."})
                  : Json::array());
}

}  // namespace trueaxis

// SPDX-License-Identifier: Apache-2.0
#include <iostream>
#include <memory>
#include <optional>
#include <utility>

#include "base/diagnostics.hpp"
#include "cli/commands.hpp"
#include "cli/diagnosed_stream.hpp"
#include "cli/guarded.hpp"
#include "cli/options.hpp"
#include "cli/results.hpp"
#include "correct/files/table_files.hpp"
#include "diagnose/files/diagnosis_json.hpp"
#include "fit/files/fit_files.hpp"
#include "format/file.hpp"
#include "format/outputs.hpp"
#include "job/conclude.hpp"
#include "job/files/job_results.hpp"
#include "job/files/job_toml.hpp"
#include "job/files/job_words.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis::cli {
namespace {

struct CorrectArguments {
  std::string fit, target, table, diagnosis;
  StreamOptions stream;  ///< path empty: as the diagnosis names it
  double ball_radius_mm = 0.0;
  Results results;
  bool ideal = false, preview = false, check = false;
};

constexpr const char* rests_on_ideal =
    "ideal       the table relies on the ideal fit alone: nothing looked for slips, patterns and "
    "other causes\n";

/// What run has of its reference when it comes to the target.
struct Identified {
  FitResult fit;
  std::optional<Diagnosis> diagnosis;
};

bool is_diagnosis(const std::string& text) {
  return schema_in(text.substr(0, 512)) == "trueaxis.diagnosis";
}

Diagnosis read_diagnosis(const std::string& text, const std::string& path) {
  Diagnosis diagnosis = diagnosis_from_json(text, path);
  const FitResult& fit = diagnosis.baseline;
  if (fit.status == FitStatus::converged) return diagnosis;
  throw InputError(path, std::string("its fit is not converged (") + to_string(fit.status) +
                             "): no correction from it");
}

Identified identified(const CorrectArguments& options) {
  const std::string text = read_file(options.fit);
  Identified out;
  if (is_diagnosis(text)) {
    out.diagnosis = read_diagnosis(text, options.fit);
    out.fit = out.diagnosis->baseline;
    if (options.ideal || !options.diagnosis.empty())
      throw InputError(options.fit,
                       "is a diagnosis itself: leave --ideal and --diagnosis out; a cut about its "
                       "ideal fit is asked for by axis = \"ideal\" in [correction] of the target");
    return out;
  }
  out.fit = fit_from_json(text, options.fit);
  if (!options.diagnosis.empty()) {
    out.diagnosis = read_diagnosis(read_file(options.diagnosis), options.diagnosis);
    const FitResult& of = out.diagnosis->baseline;
    if (of.input_hash != out.fit.input_hash || of.surface != out.fit.surface)
      throw InputError(options.diagnosis,
                       "is of another stream or surface than " + options.fit + ": give its own");
  } else if (!options.ideal && out.fit.surface != SurfaceKind::plane) {
    throw Refusal(
        options.fit +
        " is a fit without a diagnosis, so nothing looked for slips and patterns. Give the "
        "result of 'trueaxis diagnose --json' instead of it or with --diagnosis, or rely "
        "on the ideal fit with --ideal");
  }
  return out;
}

/// The job of the one reference: as `run` would have it, with the stream read again.
IdentifiedJob result_of(const CorrectArguments& options, Job job, Identified found,
                        Outputs& outputs) {
  if (!is_diagnosed(found.fit.surface))
    throw InputError(options.fit, std::string("is of a ") + to_string(found.fit.surface) +
                                      ", about which nothing is cut: probe a cylinder or cone");
  if (found.fit.surface == SurfaceKind::section)
    throw InputError(options.fit,
                     "is one section, which shows no direction of an axis: probe it along Z as a "
                     "cylinder or cone");
  IdentifiedJob result;
  JobReference reference;
  reference.name = options.fit;
  reference.fit.surface = found.fit.surface;
  reference.fit.bore = found.fit.bore;
  reference.fit.coverage_factor = found.fit.coverage_factor;
  reference.fit.ball_radius_mm = options.ball_radius_mm;
  ProbeStream measured;
  if (found.fit.surface == SurfaceKind::plane) measured.kind = StreamKind::face;
  result.resimulations.emplace_back();
  if (found.diagnosis) {
    const std::string& path = options.diagnosis.empty() ? options.fit : options.diagnosis;
    StreamOptions stream = options.stream;
    stream.path = diagnosed_stream_path(stream.path, path, *found.diagnosis);
    outputs.reads(stream.path);
    measured = as_diagnosed(stream.read(), *found.diagnosis, options.ball_radius_mm);
    reference.fit.influences = found.diagnosis->known;
    result.resimulations[0] =
        measured_again(path, *found.diagnosis, measured, options.ball_radius_mm);
  }
  job.references = {reference};
  job.outputs.clear();  // the table alone is written, and judged
  result.job = std::move(job);
  result.streams.push_back(std::move(measured));
  result.fits.push_back(std::move(found.fit));
  result.diagnoses.push_back(std::move(found.diagnosis));
  return result;
}

int execute(const CorrectArguments& options) {
  Outputs outputs(options.results.force);
  Identified found = identified(options);
  IdentifiedJob job =
      result_of(options, read_target_toml(options.target), std::move(found), outputs);
  outputs.reads(options.fit);
  outputs.reads(options.target);
  if (!options.diagnosis.empty()) outputs.reads(options.diagnosis);
  outputs.may_write(options.table, "trueaxis.correction");
  options.results.name_to(outputs);
  outputs.check();
  if (options.check) return checked(outputs, "correct the target for the axis of " + options.fit);
  const JobResult result = of_file(options.target, [&] { return conclude(std::move(job)); });
  const Verdict& verdict = result.verdict;
  const bool cut = verdict.go() && result.correction;
  options.results.write(outputs, "--json", [&] { return job_json(result, {}); });
  if (!options.preview && cut) outputs.write(options.table, correction_csv(*result.correction));
  if (!options.preview && !cut)
    set_aside(outputs, options.table);  // one is there only when it may be run
  outputs.commit();
  const bool printed = options.results.printed() || (!options.preview && options.table == "-");
  if (!printed && result.correction)
    std::cout << verdict_line(result) << '\n'
              << correction_preview(*result.correction)
              << coarse_rows_lines(result, "rows        ");
  if (options.ideal) (printed ? std::cerr : std::cout) << rests_on_ideal;
  if (!cut) throw Refusal(words_of(verdict.reasons, "; ", result));
  return done;
}

}  // namespace

void add_table(CLI::App* command, int& exit_code) {
  auto options = std::make_shared<CorrectArguments>();
  command
      ->add_option("fit", options->fit,
                   "result of diagnose --json, or of fit --json with --diagnosis or --ideal")
      ->required();
  command
      ->add_option("--target", options->target,
                   "TOML with [target], [cut] and [actuator], as in a job")
      ->required()
      ->type_name("FILE");
  auto* table = add_place(*command, "-o,--output", options->table, "table (CSV); - prints it");
  auto* preview = command->add_flag("--preview", options->preview,
                                    "print extremes and harmonics, write nothing");
  preview->excludes(table);
  auto* diagnosis = command->add_option("--diagnosis", options->diagnosis,
                                        "diagnosis of the fit: result of diagnose --json");
  diagnosis->type_name("FILE");
  command->add_flag("--ideal", options->ideal, "rely on the ideal fit without a diagnosis")
      ->excludes(diagnosis);
  command->add_option("--stream", options->stream.path, "diagnosed stream, if it has moved")
      ->type_name("FILE");
  options->stream.add_meaning_to(*command);
  options->stream.add_range_to(*command);
  StreamOptions::add_ball_radius(*command, options->ball_radius_mm);
  add_json(*command, options->results, "trueaxis.run");
  add_usual(*command, options->results.force, options->check);
  command->callback([options, &exit_code] {
    if (!options->preview && options->table.empty())
      throw CLI::RequiredError("-o TABLE or --preview");
    if (options->table == "-" && options->results.printed())
      throw CLI::ValidationError("--json", "cannot go where --output goes");
    exit_code = execute(*options);
  });
}

}  // namespace trueaxis::cli

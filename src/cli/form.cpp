// SPDX-License-Identifier: Apache-2.0
#include "trueaxis/form.hpp"

#include <iostream>
#include <memory>

#include "associate/files/association_files.hpp"
#include "base/diagnostics.hpp"
#include "base/number.hpp"
#include "cli/commands.hpp"
#include "cli/form_tolerance.hpp"
#include "cli/guarded.hpp"
#include "cli/options.hpp"
#include "cli/results.hpp"
#include "cli/stream_options.hpp"
#include "cli/terminal.hpp"
#include "form/files/form_files.hpp"
#include "format/outputs.hpp"
#include "job/files/stream_job.hpp"

namespace trueaxis::cli {
namespace {

constexpr const char* form_group = "Evaluation";

struct FormArguments {
  StreamOptions stream;
  FormOptions form;
  std::string filter = "gaussian", upr = "1-50", datum, datum_association, spindle;
  std::string tolerances, element, unit, array;
  double noise_um = -1.0, spindle_range_um = 0.0;
  Results results;
  bool verbose = false, check = false;
};

/// "1-50", "15-500", or one number, the upper.
void parse_band(const std::string& text, FormOptions& form) {
  const auto refuse = [&] {
    throw CLI::ValidationError("--upr", text + " is not a pass band such as 1-50");
  };
  const auto number = [&](std::string_view part) {
    double value = 0.0;
    if (!parse_number(part, value)) refuse();
    return value;
  };
  const std::size_t dash = text.find('-');
  form.low_upr = dash == std::string::npos ? 1.0 : number(std::string_view(text).substr(0, dash));
  form.high_upr =
      number(dash == std::string::npos ? text : std::string_view(text).substr(dash + 1));
  if (!(form.low_upr >= 1.0 && form.high_upr > form.low_upr && form.high_upr <= 1500.0)) refuse();
}

FormOptions chosen(const FormArguments& options) {
  FormOptions form = options.form;
  form.filter = options.filter == "none"     ? ProfileFilter::none
                : options.filter == "robust" ? ProfileFilter::robust_gaussian
                : options.filter == "spline" ? ProfileFilter::spline
                                             : ProfileFilter::gaussian;
  parse_band(options.upr, form);
  if (options.noise_um >= 0.0) form.noise_mm = options.noise_um * mm_per_um;
  form.spindle_range_mm = options.spindle_range_um * mm_per_um;
  for (const Criterion criterion : form_criteria)
    if (options.datum_association == name_of(criterion)) form.datum = criterion;
  if (!options.spindle.empty()) form.spindle = read_spindle_motion(options.spindle);
  return form;
}

FormResult of_points(const FormArguments& options, const FormOptions& form) {
  const PointText points = read_points(options.stream.path, options.unit, options.array);
  Element element = Element::circle;
  for (std::size_t i = 0; i < element_names.size(); ++i)
    if (options.element == element_names[i]) element = static_cast<Element>(i);
  FormResult result = of_file(
      points.source, [&] { return assess_form(points.points_mm, element, form); }, "points");
  result.source = points.source;
  result.input_hash = points.hash;
  return result;
}

FormResult assessed(const FormArguments& options, FormOptions form) {
  if (!options.element.empty()) return of_points(options, form);
  const ProbeStream stream = options.stream.read();
  expect_one_surface(stream, SurfaceKind::cylinder, RangesAs::options);
  form.bore = form.bore || states_bore(stream);
  if (options.datum.empty()) return assess_form(stream, form);
  const ProbeStream datum = read_recording(options.datum, options.stream.recording());
  expect_one_surface(datum, SurfaceKind::cylinder, RangesAs::options);
  if (datum.input_hash == stream.input_hash)
    throw InputError(options.datum, "is the stream itself: name the readings of the datum seat");
  return assess_form(stream, form, &datum);
}

int execute(const FormArguments& options) {
  const auto tolerances = parse_form_tolerances(options.tolerances);
  const FormOptions form = chosen(options);
  const Results& results = options.results;
  Outputs outputs(results.force);
  outputs.reads(options.stream.path);
  if (!options.spindle.empty()) outputs.reads(options.spindle);
  if (!options.datum.empty()) outputs.reads(options.datum);
  results.name_to(outputs);
  outputs.check();
  if (options.check) {
    if (options.element.empty())
      expect_one_surface(options.stream.read(), SurfaceKind::cylinder, RangesAs::options);
    else
      read_points(options.stream.path, options.unit, options.array);
    return checked(outputs, "evaluate the form of " + options.stream.path);
  }
  const FormResult result = assessed(options, form);
  const FormVerdict verdict = judge_form(result, tolerances);
  results.write(outputs, "--json", [&] { return form_json(result); });
  results.write(outputs, "--profile", [&] { return form_profile_csv(result); });
  results.write(outputs, "--qif",
                [&] { return form_qif(result, tolerances, options.element.empty()); });
  outputs.commit();
  if (!results.printed())
    std::cout << (verdict.text.empty() ? form_line(result) : verdict.text)
              << form_text(result, options.verbose);
  return verdict.met ? done : refused;
}

void add_filter(CLI::App& command, FormArguments& options) {
  add_option(command, "--filter", options.filter, one_of({"gaussian", "robust", "spline", "none"}),
             "profile filter (default gaussian)")
      ->group(form_group);
  command.add_option("--upr", options.upr, "pass band, undulations per revolution (default 1-50)")
      ->type_name("LOW-HIGH")
      ->group(form_group);
  add_place(command, "--spindle", options.spindle,
            "result of spindle --json, whose error motion is subtracted")
      ->group(form_group);
  add_option(command, "--spindle-range-um", options.spindle_range_um, a_length(),
             "range of unknown synchronous error motion, in U, µm (default 0)")
      ->group(form_group);
}

void add_rest(CLI::App& command, FormArguments& options) {
  add_probe(command, options.form.bore, options.form.ball_radius_mm, options.noise_um,
            readings_group);
  add_place(command, "--datum", options.datum,
            "stream of the datum in the same clamping (default the spindle axis)")
      ->group(form_group);
  add_option(command, "--datum-association", options.datum_association,
             one_of({"gaussian", "minimum_zone", "minimum_circumscribed", "maximum_inscribed"}),
             "association of the datum (default gaussian)")
      ->group(form_group);
  command
      .add_option("--tolerance-um", options.tolerances,
                  "tolerances, as RONt=2,CYLt=5; exit 1 unless proven met (ISO 14253-1)")
      ->group(form_group);
  add_coverage_factor(command, options.form.coverage_factor)->group(form_group);
  add_option(command, "--trials", options.form.trials, CLI::Range(10, 1000000),
             "Monte Carlo for U: trials (default 400), seed (default 12181)");
  command.add_option("--seed", options.form.seed,
                     "Monte Carlo for U: trials (default 400), seed (default 12181)");
  add_threads(command, options.form.threads);
  Results& results = options.results;
  results.add(command, "--json", "trueaxis.form", "result (JSON); - prints it");
  results.add(command, "--profile", "trueaxis.form_profile",
              "profiles before and after the filter (CSV), features (QIF 3.0, XML)");
  results.add(command, "--qif", "trueaxis.qif",
              "profiles before and after the filter (CSV), features (QIF 3.0, XML)");
  add_usual(command, results.force, options.check, &options.verbose);
}

}  // namespace

void add_form(CLI::App* command, int& exit_code) {
  auto options = std::make_shared<FormArguments>();
  options->stream.add_to(*command, "probe stream (CSV), or points x y z; - for standard input");
  options->stream.add_range_to(*command);
  auto* element = add_option(*command, "--element", options->element,
                             one_of({"circle", "cylinder", "plane", "line"}),
                             "element of the points x y z in the file");
  element->group(points_group);
  add_option(*command, "--unit", options->unit, one_of({"mm", "um", "m", "in"}),
             "unit of the points (default mm)")
      ->needs(element)
      ->group(points_group);
  add_place(*command, "--array", options->array, array_help)
      ->type_name("ARRAY")
      ->needs(element)
      ->group(points_group);
  add_filter(*command, *options);
  add_rest(*command, *options);
  command->callback([options, &exit_code] {
    if (!options->element.empty() && (options->stream.says_anything() || !options->datum.empty()))
      throw CLI::ValidationError("--element",
                                 "points have no X_M and no datum: leave out their options");
    exit_code = execute(*options);
  });
}

}  // namespace trueaxis::cli

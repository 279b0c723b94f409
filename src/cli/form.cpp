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

struct FormArguments {
  StreamOptions stream;
  FormOptions form;
  std::string filter = "gaussian", upr = "1-50", datum, datum_association, spindle;
  std::string tolerances, element, unit, array;
  double noise_um = -1.0, spindle_range_um = 0.0;
  Results results;
  bool verbose = false;
};

/// "1-50", "15-500", or one number, the upper.
void parse_band(const std::string& text, FormOptions& form) {
  const auto refuse = [&] {
    throw CLI::ValidationError("--upr", text + " is no pass band such as 1-50");
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

FormResult assessed(const FormArguments& options, const FormOptions& form) {
  if (!options.element.empty()) return of_points(options, form);
  const ProbeStream stream = options.stream.read();
  expect_one_surface(stream, SurfaceKind::cylinder, RangesAs::options);
  if (options.datum.empty()) return assess_form(stream, form);
  const ProbeStream datum = read_recording(options.datum, options.stream.recording());
  expect_one_surface(datum, SurfaceKind::cylinder, RangesAs::options);
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
  const FormResult result = assessed(options, form);
  const FormVerdict verdict = judge_form(result, tolerances);
  results.write(outputs, "--json", [&] { return form_json(result); });
  results.write(outputs, "--profile", [&] { return form_profile_csv(result); });
  results.write(outputs, "--qif",
                [&] { return form_qif(result, tolerances, options.element.empty()); });
  outputs.commit();
  if (!results.printed()) std::cout << verdict.text << form_text(result, options.verbose);
  return verdict.met ? done : refused;
}

void add_filter(CLI::App& command, FormArguments& options) {
  add_option(command, "--filter", options.filter, one_of({"gaussian", "robust", "spline", "none"}),
             "gaussian (default, ISO 16610-21), robust (-31), spline (-22) or none");
  command.add_option("--upr", options.upr,
                     "pass band, undulations per revolution (1-50): 1-15, 1-150, 1-500, 15-500");
  add_option(command, "--spindle", options.spindle, a_place(),
             "JSON of `trueaxis spindle`: its error motion is taken off, its u counts");
  add_option(command, "--spindle-range-um", options.spindle_range_um, a_length(),
             "range of a synchronous error motion that is not known by its orders, in U");
}

void add_rest(CLI::App& command, FormArguments& options) {
  command.add_flag("--bore", options.form.bore, "probed from inside");
  add_option(command, "--ball-radius", options.form.ball_radius_mm, a_length(),
             "X_M is the centre of a ball of this radius, mm");
  add_option(command, "--noise", options.noise_um, a_length(),
             "standard deviation of one reading, µm");
  add_option(command, "--datum", options.datum, a_place(),
             "probe stream (CSV) of the datum, in the same clamping (the spindle axis)");
  add_option(command, "--datum-association", options.datum_association,
             one_of({"gaussian", "minimum_zone", "minimum_circumscribed", "maximum_inscribed"}),
             "gaussian (default), minimum_zone, minimum_circumscribed (a shaft's of ISO "
             "5459:2011) or maximum_inscribed (a bore's)");
  command.add_option("--tolerance-um", options.tolerances,
                     "RONt=2,CYLt=5: judged by ISO 14253-1, exit 1 where one is not proven met");
  add_option(command, "--coverage-factor", options.form.coverage_factor,
             number_in(0.0, true, 100.0, "a number above 0, up to 100"), "k of U = k u (2)");
  add_option(command, "--trials", options.form.trials, CLI::Range(10, 1000000),
             "of the Monte Carlo behind U (400)");
  command.add_option("--seed", options.form.seed, "of the Monte Carlo (12181)");
  add_option(command, "--threads", options.form.threads, CLI::Range(0, 1024),
             "as many as there are (0)");
  Results& results = options.results;
  results.add(command, "--json", "trueaxis.form", "write the result here (JSON), '-' prints it");
  results.add(command, "--profile", "trueaxis.form_profile",
              "write the profiles here (CSV), before and behind the filter; '-' prints them");
  results.add(command, "--qif", "trueaxis.qif",
              "write a QIF 3.0 results document here (XML): features with their form, and what "
              "has a tolerance as a characteristic; '-' prints it");
  add_force(command, results.force);
  add_verbose(command, options.verbose);
}

}  // namespace

void add_form(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand(
      "form", "roundness, cylindricity, straightness, flatness and run-out (ISO 12181, 1101)");
  auto options = std::make_shared<FormArguments>();
  options->stream.add_to(*command,
                         "probe stream (CSV), or points x y z (with --element); '-' for standard "
                         "input");
  options->stream.add_range_to(*command);
  auto* element = add_option(*command, "--element", options->element,
                             one_of({"circle", "cylinder", "plane", "line"}),
                             "the file holds points x y z of a circle, cylinder, plane or line");
  add_option(*command, "--unit", options->unit, one_of({"mm", "um", "m", "in"}),
             "of the points: mm, um, m or in (mm)")
      ->needs(element);
  add_option(*command, "--array", options->array, a_place(), array_help)->needs(element);
  add_filter(*command, *options);
  add_rest(*command, *options);
  command->callback([options, &exit_code] {
    if (!options->element.empty() && (options->stream.says_anything() || !options->datum.empty()))
      throw CLI::ValidationError("--element",
                                 "points have no X_M and no datum: leave out what says of these");
    exit_code = execute(*options);
  });
}

}  // namespace trueaxis::cli

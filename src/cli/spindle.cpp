// SPDX-License-Identifier: Apache-2.0
#include "trueaxis/spindle.hpp"

#include <algorithm>
#include <iostream>
#include <memory>
#include <optional>
#include <vector>

#include "base/diagnostics.hpp"
#include "base/number.hpp"
#include "cli/check.hpp"
#include "cli/commands.hpp"
#include "cli/guarded.hpp"
#include "cli/options.hpp"
#include "cli/stream_options.hpp"
#include "format/outputs.hpp"
#include "measure/files/stream_csv_sensors.hpp"
#include "spindle/files/polar_svg.hpp"
#include "spindle/files/spindle_json.hpp"
#include "spindle/files/spindle_page.hpp"
#include "spindle/files/spindle_text.hpp"
#include "spindle/files/spindle_toml.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis::cli {
namespace {

struct OrderRange {
  int low = 2, high = 100;
};

struct SpindleArguments {
  std::vector<std::string> streams;
  StreamOptions meaning;
  std::vector<double> angles_deg;
  std::string orders = "2-100", json, svg, report;
  std::optional<double> sensitive_deg;
  double u_angle_deg = 0.0, u_reindex_deg = 0.0, coverage_factor = 2.0;
  double largest_condition = SpindleOptions{}.largest_condition, apart_deg = 20.0;
  int sensors = 0;
  bool advise = false, verbose = false, force = false, check = false;

  std::vector<double> angles_rad() const {
    std::vector<double> out = angles_deg;
    for (double& angle : out) angle *= rad_per_deg;
    return out;
  }
};

/// "2-100"; empty where it is no range of orders from 2 to 1000.
std::optional<OrderRange> parse_orders(const std::string& text) {
  const std::size_t dash = text.find('-');
  if (dash == std::string::npos) return std::nullopt;
  const std::string_view whole = text;
  const OrderRange range{whole_number<int>(whole.substr(0, dash)).value_or(0),
                         whole_number<int>(whole.substr(dash + 1)).value_or(0)};
  if (range.low < 2 || range.high < range.low || range.high > 1000) return std::nullopt;
  return range;
}

int propose(const SpindleArguments& options, const OrderRange& orders) {
  ProposeOptions task;
  if (options.sensors > 0)
    task.sensors = options.sensors;
  else if (!options.angles_deg.empty())
    task.sensors = static_cast<int>(options.angles_deg.size());
  task.order_min = orders.low;
  task.order_max = orders.high;
  task.least_apart_rad = options.apart_deg * rad_per_deg;
  std::cout << spindle_advice_text(propose_sensor_angles(task), options.angles_rad(), orders.low,
                                   orders.high, options.largest_condition);
  return done;
}

bool is_job(const std::string& path) { return path.ends_with(".toml"); }

/// A job says all of it: beside it neither streams nor what tells of them.
void expect_job_alone(const CLI::App& command, const SpindleArguments& options) {
  const auto job = std::ranges::find_if(options.streams, is_job);
  if (job == options.streams.end()) return;
  if (options.streams.size() > 1)
    throw CLI::ValidationError("stream", *job + " is a job and names its streams: give it alone");
  constexpr const char* beside[] = {"--json", "--svg", "--verbose", "--force", "--check", "--help"};
  for (const CLI::Option* option : command.get_options()) {
    const std::string name = option->get_name();
    if (option->count() == 0 || !name.starts_with("--") ||
        std::ranges::find(beside, name) != std::end(beside))
      continue;
    throw CLI::ValidationError(name, *job + " is a job: say it there or in the stream");
  }
}

/// What the command line says, or the job that it names.
SpindleJob job_of(const SpindleArguments& options, const OrderRange& orders) {
  if (is_job(options.streams.front())) return read_spindle_toml(options.streams.front());
  SpindleJob job;
  job.streams = options.streams;
  job.read = options.meaning.said();
  job.read.sensor_angles_rad = options.angles_rad();
  job.options = {
      orders.high,
      options.sensitive_deg ? std::optional(*options.sensitive_deg * rad_per_deg) : std::nullopt,
      options.u_angle_deg * rad_per_deg,
      options.u_reindex_deg * rad_per_deg,
      options.largest_condition,
      options.coverage_factor};
  return job;
}

int separate(const SpindleArguments& options, const OrderRange& orders) {
  SpindleJob job = job_of(options, orders);
  job.read.several_sensors = true;
  const std::vector<ProbeStream> streams = read_each(
      job.streams, [&](const std::string& path) { return read_stream_csv(path, job.read); });
  Outputs outputs(options.force);
  outputs.reads(options.streams.front());
  for (const std::string& path : job.streams) outputs.reads(path);
  outputs.may_write(options.json, "trueaxis.spindle");
  outputs.may_write(options.svg, "trueaxis.spindle_plot");
  outputs.may_write(options.report, "trueaxis.spindle_report");
  outputs.check();
  if (options.check)
    return checked(outputs, "separate part and spindle in " + std::to_string(streams.size()) +
                                " streams, orders 2 to " + std::to_string(orders.high));
  const SpindleResult result = separate_spindle(streams, job.options);
  if (!options.json.empty()) outputs.write(options.json, spindle_json(result, job.options));
  if (!options.svg.empty()) outputs.write(options.svg, polar_svg(result));
  if (!options.report.empty()) outputs.write(options.report, spindle_page(result));
  outputs.commit();
  if (options.json != "-" && options.svg != "-" && options.report != "-")
    std::cout << spindle_text(result, options.verbose);
  return done;
}

int execute(const SpindleArguments& options) {
  const auto orders = parse_orders(options.orders);
  if (!orders)
    throw CLI::ValidationError("--orders", options.orders + " is no range of orders such as 2-100");
  const std::string trouble = csv_sensor_angles_trouble(options.angles_deg);
  if (!trouble.empty()) throw CLI::ValidationError("--angles", trouble);
  if (options.advise) return propose(options, *orders);
  if (options.streams.empty()) throw CLI::RequiredError("stream");
  if (orders->low != 2) throw CLI::ValidationError("--orders", "a separation begins with order 2");
  return separate(options, *orders);
}

void add_estimate(CLI::App& command, SpindleArguments& options) {
  command
      .add_option("--sensitive-deg", options.sensitive_deg,
                  "direction of the tool from +X towards +Y (0)")
      ->check(number_in(-360.0, false, 360.0, "an angle of -360 to 360 deg"));
  command
      .add_option("--u-angle-deg", options.u_angle_deg, "standard uncertainty of a sensor's angle")
      ->check(number_in(0.0, false, 90.0, "an angle of 0 to 90 deg"));
  command.add_option("--u-reindex-deg", options.u_reindex_deg, "of the angle of a re-indexing")
      ->check(number_in(0.0, false, 90.0, "an angle of 0 to 90 deg"));
  command.add_option("--coverage-factor", options.coverage_factor, "k of U = k u (2)")
      ->check(number_in(0.0, true, 100.0, "a number above 0, up to 100"));
  command.add_option("--json", options.json, "write the result here (JSON), '-' prints it")
      ->check(a_place());
  command.add_option("--svg", options.svg, "write polar plots here (SVG), '-' prints them")
      ->check(a_place());
  command
      .add_option("--report", options.report,
                  "write a page here (HTML): values, polar plots, orders; '-' prints it")
      ->check(a_place());
  command.add_flag("--verbose", options.verbose, "a table of the orders too");
  add_force(command, options.force);
  add_check(command, options.check);
  options.meaning.add_meaning_to(command);
}

}  // namespace

void add_spindle(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand(
      "spindle", "form of the part and error motion of the spindle, separated (ISO 230-7)");
  auto options = std::make_shared<SpindleArguments>();
  command->add_option("stream", options->streams,
                      "probe streams (CSV) of one section: several sensors, set-ups, reversal, an "
                      "axial sensor; or one job (.toml)");
  command
      ->add_option("--angles", options->angles_deg,
                   "of the sensors X_M1, X_M2 …, deg from +X towards +Y: 0,99,202")
      ->delimiter(',');
  command->add_option("--orders", options->orders, "undulations per revolution (2-100)");
  command
      ->add_option("--largest-condition", options->largest_condition,
                   "an order with a larger condition number is suppressed (100)")
      ->check(number_in(1.0, false, 1e6, "a number of 1 to 1e6"));
  add_estimate(*command, *options);
  auto* advise = command->add_flag("--advise", options->advise,
                                   "propose angles of sensors, and judge those of --angles");
  command->add_option("--sensors", options->sensors, "how many (3)")
      ->check(CLI::Range(2, 16))
      ->needs(advise);
  command->add_option("--min-separation-deg", options->apart_deg, "between two sensors (20)")
      ->check(number_in(0.0, false, 120.0, "an angle of 0 to 120 deg"))
      ->needs(advise);
  command->callback([options, command, &exit_code] {
    if (!options->json.empty() && options->json == options->svg)
      throw CLI::ValidationError("--svg", "cannot go where --json goes");
    expect_job_alone(*command, *options);
    if (!options->report.empty() &&
        (options->report == options->json || options->report == options->svg))
      throw CLI::ValidationError("--report", "cannot go where --json or --svg goes");
    exit_code = execute(*options);
  });
}

}  // namespace trueaxis::cli

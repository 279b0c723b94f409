// SPDX-License-Identifier: Apache-2.0
#include "trueaxis/spindle.hpp"

#include <algorithm>
#include <iostream>
#include <memory>
#include <optional>
#include <vector>

#include "base/diagnostics.hpp"
#include "base/number.hpp"
#include "cli/commands.hpp"
#include "cli/guarded.hpp"
#include "cli/options.hpp"
#include "cli/results.hpp"
#include "cli/stream_options.hpp"
#include "cli/terminal.hpp"
#include "format/outputs.hpp"
#include "measure/files/stream_csv_sensors.hpp"
#include "spindle/files/spindle_files.hpp"
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
  std::string orders = "2-100";
  Results results;
  std::optional<double> sensitive_deg;
  double u_angle_deg = default_u_angle_rad / rad_per_deg, u_reindex_deg = u_angle_deg;
  double coverage_factor = 2.0;
  double largest_condition = SpindleOptions{}.largest_condition, apart_deg = 20.0;
  int sensors = 0;
  bool advise = false, verbose = false, check = false;

  std::vector<double> angles_rad() const {
    std::vector<double> out = angles_deg;
    for (double& angle : out) angle *= rad_per_deg;
    return out;
  }
};

/// "2-100"; empty if it is not a range of orders from 2 to 1000.
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

/// A job states everything: no streams or options for them next to it.
void expect_job_alone(const CLI::App& command, const SpindleArguments& options) {
  const auto job = std::ranges::find_if(options.streams, is_job);
  if (job == options.streams.end()) return;
  if (options.streams.size() > 1)
    throw CLI::ValidationError("stream", *job + " is a job and names its streams: give it alone");
  expect_only(command, {"stream", "--json", "--svg", "--verbose", "--force", "--check"},
              *job + " is a job: say it there or in the stream");
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
  const Results& results = options.results;
  Outputs outputs(results.force);
  outputs.reads(options.streams.front());
  results.name_to(outputs, job.streams);
  outputs.check();
  if (options.check)
    return checked(outputs, "separate part and spindle in " + std::to_string(streams.size()) +
                                " streams, orders 2 to " + std::to_string(orders.high));
  const SpindleResult result = separate_spindle(streams, job.options);
  results.write(outputs, "--json", [&] { return spindle_json(result, job.options); });
  results.write(outputs, "--svg", [&] { return polar_svg(result); });
  results.write(outputs, "--report", [&] { return spindle_page(result); });
  outputs.commit();
  if (!results.printed()) std::cout << spindle_text(result, options.verbose);
  return done;
}

int execute(const SpindleArguments& options) {
  const auto orders = parse_orders(options.orders);
  if (!orders)
    throw CLI::ValidationError("--orders",
                               options.orders + " is not a range of orders such as 2-100");
  const std::string trouble = csv_sensor_angles_trouble(options.angles_deg);
  if (!trouble.empty()) throw CLI::ValidationError("--angles-deg", trouble);
  if (options.advise) return propose(options, *orders);
  if (options.streams.empty()) throw CLI::RequiredError("stream");
  if (orders->low != 2) throw CLI::ValidationError("--orders", "a separation begins with order 2");
  return separate(options, *orders);
}

void add_estimate(CLI::App& command, SpindleArguments& options) {
  add_option(command, "--sensitive-deg", options.sensitive_deg,
             number_in(-360.0, false, 360.0, "an angle of -360 to 360 deg"),
             "direction of the tool from +X towards +Y, deg (default 0)");
  add_option(command, "--u-angle-deg", options.u_angle_deg,
             number_in(0.0, false, 90.0, "an angle of 0 to 90 deg"),
             "standard uncertainty of a sensor's angle, deg (default 0.5)");
  add_option(command, "--u-reindex-deg", options.u_reindex_deg,
             number_in(0.0, false, 90.0, "an angle of 0 to 90 deg"),
             "standard uncertainty of a re-indexing angle, deg (default 0.5)");
  add_coverage_factor(command, options.coverage_factor);
  Results& results = options.results;
  results.add(command, "--json", "trueaxis.spindle", "result (JSON); - prints it");
  results.add(command, "--svg", "trueaxis.spindle_plot", "polar plots (SVG)");
  results.add(command, "--report", "trueaxis.spindle_report",
              "report page with values, polar plots, orders (HTML)");
  add_verbose(command, options.verbose);
  add_usual(command, results.force, options.check);
  options.meaning.add_meaning_to(command);
}

}  // namespace

void add_spindle(CLI::App* command, int& exit_code) {
  auto options = std::make_shared<SpindleArguments>();
  command->add_option("stream", options->streams,
                      "probe streams (CSV) of one section, or one job (.toml)");
  command
      ->add_option("--angles-deg", options->angles_deg,
                   "angles of the sensors X_M1, X_M2 … from +X towards +Y, deg, as 0,99,202")
      ->delimiter(',');
  command->add_option("--orders", options->orders,
                      "orders, undulations per revolution (default 2-100)");
  add_option(*command, "--largest-condition", options->largest_condition,
             number_in(1.0, false, 1e6, "a number of 1 to 1e6"),
             "condition number above which an order is suppressed (default 100)");
  add_estimate(*command, *options);
  auto* advise = command->add_flag("--advise", options->advise,
                                   "propose angles of sensors, and judge those of --angles-deg");
  add_option(*command, "--sensors", options->sensors, CLI::Range(2, 16),
             "number of sensors for --advise (default 3)")
      ->needs(advise);
  add_option(*command, "--min-separation-deg", options->apart_deg,
             number_in(0.0, false, 120.0, "an angle of 0 to 120 deg"),
             "least angle between two sensors, deg (default 20)")
      ->needs(advise);
  command->callback([options, command, &exit_code] {
    expect_job_alone(*command, *options);
    exit_code = execute(*options);
  });
}

}  // namespace trueaxis::cli

// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <iostream>
#include <memory>

#include "cli/commands.hpp"
#include "cli/guarded.hpp"
#include "cli/machine_options.hpp"
#include "cli/options.hpp"
#include "cli/results.hpp"
#include "format/notes.hpp"
#include "format/outputs.hpp"
#include "format/text_layout.hpp"
#include "machine/files/errors_files.hpp"
#include "machine/limits.hpp"
#include "machine/sampled_errors.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis::cli {
namespace {

struct ErrorsArguments {
  MachineOptions machine;
  Results results;
  std::string at, format = "toml", output_sign;
  int points = 101;
  bool check = false;
};

/// "X=50,A=-35": mm and degrees, other axes at 0.
AxisPositions positions_of(const std::string& text, const Machine& machine) {
  AxisPositions axes{};
  std::array<bool, axis_count> there{};
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find(',', at), text.size());
    const std::string part = CLI::detail::trim_copy(text.substr(at, end - at));
    at = end + 1;
    const std::size_t letter =
        part.empty() ? std::string::npos : std::string("XYZABC").find(part[0]);
    double value = 0.0;
    if (letter == std::string::npos || part.size() < 3 || part[1] != '=' || there[letter] ||
        machine.find(static_cast<AxisName>(letter)) == nullptr ||
        !CLI::detail::lexical_cast(part.substr(2), value) || !std::isfinite(value))
      throw CLI::ValidationError(
          "--at",
          '"' + part + "\" is not a position of an axis of the machine, such as X=50 or A=-35");
    there[letter] = true;
    axes[letter] = letter >= 3 ? value * rad_per_deg : value;
  }
  return axes;
}

std::string converted(const ErrorsArguments& options, const Machine& machine,
                      const ErrorModel& errors) {
  const auto sign = sign_of(options.output_sign);
  if (options.format == "toml") return errors_toml(errors, &machine);
  return options.format == "isg" ? isg_csv_text(errors, machine, *sign, options.points)
                                 : etalon_text(errors, machine, *sign, options.points);
}

/// What a table of this many points loses.
std::string loss_line(const ErrorsArguments& options, const Machine& machine,
                      const ErrorModel& errors) {
  const SamplingLoss loss =
      sampling_loss(machine, errors, *sign_of(options.output_sign), options.points);
  return fmt::format(
      "table  {} points an axis, linear between them: each error is off by at most {} µm or "
      "{} µrad, and the tip by more, as errors add up and an angle acts at its lever; more "
      "--points lose less\n",
      options.points, layout::bound(loss.length_mm / mm_per_um),
      layout::bound(1e6 * loss.angle_rad));
}

int execute(const ErrorsArguments& options) {
  const Results& results = options.results;
  if (options.format != "toml" && results.asked("--output") && options.output_sign.empty())
    throw CLI::ValidationError("--output-sign",
                               "is needed: an " + options.format + " file does not say its sign");
  if (options.format == "toml" && !options.output_sign.empty())
    throw CLI::ValidationError("--output-sign", "is for --format etalon or isg");
  const MachineFile file = options.machine.read_machine();
  auto [errors, hashes, remarks] = options.machine.read_errors_of(file);
  const AxisPositions at = positions_of(options.at, file.machine);
  const std::string beyond = outside_known(errors, at);
  if (!beyond.empty() && !options.at.empty()) throw Refusal("--at: " + beyond);
  if (!beyond.empty()) remarks.push_back(beyond + ": say another position by --at");
  if (options.format != "toml")
    for (std::string& one : where_known(file.machine, errors)) remarks.push_back(std::move(one));
  Outputs outputs(results.force);
  outputs.reads(options.machine.machine);
  results.name_to(outputs, options.machine.errors);
  outputs.check();
  if (options.check) return checked(outputs, "list the errors of " + file.machine.name);
  results.write(outputs, "--json", [&] { return errors_json(file.machine, errors, at, remarks); });
  results.write(outputs, "--output", [&] { return converted(options, file.machine, errors); });
  outputs.commit();
  if (!results.printed())
    std::cout << errors_text(file.machine, errors, at)
              << (options.format != "toml" && results.asked("--output")
                      ? loss_line(options, file.machine, errors)
                      : "")
              << notes_screen(remarks);
  return done;
}

}  // namespace

void add_errors(CLI::App* command, int& exit_code) {
  auto options = std::make_shared<ErrorsArguments>();
  options->machine.add_machine_to(*command);
  options->machine.add_errors_to(*command);
  command->add_option("--at", options->at,
                      "position in mm and deg, as X=50,A=-35 (default all axes at 0)");
  options->results.add(*command, "--json", "trueaxis.errors_at", "result (JSON); - prints it");
  options->results.add(*command, "-o,--output", "trueaxis.errors", "errors of all files together");
  add_option(*command, "--format", options->format, one_of({"toml", "etalon", "isg"}),
             "format of --output (default toml)");
  add_option(*command, "--output-sign", options->output_sign, a_sign(),
             "sign of component errors in an etalon or isg file");
  add_option(*command, "--points", options->points, CLI::Range(2, 100000),
             "points of an etalon or isg table for an axis not yet tabulated (default 101)");
  add_usual(*command, options->results.force, options->check);
  command->callback([options, &exit_code] {
    if (options->format != "toml") options->results.say("--output", "trueaxis." + options->format);
    exit_code = execute(*options);
  });
}

}  // namespace trueaxis::cli

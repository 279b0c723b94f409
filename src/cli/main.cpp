// SPDX-License-Identifier: Apache-2.0
#include <glog/logging.h>

#include <algorithm>
#include <iostream>
#include <string>
#include <vector>

#include "cli/commands.hpp"
#include "cli/described.hpp"
#include "cli/guarded.hpp"
#include "format/nearest_key.hpp"
#include "trueaxis/error.hpp"

namespace {

/// Why the first word is no command, and which it may mean; empty where it is one.
std::string unknown_command(const CLI::App& app, int argc, char** argv) {
  const std::string word = argc > 1 ? argv[1] : "-";
  std::vector<std::string> names;
  for (const auto& command : trueaxis::cli::commands_of(app)) names.push_back(command.name);
  if (word.starts_with('-') || std::ranges::find(names, word) != names.end()) return "";
  const std::string near = trueaxis::nearest_key(word, names);
  return "trueaxis has no command " + word + (near.empty() ? "" : ", did you mean " + near + "?") +
         "\ntrueaxis --help lists all.\n";
}

int run(int argc, char** argv) {
  using namespace trueaxis::cli;
  CLI::App app{
      "TrueAxis finds where the reference surfaces of a clamped part really are, and what to "
      "correct."};
  app.set_version_flag("--version", "trueaxis " TRUEAXIS_VERSION);
  app.footer(
      "Exit codes: 0 done, 1 refused, tolerance not met or axis not known, 2 usage, 3 input, 4 "
      "numerical, 70 a "
      "bug.");
  int code = done;
  for (const auto add : {add_run,     add_init,      add_import,   add_fit,        add_diagnose,
                         add_advise,  add_correct,   add_simulate, add_sweep,      add_plan,
                         add_spindle, add_locate,    add_datum,    add_calibrate,  add_pose,
                         add_axes,    add_machine,   add_errors,   add_compensate, add_axis_bias,
                         add_effects, add_associate, add_form,     add_completion, add_man})
    add(app, code);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (const std::string why = unknown_command(app, argc, argv); !why.empty()) {
      std::cerr << why;
      return usage;
    }
    return app.exit(error) == 0 ? done : usage;
  }
  if (app.get_subcommands().empty()) {
    std::cerr << app.help();
    return usage;
  }
  if (!std::cout.flush()) throw trueaxis::InputError("standard output", "cannot be written");
  return code;
}

}  // namespace

int main(int argc, char** argv) {
  FLAGS_logtostderr = true;
  google::InitGoogleLogging(argv[0]);
  return trueaxis::cli::guarded([&] { return run(argc, argv); });
}

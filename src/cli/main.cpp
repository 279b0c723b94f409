// SPDX-License-Identifier: Apache-2.0
#include <glog/logging.h>

#include <iostream>

#include "cli/commands.hpp"
#include "cli/guarded.hpp"
#include "trueaxis/error.hpp"

namespace {

int run(int argc, char** argv) {
  using namespace trueaxis::cli;
  CLI::App app{
      "TrueAxis finds where the reference surfaces of a clamped part really are, and what to "
      "correct."};
  app.set_version_flag("--version", "trueaxis " TRUEAXIS_VERSION);
  app.footer(
      "Exit codes: 0 done, 1 refused or tolerance not met, 2 usage, 3 input, 4 numerical, 70 a "
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

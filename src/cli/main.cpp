// SPDX-License-Identifier: Apache-2.0
#include <glog/logging.h>

#include <iostream>

#include "cli/advise.hpp"
#include "cli/axis_bias.hpp"
#include "cli/correct.hpp"
#include "cli/diagnose.hpp"
#include "cli/effects.hpp"
#include "cli/fit.hpp"
#include "cli/guarded.hpp"
#include "cli/plan.hpp"
#include "cli/run.hpp"
#include "cli/simulate.hpp"
#include "cli/spindle.hpp"
#include "cli/sweep.hpp"
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
  add_run(app, code);
  add_fit(app, code);
  add_diagnose(app, code);
  add_advise(app, code);
  add_correct(app, code);
  add_simulate(app, code);
  add_sweep(app, code);
  add_plan(app, code);
  add_spindle(app, code);
  add_axis_bias(app, code);
  add_effects(app, code);
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

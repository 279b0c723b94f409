// SPDX-License-Identifier: Apache-2.0
// trueaxis-blind_machine: a blind study of the diagnosis of machines; see --help.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <fstream>

#include "blind_machine/study.hpp"
#include "support/places.hpp"

namespace {

using namespace trueaxis::blind_machine;

struct Arguments {
  std::size_t cases = 420;
  std::uint64_t seed = 20261123;
  std::vector<std::string> kinds;
  std::string command = places::command(), scratch = places::scratch(), json, only;
  int jobs = 2;
  bool keep = false, quiet = false, elsewhere = false;
};

void run(const Arguments& arguments) {
  std::vector<Kind> kinds;
  for (const Kind kind : all_kinds())
    if (arguments.kinds.empty() ||
        std::ranges::find(arguments.kinds, to_string(kind)) != arguments.kinds.end())
      kinds.push_back(kind);
  if (kinds.empty()) throw std::invalid_argument("--kinds names none of them");
  std::vector<Wanted> wanted = select(kinds, arguments.cases, arguments.seed);
  if (!arguments.only.empty()) wanted = {wanted_from(arguments.only)};
  std::printf("seed %llu, %zu cases\n", static_cast<unsigned long long>(arguments.seed),
              wanted.size());
  StudyOptions options;
  options.command = arguments.command;
  options.scratch = std::filesystem::path(arguments.scratch) / "blind_machine";
  options.keep = arguments.keep || !arguments.only.empty();
  options.jobs = arguments.jobs;
  options.elsewhere = arguments.elsewhere;
  options.progress = [&](std::size_t done, const Result& result) {
    if (!arguments.only.empty() ||
        (result.outcome != Outcome::correct && result.outcome != Outcome::no_advice))
      std::fprintf(stderr, "%s\n", result.line().c_str());
    if (!arguments.quiet && done % 20 == 0)
      std::fprintf(stderr, "%zu of %zu\n", done, wanted.size());
  };
  nlohmann::json json = tables(run_study(wanted, options));
  json["seed"] = arguments.seed;
  for (const auto& [kind, cell] : json["kinds"].items())
    std::printf("%-9s %3d of %3d  %5.1f %% (%.1f - %.1f)\n", kind.c_str(), cell["right"].get<int>(),
                cell["cases"].get<int>(), 100 * cell["rate"].get<double>(),
                100 * cell["low"].get<double>(), 100 * cell["high"].get<double>());
  if (!arguments.json.empty()) std::ofstream(arguments.json) << json.dump(1) << '\n';
  if (options.keep) std::printf("kept in %s\n", options.scratch.c_str());
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{
      "Measurements of the virtual machine with a hidden cause; trueaxis diagnose must name it."};
  Arguments to;
  app.add_option("--cases", to.cases, "how many, kinds x machines x plans in turn");
  app.add_option("--seed", to.seed, "of the study; printed");
  app.add_option("--kinds", to.kinds, "silent one two unknown absorbed advised")->delimiter(',');
  app.add_option("--jobs", to.jobs, "processes at a time");
  app.add_option("--json", to.json, "all tables, and the cases that are not right");
  app.add_option("--command", to.command, "the trueaxis command to judge");
  app.add_option("--scratch", to.scratch, "folder of the measurements");
  app.add_option("--only", to.only, "one case by its id, KIND-MACHINE-PLAN-SEED; kept");
  app.add_flag("--elsewhere", to.elsewhere, "how far the errors found are off at other positions");
  app.add_flag("--keep", to.keep, "keep measurements, truths and answers");
  app.add_flag("--quiet", to.quiet, "no progress");
  CLI11_PARSE(app, argc, argv);
  try {
    run(to);
  } catch (const std::exception& wrong) {
    std::fprintf(stderr, "trueaxis-blind_machine: %s\n", wrong.what());
    return 2;
  }
  return 0;
}

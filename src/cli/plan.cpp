// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <iostream>
#include <memory>
#include <utility>

#include "cli/commands.hpp"
#include "cli/guarded.hpp"
#include "cli/options.hpp"
#include "cli/probing_program.hpp"
#include "cli/results.hpp"
#include "cli/terminal.hpp"
#include "format/file.hpp"
#include "format/outputs.hpp"
#include "simulate/files/scenario_files.hpp"
#include "study/planning/files/planning_files.hpp"
#include "study/planning/probing_plan.hpp"
#include "trueaxis/error.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis::cli {
namespace {

namespace lathe = virtual_lathe;

/// A part and one helical pass, without a scenario's file.
struct Simple {
  std::string surface = "cone";
  double radius_mm = 40.0, half_angle_deg = 5.710593, length_mm = 60.0, feed_mm = 1.0;
  double per_revolution = 20.3, speed_rpm = 60.0, sigma_um = 2.0;
  bool bore = false;

  lathe::Scenario scenario() const {
    lathe::Scenario out;
    const bool cone = surface == "cone";
    out.part.kind = cone ? lathe::PartKind::cone : lathe::PartKind::cylinder;
    out.part.radius_mm = radius_mm, out.part.bore = bore;
    if (cone) out.part.half_angle_rad = half_angle_deg * rad_per_deg;
    out.noise.sigma_mm = sigma_um * mm_per_um;
    lathe::PlannedPass pass;
    pass.end_mm = length_mm, pass.feed_mm_per_rev = feed_mm;
    pass.readings_per_revolution = per_revolution, pass.speed_rpm = speed_rpm;
    out.plan.passes = {pass};
    return out;
  }
};

struct PlanArguments {
  std::string scenario;
  Results results;
  Simple simple;
  std::vector<std::string> free;
  double goal_um = 1.0;
  study::PlanningTask task;
  ProbingOption program;
  bool check = false;
};

/// A line for the search, then one for the simulations.
class PlanProgress {
 public:
  PlanProgress() = default;
  PlanProgress(const PlanProgress&) = delete;
  PlanProgress& operator=(const PlanProgress&) = delete;
  ~PlanProgress() { end(); }
  void operator()(study::PlanningStage stage, std::size_t done, std::size_t to_do) {
    if (!line_ || stage != stage_) {
      end();
      line_ = std::make_unique<Progress>(
          0, to_do, stage == study::PlanningStage::search ? "steps" : "simulations");
      stage_ = stage, done_ = 0;
    }
    line_->add(done - done_);
    done_ = done;
  }
  void end() {
    if (line_) line_->end();
    line_.reset();
  }

 private:
  std::unique_ptr<Progress> line_;
  study::PlanningStage stage_{};
  std::size_t done_ = 0;
};

/// The quickest of the recommended plans that the probe at hand reads.
const study::Recommendation* to_drive(const study::PlanningTask& task,
                                      const study::PlanningAnswer& answer) {
  const study::Recommendation* best = nullptr;
  for (const study::Recommendation& one : answer.recommended)
    if (one.plan.scenario.noise.sigma_mm >= task.base.noise.sigma_mm &&
        (best == nullptr || one.plan.time_s < best->plan.time_s))
      best = &one;
  return best;
}

/// Writes the program of a plan; what the screen says of it.
std::string write_program(const PlanArguments& options, const study::Recommendation* chosen,
                          Outputs& outputs) {
  if (chosen == nullptr)
    return "\nNo program is written: no plan is recommended that the probe at hand can read\n";
  const std::string& place = options.results["--output"];
  nc::ProbingPlan plan = study::probing_plan(chosen->plan.scenario);
  plan.what = fmt::format("{}: U of the {} is {:.3g} um by the bound, k = {:g}", chosen->what,
                          plan.surface == nc::ProbedSurface::face ? "face" : "axis",
                          chosen->plan.u_expanded_mm / mm_per_um, options.task.coverage_factor);
  const nc::ProbingProgram program = options.program.write({&plan, 1}, place);
  outputs.write(place, program.text);
  return "\nProgram of the plan " + chosen->what + "\n  " + ProbingOption::line(program, place);
}

int execute(PlanArguments options) {
  study::PlanningTask& task = options.task;
  std::string hash = content_hash("");
  if (options.scenario.empty()) {
    task.base = options.simple.scenario();
  } else {
    const std::string content = read_file(options.scenario);
    task.base = parse_scenario_toml(content, options.scenario);
    hash = content_hash(content);
    if (task.base.cut) throw InputError(options.scenario, "a plan probes a part: take [cut] out");
  }
  task.goal_mm = options.goal_um * mm_per_um;
  try {
    for (const std::string& text : options.free) {
      const study::DesignVariable variable = parse_design_variable(text);
      if (std::ranges::find(task.variables, variable.choice, &study::DesignVariable::choice) !=
          task.variables.end())
        throw InputError(text, "this choice has a range already: give it one");
      task.variables.push_back(variable);
    }
  } catch (const InputError& error) {
    throw CLI::ValidationError("--free", error.what());
  }
  const Results& results = options.results;
  Outputs outputs(results.force);
  if (!options.scenario.empty()) outputs.reads(options.scenario);
  options.program.read(results, outputs);
  results.name_to(outputs);
  outputs.check();
  if (options.program.asked()) study::probing_plan(task.base);
  if (options.check) return checked(outputs, "search the plans and confirm them by simulation");
  PlanProgress progress;
  const study::PlanningAnswer answer = study::plan_measurement(task, std::ref(progress));
  progress.end();
  results.write(outputs, "--json", [&] { return planning_json(task, answer, hash); });
  const bool drive = options.program.asked();
  const study::Recommendation* const chosen = drive ? to_drive(task, answer) : nullptr;
  const std::string program = drive ? write_program(options, chosen, outputs) : "";
  outputs.commit();
  if (!results.printed()) std::cout << planning_text(task, answer) << program;
  return answer.reached && answer.confirmed && (!drive || chosen) ? done : refused;
}

void add_simple(CLI::App& command, Simple& simple, CLI::Option* scenario) {
  const auto add = [&](const char* name, double& value, const char* what) {
    add_option(command, name, value, more_than_0(), what)
        ->capture_default_str()
        ->excludes(scenario)
        ->group("Without a scenario");
  };
  add_option(command, "--surface", simple.surface, one_of({"cone", "cylinder"}),
             "surface of the part")
      ->capture_default_str()
      ->excludes(scenario)
      ->group("Without a scenario");
  command.add_flag("--bore", simple.bore, "the part is probed from inside")
      ->excludes(scenario)
      ->group("Without a scenario");
  add("--radius-mm", simple.radius_mm, "radius where the pass starts, mm");
  add("--half-angle-deg", simple.half_angle_deg, "half angle of the cone, deg");
  add("--length-mm", simple.length_mm, "length of the pass, mm");
  add("--feed-mm", simple.feed_mm, "feed per revolution, mm");
  add("--per-revolution", simple.per_revolution, "readings per revolution");
  add("--speed-rpm", simple.speed_rpm, "spindle speed, rpm");
  add("--sigma-um", simple.sigma_um, "standard deviation of one reading, µm");
}

}  // namespace

void add_plan(CLI::App* command, int& exit_code) {
  auto options = std::make_shared<PlanArguments>();
  auto* scenario = command->add_option("scenario", options->scenario, "part and plan (TOML)");
  add_option(*command, "--goal-um", options->goal_um, more_than_0(),
             "largest U of the axis over the length, or of a face's height, µm")
      ->capture_default_str();
  add_option(*command, "--coverage-factor", options->task.coverage_factor, more_than_0(),
             "k of U = k u")
      ->capture_default_str();
  command
      ->add_option("--free", options->free,
                   "range of readings_per_revolution, sigma_um, feed_mm_per_rev or length_mm")
      ->type_name("KEY=LOW:HIGH");
  add_option(*command, "--time-s", options->task.time_s, more_than_0(),
             "longest time of the measurement, s");
  add_option(*command, "--rate-hz", options->task.rate_hz, more_than_0(),
             "readings per second of the probe, Hz");
  add_option(*command, "--repeats", options->task.repeats, CLI::Range(100, 10'000'000),
             "simulations for each confirmation")
      ->capture_default_str();
  command->add_option("--seed", options->task.seed, "seed of the simulations")
      ->capture_default_str();
  add_threads(*command, options->task.threads);
  options->program.add_to(*command);
  options->results.add(*command, "-o,--output", "trueaxis.probing_program",
                       "program of the quickest plan recommended, with --control");
  options->results.add(*command, "--json", "trueaxis.plan", "result (JSON); - prints it");
  add_usual(*command, options->results.force, options->check);
  add_simple(*command, options->simple, scenario);
  command->callback([options, &exit_code] { exit_code = execute(*options); });
}

}  // namespace trueaxis::cli

// SPDX-License-Identifier: Apache-2.0
#include "format/file.hpp"
#include "simulate/machine/files/machine_scenario_files.hpp"

namespace trueaxis {

CutScenario read_cut_scenario_toml(const std::string& path, const std::string& program) {
  CutScenario out;
  TomlDocument document(path);
  TomlTable root = document.root();
  TomlTable machine = root.required_table("machine");
  TomlTable cut = root.required_table("cut");
  out.of = read_scenario_machine(machine, cut, document);
  virtual_machine::CutPlan& plan = out.plan;
  const std::string said = cut.required_path("program");
  plan.program_file = program.empty() ? said : program;
  plan.nominal_file = cut.maybe_path("nominal").value_or(said);
  plan.step_mm = cut.maybe_number("step_mm", Range::positive());
  plan.step_rad = cut.maybe_number("step_rad", Range::positive());
  if (std::optional<TomlTable> by = cut.maybe_table("disturbance"))
    plan.disturbance = read_disturbance(*by, out.of.machine, false);
  document.finish();
  plan.program = read_file(plan.program_file);
  plan.nominal =
      plan.nominal_file == plan.program_file ? plan.program : read_file(plan.nominal_file);
  out.of.read.push_back(plan.program_file);
  if (plan.nominal_file != plan.program_file) out.of.read.push_back(plan.nominal_file);
  return out;
}

}  // namespace trueaxis

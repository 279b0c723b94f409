// SPDX-License-Identifier: Apache-2.0
#include "cli/machine_options.hpp"

#include <iostream>

#include "cli/guarded.hpp"
#include "cli/options.hpp"
#include "format/outputs.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis::cli {

void MachineOptions::add_machine_to(CLI::App& command) {
  command.add_option("--machine", machine, "machine (TOML, trueaxis.machine/1)")
      ->required()
      ->type_name("FILE")
      ->group(machine_group);
}

void MachineOptions::add_errors_to(CLI::App& command) {
  command
      .add_option("--errors", errors,
                  "known errors (.toml, ISG .csv, or Etalon format); several files add")
      ->type_name("FILE")
      ->group(machine_group);
  add_option(command, "--sign", sign, a_sign(), "sign in ISG and Etalon files")
      ->group(machine_group);
  command
      .add_flag("--large-errors", large_errors,
                "accept implausibly large errors (the units are correct)")
      ->group(machine_group);
}

void MachineOptions::add_work_offset_to(CLI::App& command) {
  add_option(command, "--work-offset", work_offset,
             one_of({"G54", "G55", "G56", "G57", "G58", "G59"}), "program frame (default G54)")
      ->group(machine_group);
}

MachineFile MachineOptions::read_machine() const { return read_machine_toml(machine); }

ErrorsOfFiles MachineOptions::read_errors_of(const MachineFile& file) const {
  return read_errors_files(errors, file, {sign_of(sign), large_errors});
}

Setting MachineOptions::setting_of(const Machine& of) const {
  Setting setting = first_setting(of);
  const auto index = static_cast<std::size_t>(work_offset.back() - '4');
  if (of.work_offsets[index])
    setting.bed_from_program = of.work_offsets[index]->bed_from_program;
  else if (work_offset != "G54")
    throw InputError(machine, "has no [workpiece." + work_offset + ']');
  return setting;
}

void TableOutput::add_to(CLI::App& command, const std::string& schema) {
  results.add(command, "-o,--output", schema, "table (CSV, default printed)");
  add_json(command, results, schema);
  add_usual(command, results.force, check);
}

int TableOutput::print_or_write(const std::string& schema, const std::string& table,
                                const Json& rows, const std::vector<std::string>& read,
                                const std::string& would) const {
  Outputs outputs(results.force);
  results.name_to(outputs, read);
  outputs.check();
  if (check) return checked(outputs, would);
  const std::string& place = results["--output"];
  if (place == "-" || (place.empty() && !results.printed()))
    std::cout << table;
  else if (!place.empty())
    outputs.write(place, "# schema: " + schema + "/1\n" + table);
  results.write(outputs, "--json", [&] {
    return json_text({{"schema", schema + "/1"}, {"rows", rows}});
  });
  outputs.commit();
  return done;
}

std::optional<ErrorSign> sign_of(const std::string& word) {
  if (word.empty()) return std::nullopt;
  return word == "moving_part" ? ErrorSign::moving_part : ErrorSign::tool_minus_workpiece;
}

CLI::Validator a_sign() { return CLI::IsMember({"moving_part", "tool_minus_workpiece"}); }

}  // namespace trueaxis::cli

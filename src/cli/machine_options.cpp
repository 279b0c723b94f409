// SPDX-License-Identifier: Apache-2.0
#include "cli/machine_options.hpp"

#include <iostream>

#include "cli/options.hpp"
#include "format/outputs.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis::cli {

void MachineOptions::add_machine_to(CLI::App& command) {
  command.add_option("machine", machine, "a machine (TOML, trueaxis.machine/1)")->required();
}

void MachineOptions::add_errors_to(CLI::App& command) {
  command.add_option("--errors", errors,
                     "errors of the machine: trueaxis.errors/1 (.toml), an ISG table (.csv), the "
                     "Etalon exchange format (other names); several files add");
  add_option(command, "--sign", sign, a_sign(),
             "what component errors in ISG and Etalon files are of: the part that moves, or tool "
             "minus workpiece");
  command.add_flag("--large-errors", large_errors,
                   "the errors are larger than machines have, and in the unit that is said");
}

void MachineOptions::add_work_offset_to(CLI::App& command) {
  add_option(command, "--work-offset", work_offset,
             one_of({"G54", "G55", "G56", "G57", "G58", "G59"}),
             "the program frame: G54 … G59 (G54)");
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

void TableOutput::add_to(CLI::App& command) {
  add_option(command, "-o,--output", place, a_place(), "write here instead of printing");
  add_force(command, force);
}

void TableOutput::print_or_write(const std::string& schema, const std::string& table,
                                 const std::vector<std::string>& read) const {
  if (place.empty() || place == "-") {
    std::cout << table;
    return;
  }
  Outputs outputs(force);
  for (const std::string& path : read) outputs.reads(path);
  outputs.may_write(place, schema);
  outputs.check();
  outputs.write(place, "# schema: " + schema + "/1\n" + table);
  outputs.commit();
}

std::optional<ErrorSign> sign_of(const std::string& word) {
  if (word.empty()) return std::nullopt;
  return word == "moving_part" ? ErrorSign::moving_part : ErrorSign::tool_minus_workpiece;
}

CLI::Validator a_sign() { return CLI::IsMember({"moving_part", "tool_minus_workpiece"}); }

}  // namespace trueaxis::cli

// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <utility>

#include "base/diagnostics.hpp"
#include "calibrate/files/measurement_csv.hpp"
#include "compensate/program_axes.hpp"
#include "format/file.hpp"
#include "format/toml_header.hpp"
#include "format/toml_reader.hpp"
#include "job/machine/files/machine_job_files.hpp"
#include "machine/files/errors_files.hpp"
#include "machine/files/machine_toml.hpp"
#include "nc/program.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis {
namespace {

/// What the job says, before the files that it names are read.
struct Said {
  std::string machine, program;
  std::vector<std::string> errors, data;
  ErrorsFiles of_errors;
};

/// A list of files, relative to the folder of the job.
std::vector<std::string> paths(TomlTable& table, const char* key, const std::string& job) {
  std::vector<std::string> list = table.texts(key);
  for (std::string& name : list) {
    if (name.empty()) table.complain(key, "holds an empty name: name a file");
    name = path_next_to(job, name);
  }
  std::vector<std::string> once;
  for (const std::string& name : list)
    if (std::ranges::find(once, name) == once.end())
      once.push_back(name);
    else
      table.complain(key, "names " + name + " twice");
  return once;
}

void read_machine(TomlTable table, Said& said, const std::string& job) {
  said.machine = table.required_path("file");
  said.errors = paths(table, "errors", job);
  if (table.has("sign"))
    said.of_errors.foreign_sign =
        table.choice<ErrorSign>("sign",
                                {{"moving_part", ErrorSign::moving_part},
                                 {"tool_minus_workpiece", ErrorSign::tool_minus_workpiece}},
                                ErrorSign::moving_part);
  said.of_errors.large_errors = table.flag("large_errors", false);
}

void read_measure(TomlTable table, Said& said, MachineJob& job) {
  said.data = paths(table, "data", job.path);
  if (said.data.empty())
    table.complain("data", table.has("data") ? "is empty: name the files of the measurement"
                                             : "is missing: data = [\"ball.csv\"], the files of "
                                               "the measurement");
  job.false_alarm = table.number("false_alarm", job.false_alarm, Range::inside(0.0, 0.5));
}

void read_program(TomlTable table, Said& said, MachineJob& job) {
  MachineJobProgram program;
  program.file = said.program = table.required_path("file");
  CompensationOptions& options = program.options;
  options.method = table.choice<CompensationMethod>(
      "method",
      {{"exact", CompensationMethod::exact}, {"differential", CompensationMethod::differential}},
      CompensationMethod::exact);
  options.rotary = table.choice<RotaryUse>(
      "rotary", {{"moved", RotaryUse::moved}, {"all", RotaryUse::all}}, RotaryUse::moved);
  const Range length{0.0, 10.0, true, false};
  options.tolerance_mm = table.maybe_number("tolerance_mm", length);
  options.arc_tolerance_mm = table.maybe_number("arc_tolerance_mm", {0.0, 1.0, true, false});
  options.decimals = static_cast<int>(table.integer("decimals", options.decimals, 0, 15));
  options.angle_decimals =
      static_cast<int>(table.integer("angle_decimals", options.angle_decimals, 0, 15));
  job.program = std::move(program);
}

void read_part(TomlTable table, MachineJob& job) {
  const double tolerance_mm = table.required_number("tolerance_mm", Range::positive());
  job.tolerance_mm = tolerance_mm;
  if (!job.program)
    return table.complain("tolerance_mm",
                          "has no effect without a [program]: add it, or remove [part]");
  const auto& pieces_mm = job.program->options.tolerance_mm;
  if (pieces_mm && *pieces_mm >= tolerance_mm)
    table.complain("tolerance_mm",
                   "is not larger than that of [program], by which blocks are split: make "
                   "[program] tolerance_um smaller, because uncertainty needs a share as well");
}

/// What `read` gives; what is wrong goes to the other diagnostics of the job.
template <class Read>
auto collected(TomlDocument& document, const Read& read) -> std::optional<decltype(read())> {
  std::optional<decltype(read())> out;
  gather(document, [&] { out = read(); });
  return out;
}

void read_data(TomlDocument& document, const Said& said, MachineJob& job) {
  const auto data = collected(document, [&] { return read_measurements(said.data, job.machine); });
  if (!data) return;
  job.data = *data;
  for (std::size_t i = 0; i < job.data.size(); ++i)
    job.inputs.push_back({"measurement", said.data[i], job.data[i].input_hash});
}

void read_program_file(TomlDocument& document, MachineJob& job) {
  MachineJobProgram& program = *job.program;
  const auto text = collected(document, [&] { return read_file(program.file); });
  if (!text) return;
  program.text = *text;
  job.inputs.push_back({"program", program.file, content_hash(program.text)});
  const ProgramAxes axes(job.machine);
  const auto read = collected(document, [&] {
    return nc::read_program(program.text, program.file,
                            axes.read_options(program.options.arc_tolerance_mm));
  });
  if (read && read->moves.empty())
    document.add({program.file, 0, 0, "does not move: name the program that cuts the part"});
}

void read_files(TomlDocument& document, const Said& said, MachineJob& job) {
  if (said.machine.empty()) return;
  const auto file = collected(document, [&] { return read_machine_toml(said.machine); });
  if (!file) return;
  job.machine = file->machine;
  job.inputs.push_back({"machine", said.machine, file->hash});
  if (const auto known = collected(
          document, [&] { return read_errors_files(said.errors, *file, said.of_errors); })) {
    job.known = known->errors;
    job.remarks_of_known = known->remarks;
    for (std::size_t i = 0; i < said.errors.size(); ++i)
      job.inputs.push_back({"errors known before", said.errors[i], known->hashes[i]});
  }
  if (!said.data.empty()) read_data(document, said, job);
  if (job.program && !said.program.empty()) read_program_file(document, job);
}

}  // namespace

bool is_machine_job(std::string_view content, const std::string& path) {
  TomlDocument document(content, path);
  const std::vector<std::string> keys = document.root().keys();
  return std::ranges::any_of(
      std::array{"machine", "measure", "program", "part"},
      [&](const char* key) { return std::ranges::find(keys, key) != keys.end(); });
}

MachineJob read_machine_job_toml(std::string_view content, const std::string& path) {
  TomlDocument document(content, path);
  TomlTable root = document.root();
  MachineJob job;
  job.path = path;
  job.name = root.text("name", path);
  job.header = read_header(root);
  job.inputs.push_back({"job", path, content_hash(content)});
  Said said;
  read_machine(root.required_table("machine"), said, path);
  read_measure(root.required_table("measure"), said, job);
  if (auto program = root.maybe_table("program")) read_program(*program, said, job);
  if (auto part = root.maybe_table("part")) read_part(*part, job);
  for (const char* key : {"reference", "target", "sensor", "cut", "actuator", "correction"})
    if (root.has(key))
      root.complain(key,
                    "belongs to a lathe's job, and [machine] to a machine's job: write two jobs");
  read_files(document, said, job);
  document.finish();
  return job;
}

}  // namespace trueaxis

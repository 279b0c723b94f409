// SPDX-License-Identifier: Apache-2.0
#include "recording/import.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <iostream>
#include <memory>

#include "base/counted.hpp"
#include "cli/commands.hpp"
#include "cli/guarded.hpp"
#include "cli/results.hpp"
#include "cli/stream_options.hpp"
#include "format/json.hpp"
#include "format/outputs.hpp"
#include "format/shell.hpp"
#include "format/text_layout.hpp"
#include "job/files/starter.hpp"

namespace trueaxis::cli {
namespace {

struct ImportArguments {
  StreamOptions stream;
  std::string output, job, axis;
  Results results;
  bool check = false;
};

/// Next to the stream, with another ending.
std::string job_place(const ImportArguments& options) {
  if (!options.job.empty() || options.output == "-") return options.job;
  return std::filesystem::path(options.output).replace_extension(".toml").string();
}

/// A read-out of an axis is a measurement of a machine, not a stream.
int import_axis(const ImportArguments& options) {
  const ImportedReadOut imported =
      import_read_out(options.stream.path, options.axis.front(), options.stream.recording());
  Outputs outputs(options.results.force);
  outputs.reads(options.stream.path);
  outputs.may_begin(options.output, imported.text, "trueaxis.measurement");
  options.results.name_to(outputs);
  outputs.check();
  if (options.check) return checked(outputs, "convert " + counted(imported.rows, "position"));
  outputs.write(options.output, imported.text);
  options.results.write(outputs, "--json", [&] {
    return json_text({{"schema", "trueaxis.import/1"},
                      {"source", options.stream.path},
                      {"axis", options.axis},
                      {"positions", imported.rows},
                      {"measurement", options.output},
                      {"notes", imported.notes}});
  });
  outputs.commit();
  if (options.output == "-" || options.results.printed()) return done;
  for (const std::string& note : imported.notes) std::cout << layout::wrapped("", note);
  std::cout << fmt::format("axis {}  {} ({})\n", options.axis, options.output,
                           counted(imported.rows, "position"));
  std::cout << "next    "
            << shell_line({"trueaxis", "machine", "calibrate", options.output, "--machine",
                           "MACHINE.toml"})
            << '\n';
  return done;
}

int execute(const ImportArguments& options) {
  if (!options.axis.empty()) return import_axis(options);
  const std::string job = job_place(options);
  const ImportedRecording imported =
      import_recording(options.stream.path, options.stream.recording());
  const std::string stub = job_stub(options.output, imported.stream);
  Outputs outputs(options.results.force);
  outputs.reads(options.stream.path);
  outputs.may_begin(options.output, imported.text, "trueaxis.stream");
  outputs.may_begin(job, stub);
  options.results.name_to(outputs);
  outputs.check();
  if (options.check)
    return checked(outputs, "convert " + counted(imported.stream.size(), "reading"));
  outputs.write(options.output, imported.text);
  outputs.write(job, stub);
  options.results.write(outputs, "--json", [&] {
    return json_text({{"schema", "trueaxis.import/1"},
                      {"source", imported.stream.source},
                      {"producer", imported.producer},
                      {"readings", imported.stream.size()},
                      {"stream", options.output},
                      {"job", job},
                      {"notes", imported.notes}});
  });
  outputs.commit();
  if (options.output == "-" || options.results.printed()) return done;
  for (const std::string& note : imported.notes) std::cout << layout::wrapped("", note);
  std::cout << fmt::format("stream  {} ({})\n", options.output,
                           counted(imported.stream.size(), "reading"));
  if (!job.empty())
    std::cout << "job     " << job << "  (" << shell_line({"trueaxis", "run", job, "-o", "result"})
              << ")\n";
  return done;
}

}  // namespace

void add_import(CLI::App* command, int& exit_code) {
  auto options = std::make_shared<ImportArguments>();
  options->stream.add_to(
      *command,
      "spreadsheet (CSV, text), LinuxCNC probe log or halsampler, DPRNT, camonitor, "
      "TwinCAT Scope");
  add_place(*command, "-o,--output", options->output, "stream (CSV); - prints it")->required();
  CLI::Option* const job =
      add_place(*command, "--job", options->job, "job (TOML, default next to the stream)");
  add_option(*command, "--axis", options->axis, one_of({"X", "Y", "Z", "A", "B", "C"}),
             "axis of a machine that the file is a read-out of, against a scale or laser")
      ->excludes(job);
  options->results.add(*command, "--json", "trueaxis.import", "what was read (JSON); - prints it");
  add_usual(*command, options->results.force, options->check);
  command->callback([options, &exit_code] { exit_code = execute(*options); });
}

}  // namespace trueaxis::cli

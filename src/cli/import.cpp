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
  std::string output, job;
  Results results;
  bool check = false;
};

/// Next to the stream, with another ending.
std::string job_place(const ImportArguments& options) {
  if (!options.job.empty() || options.output == "-") return options.job;
  return std::filesystem::path(options.output).replace_extension(".toml").string();
}

int execute(const ImportArguments& options) {
  const std::string job = job_place(options);
  const ImportedRecording imported =
      import_recording(options.stream.path, options.stream.recording());
  const std::string stub = job_stub(options.output, imported.stream);
  Outputs outputs(options.results.force);
  outputs.reads(options.stream.path);
  outputs.may_write(options.output, "trueaxis.stream");
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
  add_place(*command, "--job", options->job, "job (TOML, default next to the stream)");
  options->results.add(*command, "--json", "trueaxis.import", "what was read (JSON); - prints it");
  add_force(*command, options->results.force);
  add_check(*command, options->check);
  command->callback([options, &exit_code] { exit_code = execute(*options); });
}

}  // namespace trueaxis::cli

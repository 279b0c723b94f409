// SPDX-License-Identifier: Apache-2.0
#include <iostream>
#include <memory>

#include "cli/commands.hpp"
#include "cli/guarded.hpp"
#include "cli/options.hpp"
#include "format/outputs.hpp"
#include "job/files/starter.hpp"

namespace trueaxis::cli {

void add_init(CLI::App* command, int& exit_code) {
  struct Options {
    std::string folder;
    bool force = false, check = false;
  };
  auto options = std::make_shared<Options>();
  add_option(*command, "folder", options->folder, a_place(), "folder for the files, new or empty")
      ->required();
  add_usual(*command, options->force, options->check);
  command->callback([options, &exit_code] {
    Outputs outputs(options->force);
    outputs.into(options->folder);
    for (const StarterFile& file : starter_files())
      outputs.may_begin(outputs.in_folder(std::string(file.name)), std::string(file.text));
    outputs.check();
    if (options->check) {
      exit_code = checked(outputs, "write files to begin with");
      return;
    }
    for (const StarterFile& file : starter_files())
      outputs.write(outputs.in_folder(std::string(file.name)), file.text);
    outputs.commit();
    for (const StarterFile& file : starter_files())
      std::cout << outputs.in_folder(std::string(file.name)) << '\n';
    exit_code = done;
  });
}

}  // namespace trueaxis::cli

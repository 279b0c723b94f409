// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace trueaxis::cli {

/// The program with the words after its name. It writes to standard output and standard error.
/// @returns the exit code @throws as the library does: see guarded()
int run_program(const std::vector<std::string>& words);

/// Whether the words are files alone, as a desktop hands over what is dropped on the program. They
/// have an extension, which no command has.
bool are_files(const std::vector<std::string>& words);

/// `run` of each file. The results go next to it, and the browser shows the report if the system is
/// one where files are dropped on programs. The highest of the exit codes.
int run_files(const std::vector<std::string>& files);

/// Keeps a window that would close with the program open until the user has read it.
void keep_window_open();

struct NewNames {
  std::vector<std::string> words;  ///< the command line in today's names, without "trueaxis"
  std::string notes;               ///< a line for each old name, empty: no old name
};

NewNames with_new_names(std::vector<std::string> words);

}  // namespace trueaxis::cli

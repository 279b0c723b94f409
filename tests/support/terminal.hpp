// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <pty.h>
#include <sys/ioctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <string>

#include "support/places.hpp"

/// The command on a terminal, as a person sees it.
namespace trueaxis::testing {

struct TerminalRun {
  int exit_code = -1;
  std::string shown;  ///< all that was written to the terminal, escapes too
};

/// `sh -c COMMAND` in `folder` on a pseudo-terminal of so many columns; `trueaxis` stands for the
/// command under test, and $T for its path.
inline TerminalRun on_terminal(const std::filesystem::path& folder, const std::string& command,
                               unsigned short columns = 80) {
  winsize size{40, columns, 0, 0};
  int master = -1;
  const pid_t child = forkpty(&master, nullptr, nullptr, &size);
  if (child == 0) {
    const std::string line = "cd '" + folder.string() + "' && T='" + places::command() +
                             "' && trueaxis() { \"$T\" \"$@\"; } && " + command;
    execl("/bin/sh", "sh", "-c", line.c_str(), static_cast<char*>(nullptr));
    _exit(127);
  }
  TerminalRun run;
  char buffer[4096];
  for (ssize_t n; (n = read(master, buffer, sizeof buffer)) > 0;)
    run.shown.append(buffer, static_cast<std::size_t>(n));
  int status = 0;
  waitpid(child, &status, 0);
  close(master);
  run.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return run;
}

}  // namespace trueaxis::testing

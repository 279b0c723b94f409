// SPDX-License-Identifier: Apache-2.0
#include <glog/logging.h>

#include "cli/guarded.hpp"
#include "cli/program.hpp"
#include "platform/memory.hpp"
#include "platform/terminal.hpp"

int main(int argc, char** argv) {
  using namespace trueaxis;
  platform::keep_freed_memory();
  FLAGS_logtostderr = true;
  FLAGS_minloglevel = google::GLOG_FATAL;  // what Ceres says is in FitStatus
  google::InitGoogleLogging(argv[0]);
  const std::vector<std::string> words = platform::begin_program(argc, argv);
  const bool dropped = cli::are_files(words);
  const int code =
      dropped ? cli::run_files(words) : cli::guarded([&] { return cli::run_program(words); });
  if (dropped || words.empty()) cli::keep_window_open();
  return code;
}

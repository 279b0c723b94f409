// SPDX-License-Identifier: Apache-2.0
#include <glog/logging.h>

#include "cli/guarded.hpp"
#include "cli/program.hpp"

int main(int argc, char** argv) {
  FLAGS_logtostderr = true;
  google::InitGoogleLogging(argv[0]);
  return trueaxis::cli::guarded([&] {
    return trueaxis::cli::run_program({argv + 1, argv + argc});
  });
}

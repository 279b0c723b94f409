// SPDX-License-Identifier: Apache-2.0
// scripts/setup where an archive cannot be reached: package managers of the test's own stand in for
// the real ones. What is needed to run asks no npm; an install that fails says what and why.
#include <gtest/gtest.h>

#include "support/command.hpp"
#include "support/places.hpp"

namespace trueaxis::testing {
namespace {

namespace fs = std::filesystem;

class InstallScript : public ::testing::Test {
 protected:
  void SetUp() override {
    const std::string test = ::testing::UnitTest::GetInstance()->current_test_info()->name();
    folder_ = fresh_folder("install_" + test);
    fs::create_directories(folder_ / "scripts");
    for (const char* file : {"setup", "packages.txt"})
      fs::copy_file(fs::path(places::source()) / "scripts" / file, folder_ / "scripts" / file);
    fs::create_directories(folder_ / "bin");
    stand_in("dpkg-query", "echo install ok installed");
    stand_in("apt-get", "exit 0");
    stand_in("npm", "echo called >>npm_was_called");
    stand_in("node", "exit 0");
  }
  void stand_in(const std::string& name, const std::string& does) const {
    const fs::path place = folder_ / "bin" / name;
    write_text(place, "#!/bin/sh\n" + does + "\n");
    fs::permissions(place, fs::perms::owner_all);
  }
  CommandResult set_up(const std::string& use) const {
    return shell("cd '" + folder_.string() + "' && PATH=\"$PWD/bin:$PATH\" scripts/setup " + use);
  }
  fs::path folder_;
};

TEST_F(InstallScript, ToRunNothingIsAskedOfNpm) {
  stand_in("npm", "echo called >>npm_was_called; exit 1");
  const CommandResult result = set_up("run");
  EXPECT_EQ(result.exit_code, 0) << result.output;
  EXPECT_EQ(result.output, "setup: everything is installed\n");
  EXPECT_FALSE(fs::exists(folder_ / "npm_was_called"));
}

TEST_F(InstallScript, ARegistryThatIsNotReachedIsSaid) {
  stand_in("npm", "echo 'npm error network request to its registry failed' >&2; exit 7");
  const CommandResult result = set_up("test");
  EXPECT_EQ(result.exit_code, 1);
  for (const char* said : {"playwright-core@", " could not be installed: the tests of the report",
                           "it ended with 7 and said:\n    npm error network request",
                           "setup: when the npm registry can be reached"})
    EXPECT_NE(result.output.find(said), std::string::npos) << result.output;
  EXPECT_FALSE(fs::exists(folder_ / "build/npm/installed"));
}

TEST_F(InstallScript, AnArchiveThatIsNotReachedIsSaid) {
  stand_in("dpkg-query", "exit 1");
  stand_in("sudo", "exec \"$@\"");
  stand_in("apt-get", "echo 'E: Failed to fetch its index' >&2; exit 100");
  const CommandResult result = set_up("run");
  EXPECT_EQ(result.exit_code, 1);
  for (const char* said : {"the list of Debian's packages could not be read",
                           "it ended with 100 and said:\n    E: Failed to fetch its index",
                           "or: apt-get install build-essential"})
    EXPECT_NE(result.output.find(said), std::string::npos) << result.output;
}

TEST_F(InstallScript, WhatWorksIsSilentAndDoneOnce) {
  EXPECT_EQ(set_up("test").exit_code, 0);
  EXPECT_EQ(set_up("test").output, "setup: everything is installed\n");
  EXPECT_EQ(read_text(folder_ / "npm_was_called"), "called\n");
}

}  // namespace
}  // namespace trueaxis::testing

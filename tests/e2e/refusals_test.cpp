// SPDX-License-Identifier: Apache-2.0
// Wrong jobs, streams and layouts of files as data: every file of tests/refusals is one test.
#include <unistd.h>

#include <map>

#include "support/command_fixture.hpp"
#include "support/places.hpp"
#include "support/refusal_case.hpp"

namespace trueaxis::testing {
namespace {

namespace fs = std::filesystem;

const fs::path refusals = fs::path(places::source()) / "tests/refusals";

std::vector<std::string> refusal_files() {
  std::vector<std::string> names = files_in(refusals);
  std::erase_if(names, [](const std::string& name) { return !name.ends_with(".toml"); });
  return names;
}

class Refusals : public CommandTest, public ::testing::WithParamInterface<std::string> {
 protected:
  void TearDown() override {
    for (const std::string& name : locked_) fs::permissions(folder_ / name, fs::perms::owner_all);
  }

  void prepare(const RefusalCase& wrong) {
    for (const auto& [name, text] : wrong.files) {
      fs::create_directories((folder_ / name).parent_path());
      file(name, text);
    }
    for (const std::string& line : wrong.prepare) {
      const CommandStreams done = command(line);
      // Its files are written where nothing but its axis is not known.
      const bool no_axis =
          done.exit_code == 1 && done.err.find("the axis is not known") != std::string::npos;
      ASSERT_TRUE(done.exit_code == 0 || no_axis) << line << '\n' << done.out << done.err;
    }
    for (const RefusalCase::Edit& edit : wrong.edits) {
      std::string text = read_text(folder_ / edit.file);
      std::size_t at = text.find(edit.replace);
      ASSERT_NE(at, std::string::npos) << edit.file << " holds no " << edit.replace;
      for (; at != std::string::npos; at = text.find(edit.replace, at + edit.by.size()))
        text.replace(at, edit.replace.size(), edit.by);
      file(edit.file, text);
    }
    for (const RefusalCase::Link& link : wrong.links) {
      fs::create_directories((folder_ / link.name).parent_path());
      if (link.hard) {
        fs::create_hard_link(folder_ / link.target, folder_ / link.name);
      } else {
        fs::create_symlink(link.target, folder_ / link.name);
      }
    }
    for (const std::string& name : wrong.read_only) {
      fs::permissions(folder_ / name, fs::perms::owner_read | fs::perms::owner_exec);
      locked_.push_back(name);
    }
  }

  std::vector<std::string> locked_;
};

TEST_P(Refusals, SaysAndKeeps) {
  const RefusalCase wrong = read_refusal_case(refusals / GetParam());
  if (!wrong.read_only.empty() && ::geteuid() == 0) GTEST_SKIP() << "root may write everywhere";
  ASSERT_NO_FATAL_FAILURE(prepare(wrong));
  std::map<std::string, std::string> before;
  for (const std::string& name : wrong.keeps) {
    ASSERT_TRUE(fs::is_regular_file(folder_ / name)) << name << " is to be kept and is not there";
    before[name] = read_text(folder_ / name);
  }

  const CommandStreams done = command(wrong.command);

  SCOPED_TRACE(wrong.why);
  const std::string said = done.out + done.err;
  EXPECT_EQ(done.exit_code, wrong.exit) << wrong.command << '\n' << said;
  for (const std::string& part : wrong.says)
    EXPECT_TRUE(contains(said, part)) << part << '\n' << said;
  for (const std::string& part : wrong.never)
    EXPECT_FALSE(contains(said, part)) << part << '\n' << said;
  for (const auto& [name, bytes] : before)
    EXPECT_TRUE(read_text(folder_ / name) == bytes) << name << " is not what it was";
  for (const std::string& name : wrong.absent)
    EXPECT_FALSE(fs::exists(fs::symlink_status(folder_ / name))) << name;
  for (const std::string& name : wrong.present) EXPECT_TRUE(there(name)) << name;
  for (const std::string& name : files_in(folder_))
    EXPECT_FALSE(contains(name, ".part")) << name << " is left over";
}

INSTANTIATE_TEST_SUITE_P(Table, Refusals, ::testing::ValuesIn(refusal_files()),
                         [](const auto& wrong) {
                           std::string name = fs::path(wrong.param).stem().string();
                           std::ranges::replace_if(
                               name, [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
                           return name;
                         });

}  // namespace
}  // namespace trueaxis::testing

// SPDX-License-Identifier: Apache-2.0
// Every code of the page of exit codes is returned by its example, and the help has the same codes.
#include <filesystem>
#include <map>
#include <regex>

#include "cli/guarded.hpp"
#include "support/command_fixture.hpp"
#include "support/places.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis::testing {
namespace {

const std::filesystem::path root = places::source();

/// Code → what is typed for it; the one of a bug has no command.
std::map<int, std::string> examples_of(const std::string& page) {
  const std::regex row("\n\\| ([0-9]+) \\| [^|]+ \\| (?:`trueaxis ([^`]+)`|[^|`]+) \\|");
  std::map<int, std::string> examples;
  for (std::sregex_iterator at(page.begin(), page.end(), row), end; at != end; ++at)
    examples[std::stoi((*at)[1])] = (*at)[2];
  return examples;
}

/// Places of the repository as a command in another folder names them.
std::string from_anywhere(const std::string& command) {
  return std::regex_replace(command, std::regex(" data/"), " " + (root / "data/").string());
}

class ExitCodes : public CommandTest {
 protected:
  std::map<int, std::string> examples_ =
      examples_of(read_text(root / "docs/reference/exit-codes.md"));
};

TEST_F(ExitCodes, EachIsReturnedByItsExample) {
  ASSERT_EQ(examples_.size(), 6u);
  for (const auto& [code, example] : examples_) {
    if (code == cli::bug) continue;
    const CommandStreams ran = command(from_anywhere(example));
    EXPECT_EQ(ran.exit_code, code) << example << '\n' << ran.out << ran.err;
    // A tolerance that is not met says so in the first line.
    EXPECT_EQ(ran.err.empty(), code <= 1) << example << '\n' << ran.err;
  }
}

// No command returns 70, so the code that would is called.
TEST_F(ExitCodes, ABugHasItsOwn) {
  ASSERT_TRUE(examples_.contains(70));
  EXPECT_EQ(examples_.at(70), "");
  EXPECT_EQ(cli::guarded([]() -> int { throw ContractViolation("of this test"); }), 70);
}

TEST_F(ExitCodes, TheHelpHasTheSame) {
  const std::string help = command("--help").out;
  const std::string codes = help.substr(help.find("Exit codes:"));
  std::map<int, std::string> listed;
  const std::regex number("(?:: |, |\n +)([0-9]+) ");
  for (std::sregex_iterator at(codes.begin(), codes.end(), number), end; at != end; ++at)
    listed[std::stoi((*at)[1])] = "";
  ASSERT_EQ(listed.size(), examples_.size()) << codes;
  for (const auto& [code, example] : examples_) EXPECT_TRUE(listed.contains(code)) << code;
}

}  // namespace
}  // namespace trueaxis::testing

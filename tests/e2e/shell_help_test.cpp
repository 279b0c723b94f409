// SPDX-License-Identifier: Apache-2.0
// What is made of the tables of options: completion as bash and zsh run it, the manual as troff
// reads it.
#include <sstream>

#include "support/command_fixture.hpp"

namespace trueaxis::testing {
namespace {

class ShellHelp : public CommandTest {
 protected:
  /// What bash offers for the last of the words.
  std::vector<std::string> offered(const std::string& words) {
    std::string script =
        "source script.bash\ncomplete -p trueaxis || exit 9\nCOMP_WORDS=(trueaxis ";
    script.append(words).append(")\nCOMP_CWORD=$((${#COMP_WORDS[@]}-1))\n_trueaxis\n");
    script.append("printf '%s\\n' \"${COMPREPLY[@]}\"\n");
    file("ask.sh", script);
    const CommandResult ran = shell(in_folder("bash ask.sh"));
    EXPECT_EQ(ran.exit_code, 0) << ran.output;
    std::istringstream lines(ran.output);
    std::vector<std::string> out;
    for (std::string line; std::getline(lines, line);) out.push_back(line);
    EXPECT_FALSE(out.empty());
    if (!out.empty()) out.erase(out.begin());  // of `complete -p`
    return out;
  }
  std::string in_folder(const std::string& line) {
    return std::string("cd ").append(shell_word(folder_)).append(" && ").append(line);
  }
  void SetUp() override {
    CommandTest::SetUp();
    const CommandStreams made = command("completion bash");
    ASSERT_EQ(made.exit_code, 0);
    file("script.bash", made.out);
  }
  static bool holds(const std::vector<std::string>& list, const std::string& word) {
    return std::ranges::find(list, word) != list.end();
  }
};

TEST_F(ShellHelp, CompletesCommandsOptionsWordsAndFiles) {
  EXPECT_EQ(offered("diag"), std::vector<std::string>{"diagnose"});
  EXPECT_TRUE(holds(offered("''"), "machine"));
  EXPECT_EQ(offered("machine comp"), std::vector<std::string>{"compensate"});
  EXPECT_EQ(offered("machine compensate x.nc --arcs"), std::vector<std::string>{"--arcs-mm"});
  EXPECT_TRUE(holds(offered("run --"), "--check"));
  EXPECT_EQ(offered("diagnose x.csv --sur"), std::vector<std::string>{"--surface"});
  EXPECT_EQ(offered("fit x.csv --surface c"), (std::vector<std::string>{"cone", "cylinder"}));
  EXPECT_EQ(offered("fit scr"), std::vector<std::string>{"script.bash"});
  EXPECT_EQ(offered("fit --json scr"), std::vector<std::string>{"script.bash"});
  EXPECT_FALSE(holds(offered("setup locators --"), "--surface"));
}

// Typed into a zsh of its own: Tab, and the line that comes of it; sourced, and installed as a
// function that zsh reads at the first Tab.
TEST_F(ShellHelp, CompletesInZsh) {
  if (shell("command -v zsh").exit_code != 0) GTEST_SKIP() << "no zsh here";
  const CommandStreams made = command("completion zsh");
  ASSERT_EQ(made.exit_code, 0);
  EXPECT_TRUE(made.out.starts_with("#compdef trueaxis\n"));
  file("script.zsh", made.out);
  std::filesystem::create_directory(folder_ / "functions");
  file("functions/_trueaxis", made.out);
  file("ask.zsh",
       "zmodload zsh/zpty\nzpty shell zsh -f -i\n"
       "type() { zpty -w -n shell \"$1\" }\n"
       "type \"$1\"$'\\ntrueaxis() { print -r -- \"$*\" >> typed.txt }\\n'\nshift\n"
       "for line in \"$@\"; do type \"trueaxis $line\"$'\\t\\n'; done\n"
       "type $'exit\\n'\nwhile zpty -r shell shown; do :; done\n");
  for (const char* const how :
       {"'autoload -U compinit; compinit -u -D; source ./script.zsh'",
        "'fpath=(./functions $fpath); autoload -U compinit; compinit -u -D'"}) {
    file("typed.txt", "");
    const CommandResult ran =
        shell(in_folder(std::string("timeout 60 zsh -f ask.zsh ") + how +
                        " diag 'run --che' 'diagnose x.csv --sur' 'fit x.csv --surface con'"
                        " 'fit x.csv --json ask' 'fit ask' 'setup loc'"));
    EXPECT_EQ(ran.exit_code, 0) << ran.output;
    EXPECT_EQ(read_text(folder_ / "typed.txt"),
              "diagnose\nrun --check\ndiagnose x.csv --surface\nfit x.csv --surface cone\n"
              "fit x.csv --json ask.zsh\nfit ask.zsh\nsetup locators\n")
        << how;
  }
}

// Every option that --help lists is offered.
TEST_F(ShellHelp, KnowsEveryOptionOfHelp) {
  for (const char* const name :
       {"run", "fit", "diagnose", "simulate", "study plan", "spindle", "machine errors"}) {
    const auto list = offered(std::string(name).append(" --"));
    std::istringstream words(command(std::string(name).append(" --help")).out);
    std::size_t options = 0;
    for (std::string word; words >> word;) {
      const std::size_t at = word.find("--");
      if (at != 0 && (at != 3 || word[2] != ',')) continue;
      const std::string option =
          word.substr(at, word.find_first_not_of("abcdefghijklmnopqrstuvwxyz-", at) - at);
      if (option.size() < 4 || word.ends_with(';') || word.ends_with('.')) continue;
      ++options;
      EXPECT_TRUE(holds(list, option)) << name << ' ' << option;
    }
    EXPECT_GT(options, 3u) << name;
  }
}

TEST_F(ShellHelp, ManualIsTroffWithoutWarnings) {
  const CommandStreams made = command("man");
  ASSERT_EQ(made.exit_code, 0);
  file("trueaxis.1", made.out);
  for (const char* const part :
       {".TH TRUEAXIS 1", ".SH NAME", ".SH COMMANDS", ".SS trueaxis machine diagnose",
        "\\-\\-surface", ".SH EXIT STATUS"})
    EXPECT_TRUE(contains(made.out, part)) << part;
  if (shell("command -v groff").exit_code != 0) GTEST_SKIP() << "no groff here";
  const CommandResult ran = shell(in_folder("groff -man -ww -Tutf8 trueaxis.1 > page.txt"));
  EXPECT_EQ(ran.exit_code, 0);
  EXPECT_EQ(ran.output, "");
  EXPECT_TRUE(contains(read_text(folder_ / "page.txt"), "diagnose"));
}

}  // namespace
}  // namespace trueaxis::testing

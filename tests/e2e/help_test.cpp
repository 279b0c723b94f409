// SPDX-License-Identifier: Apache-2.0
// Help is short, its examples and pages are there, and what the pages type is there too.
#include <map>
#include <regex>
#include <set>
#include <sstream>

#include "support/command_fixture.hpp"
#include "support/places.hpp"

namespace trueaxis::testing {
namespace {

const std::filesystem::path root = places::source();

struct Command {
  std::set<std::string> options;
  std::vector<std::string> examples;
};
using Commands = std::map<std::string, Command>;

/// The commands with their options and examples, as the manual has them.
Commands commands_of(const std::string& manual) {
  const std::string text = std::regex_replace(manual, std::regex("\\\\-"), "-");
  const std::regex option("\\\\fB(--?[a-z0-9-]+)\\\\fR");
  Commands commands;
  Command* now = nullptr;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with(".SS trueaxis ")) now = &commands[line.substr(13)];
    if (line.starts_with(".SH")) now = nullptr;
    if (now == nullptr) continue;
    now->options.insert("--help");
    for (std::sregex_iterator at(line.begin(), line.end(), option), end; at != end; ++at)
      now->options.insert((*at)[1]);
    if (line.starts_with("    trueaxis ")) now->examples.push_back(line.substr(4));
  }
  return commands;
}

/// The words of a command line up to where a shell goes on to another command or file.
std::vector<std::string> words_of(const std::string& line) {
  std::istringstream in(line);
  std::vector<std::string> words;
  for (std::string word; in >> word;) {
    if (word.find_first_of("|<>;&#") == 0) break;
    while (!word.empty() && (word.front() == '[' || word.front() == '(')) word.erase(0, 1);
    while (!word.empty() && std::string("],;:).").find(word.back()) != std::string::npos)
      word.pop_back();
    if (!word.empty()) words.push_back(word);
  }
  return words;
}

/// Why the line is not a command of the program; empty if it is one.
std::string trouble(const std::string& line, const Commands& commands) {
  const std::vector<std::string> words = words_of(line);
  if (words.size() < 2 || words[1].starts_with("--")) return "";
  const bool of_two = words.size() > 2 && commands.contains(words[1] + ' ' + words[2]);
  const auto command = commands.find(of_two ? words[1] + ' ' + words[2] : words[1]);
  if (command == commands.end()) return "no command: " + line;
  for (std::size_t i = of_two ? 3 : 2; i < words.size(); ++i) {
    if (words[i] == "trueaxis") break;
    if (!words[i].starts_with("-") || words[i] == "-") continue;
    const std::string option = words[i].substr(0, words[i].find('='));
    if (!std::regex_match(option, std::regex("--?[a-z][a-z0-9-]*"))) continue;
    if (!command->second.options.contains(option)) return "no option " + option + ": " + line;
  }
  return "";
}

/// Every command line of a page: lines that begin with trueaxis, and code in a sentence.
std::vector<std::string> typed_in(const std::string& page) {
  std::string text = std::regex_replace(page, std::regex(" \\\\\n *"), " ");
  text = std::regex_replace(text, std::regex("\\\\\\|"), "/");
  const std::regex line("(?:^|\n)(?:    |\\$ )? *(trueaxis [^\n`]+)"),
      code("`(trueaxis [a-z][^`]*)`");
  std::vector<std::string> all;
  for (const std::regex& where : {line, code})
    for (std::sregex_iterator at(text.begin(), text.end(), where), end; at != end; ++at)
      all.push_back((*at)[1]);
  return all;
}

class Help : public CommandTest {
 protected:
  void SetUp() override {
    CommandTest::SetUp();
    commands_ = commands_of(command("man").out);
  }
  Commands commands_;
};

TEST_F(Help, OfTheProgramIsAScreenWithAllCommands) {
  const CommandStreams help = command("--help");
  EXPECT_EQ(help.exit_code, 0);
  EXPECT_LT(std::ranges::count(help.out, '\n'), 40);
  ASSERT_GT(commands_.size(), 20u);
  for (const auto& [name, one] : commands_)
    EXPECT_TRUE(std::regex_search(help.out, std::regex("\n  " + name + "  +[a-z]"))) << name;
  for (const char* const group :
       {"Start", "Measure", "Cut", "Machine", "Set-up", "Study", "Reference"})
    EXPECT_TRUE(contains(help.out, std::string("\n").append(group).append("\n"))) << group;
}

TEST_F(Help, OfACommandIsAScreenWithExamplesAndAPage) {
  const std::regex page("\nMore: +(docs/[^\n]+)\n$");
  for (const auto& [name, one] : commands_) {
    const CommandStreams help = command(name + " --help");
    EXPECT_EQ(help.exit_code, 0) << name;
    EXPECT_LT(std::ranges::count(help.out, '\n'), 40) << help.out;
    std::smatch found;
    ASSERT_TRUE(std::regex_search(help.out, found, page)) << help.out;
    EXPECT_TRUE(std::filesystem::exists(root / found[1].str())) << found[1];
    EXPECT_EQ(one.examples.size(), 2u) << name;
    for (const std::string& example : one.examples) {
      EXPECT_TRUE(contains(help.out, example)) << example;
      EXPECT_EQ(trouble(example, commands_), "");
    }
  }
}

TEST_F(Help, SaysWhatToDoNext) {
  const CommandStreams alone = command("");
  EXPECT_EQ(alone.exit_code, 2);
  for (const std::string& line : typed_in(alone.err)) EXPECT_EQ(trouble(line, commands_), "");
  EXPECT_TRUE(contains(alone.err, "trueaxis init first"));
  const CommandStreams machine = command("machine");
  EXPECT_EQ(machine.exit_code, 2);
  EXPECT_TRUE(contains(machine.err, "\n  calibrate "));
  EXPECT_EQ(command("machine calibrat").err,
            "trueaxis machine has no command calibrat, did you mean calibrate?\n"
            "trueaxis machine --help lists all.\n");
}

// One grammar of options: what does not have one of these says why.
TEST_F(Help, EveryCommandHasTheSharedOptions) {
  using Exceptions = std::map<std::string, const char*>;
  const char* const computes_nothing = "computes nothing";
  const char* const no_U = "prints no uncertainty";
  const std::map<std::string, Exceptions> exceptions{
      {"--verbose", {}},
      {"--json",
       {{"init", computes_nothing},
        {"completion", computes_nothing},
        {"man", computes_nothing},
        {"machine import", "its one result is the machine file"}}},
      {"--check",
       {{"effects", "reads no file"}, {"completion", computes_nothing}, {"man", computes_nothing}}},
      {"--force", {{"completion", computes_nothing}, {"man", computes_nothing}}},
      {"--coverage-factor",
       {{"init", computes_nothing},
        {"completion", computes_nothing},
        {"man", computes_nothing},
        {"import", no_U},
        {"effects", no_U},
        {"table", "k is that of the fit or diagnosis that it reads"},
        {"simulate", "k is that of the diagnosis that it reads"},
        {"machine pose", no_U},
        {"machine inverse", no_U},
        {"machine errors", no_U},
        {"machine import", no_U},
        {"machine simulate", no_U},
        {"setup datums", "its file does not state u"},
        {"study sweep", "how often U holds is known for k = 2 only"},
        {"study axis-bias", no_U}}}};
  for (const auto& [option, without] : exceptions) {
    for (const auto& [name, why] : without)
      EXPECT_TRUE(commands_.contains(name)) << name << " has no " << option << ": " << why;
    for (const auto& [name, one] : commands_)
      EXPECT_EQ(one.options.contains(option), !without.contains(name)) << name << ' ' << option;
  }
}

// The judge itself: what is misspelled is found.
TEST_F(Help, TroubleIsSeen) {
  EXPECT_NE(trouble("trueaxis calibrate a.csv", commands_), "");
  EXPECT_NE(trouble("trueaxis machine calibrat a.csv", commands_), "");
  EXPECT_NE(trouble("trueaxis fit a.csv --surfce cone", commands_), "");
  EXPECT_EQ(trouble("trueaxis fit a.csv --surface cone | head --bytes", commands_), "");
  EXPECT_EQ(typed_in("a\n    trueaxis fit a \\\n      --json b\n`trueaxis run j`.\n").size(), 2u);
}

TEST_F(Help, EveryCommandOfThePagesIsThere) {
  std::vector<std::filesystem::path> pages{root / "README.md", root / "CONTRIBUTING.md",
                                           root / "CHANGELOG.md"};
  for (const auto& entry : std::filesystem::recursive_directory_iterator(root / "docs"))
    if (entry.path().extension() == ".md" && entry.path().filename() != "numbers.md")  // history
      pages.push_back(entry.path());
  std::size_t lines = 0;
  for (const auto& page : pages)
    for (const std::string& line : typed_in(read_text(page))) {
      ++lines;
      EXPECT_EQ(trouble(line, commands_), "") << page;
    }
  EXPECT_GT(lines, 100u);
}

// The names before 0.1.0 do the same, and a line names the new one.
TEST_F(Help, OldNamesWorkForOneRelease) {
  const std::string data = places::source() + "/data/five_axis/";
  const struct {
    std::string old_name, new_name, note;
  } pairs[] = {{"pose " + data + "zxacy.toml p.csv",
                "machine pose p.csv --machine " + data + "zxacy.toml", "pose is now machine pose"},
               {"locate " + data + "hong.toml", "setup locators " + data + "hong.toml",
                "locate is now setup locators"},
               {"associate p.txt --element plane", "fit --points p.txt --element plane",
                "associate is now fit"},
               {"fit s.csv --surface cylinder --criterion orthogonal --ball-radius 1",
                "fit s.csv --surface cylinder --criterion gaussian --ball-radius-mm 1",
                "--criterion orthogonal is now --criterion gaussian"},
               {"fit s.csv --surface cylinder --noise 1",
                "fit s.csv --surface cylinder --noise-um 1", "--noise is now --noise-um"}};
  file("p.csv", "X[mm],Y[mm],Z[mm],A[deg],C[deg]\n1,2,3,-10,20\n");
  file("p.txt", "0 0 0\n1 0 0\n0 1 0\n1 1 0.01\n");
  file("s.csv", csv(probe({})));
  for (const auto& [old_name, new_name, note] : pairs) {
    const CommandStreams before = command(old_name), now = command(new_name);
    EXPECT_EQ(now.exit_code, 0) << new_name << now.err;
    EXPECT_EQ(before.exit_code, 0) << old_name << before.err;
    EXPECT_TRUE(contains(before.err, "trueaxis: " + note + ";")) << before.err;
    EXPECT_FALSE(contains(now.err, " is now ")) << now.err;
    EXPECT_EQ(before.out, now.out);
  }
}

}  // namespace
}  // namespace trueaxis::testing

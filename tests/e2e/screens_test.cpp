// SPDX-License-Identifier: Apache-2.0
// What commands print: at most 18 lines for an ordinary case, values with the digits of their U, no
// number that means "never".
#include <map>
#include <regex>
#include <sstream>

#include "support/command_fixture.hpp"
#include "support/places.hpp"
#include "support/terminal.hpp"

namespace trueaxis::testing {
namespace {

const std::string of = "data/";  // a link in the test's folder: names as short as a user's
const std::string machines = of + "five_axis/";
const std::string ball = machines + "zxacy_ball.csv --machine " + machines + "zxacy.toml";

/// For a second run over the results of the first.
std::string forced(const std::string& one) {
  return contains(one, " -o ") || contains(one, " --json ") ? " --force" : "";
}

std::size_t lines_of(const std::string& text) { return std::ranges::count(text, '\n'); }

/// Every command runs once on each terminal and once in a pipe: the tests look at what it said.
class Screens : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = fresh_folder("command/Screens");
    std::filesystem::create_directory_symlink(places::source() + "/data", folder_ / "data");
  }
  static const TerminalRun& on_screen(const std::string& one, unsigned short columns) {
    static std::map<std::pair<std::string, unsigned short>, TerminalRun> known;
    const auto [at, is_new] = known.try_emplace({one, columns});
    if (is_new) at->second = on_terminal(folder_, "NO_COLOR=1 trueaxis " + one, columns);
    return at->second;
  }
  static const CommandStreams& in_pipe(const std::string& one, const std::string& how = "") {
    static std::map<std::string, CommandStreams> known;
    const auto [at, is_new] = known.try_emplace(one + how);
    if (is_new) at->second = run_in(folder_, one + how + forced(one));
    return at->second;
  }
  /// On a terminal of 80 columns, where lines wrap.
  static void expect_a_screen(const std::string& one) {
    const TerminalRun& run = on_screen(one, 80);
    EXPECT_EQ(run.exit_code, 0) << one << '\n' << run.shown;
    EXPECT_LE(lines_of(run.shown), 18u) << one << '\n' << run.shown;
  }
  /// All commands whose screens are shipped cases, with what they write in the test's folder.
  static std::vector<std::string> machine_commands() {
    return {"run " + of + "jobs/blade.toml -o blade",
            "machine calibrate --machine " + machines + "trunnion_ac.toml " + machines +
                "trunnion_ac_ball.csv -o c.toml",
            "machine diagnose " + ball,
            "machine diagnose " + ball + " --program " + machines + "blade.nc --json d.json",
            "advise " + ball,
            "advise --machine " + machines + "zxacy.toml",
            "setup datums " + machines + "holes.toml -o e.toml",
            "setup locators " + machines + "hong.toml",
            "setup locators " + machines + "hong.toml -o l.toml --json l.json",
            "machine compensate " + machines + "holes.nc --machine " + machines +
                "zxacy.toml --errors " + machines + "zxacy_errors.toml -o holes.nc"};
  }
  static std::vector<std::string> lathe_commands() {
    std::vector<std::string> all{"run " + of + "streams/shaft_three_lobes.csv -o alone"};
    for (const char* const name : {"shaft", "shaft_three_lobes", "bushing"})
      all.push_back(std::string("run ")
                        .append(of)
                        .append("jobs/")
                        .append(name)
                        .append(".toml -o ")
                        .append(name));
    for (const auto& [stream, surface] :
         {std::pair{"shaft_cone_seat", "cone"}, std::pair{"shaft_cylinder_seat", "cylinder"},
          std::pair{"shaft_three_lobes", "cone"}, std::pair{"bushing_bore", "cylinder"},
          std::pair{"bushing_face", "plane"}})
      for (const char* const what : {"fit ", "diagnose "})
        all.push_back(std::string(what)
                          .append(of)
                          .append("streams/")
                          .append(stream)
                          .append(".csv --surface ")
                          .append(surface));
    return all;
  }

  static inline std::filesystem::path folder_;
};

TEST_F(Screens, OfMachinesFitAndBeginWithWhatWasDecided) {
  const std::regex verdict(
      "^(GO|NO-GO|NOT PROVEN|DONE|IDEAL|EFFECTS|UNEXPLAINED|FOUND|NEXT)[^\n]*: ");
  for (const std::string& one : machine_commands()) {
    expect_a_screen(one);
    const CommandStreams& done = in_pipe(one);
    ASSERT_EQ(done.exit_code, 0) << one << '\n' << done.err;
    EXPECT_TRUE(std::regex_search(done.out, verdict)) << one << '\n' << done.out;
    EXPECT_TRUE(contains(done.out, "\nnext   ") || done.out.starts_with("NEXT")) << done.out;
  }
}

TEST_F(Screens, OfLathesFit) {
  for (const std::string& one : lathe_commands()) expect_a_screen(one);
}

// No line is wider than the terminal, and no line break separates a number from its unit.
TEST_F(Screens, KeepToTheTerminal) {
  const std::regex torn(
      "[0-9]\r?\n +((µm|mm|µrad|mrad|nm|deg|rpm|min|Hz|ms|s|%|°|UPR)\\b|%|°|±)|(±|=)\r?\n|\r?\n "
      "+=");
  std::vector<std::string> all = machine_commands();
  for (const std::string& one : lathe_commands()) all.push_back(one);
  all.push_back("run " + of + "jobs/measured.toml -o measured");
  for (const unsigned short columns : {80, 120})
    for (const std::string& one : all) {
      const TerminalRun& run = on_screen(one, columns);
      EXPECT_EQ(run.exit_code, 0) << one;
      EXPECT_FALSE(std::regex_search(run.shown, torn)) << run.shown;
      std::istringstream lines(run.shown);
      std::size_t measured = 0;
      for (std::string line; std::getline(lines, line);) {
        if (line.find('/') != std::string::npos || line.find('\x1b') != std::string::npos) continue;
        ++measured;
        const auto letters = std::ranges::count_if(
            line, [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; });
        EXPECT_LE(letters, columns + 1) << line;  // the carriage return
      }
      EXPECT_GE(measured, 1u) << run.shown;
    }
}

// GUM 7.2.6: value and U end at the same digit; wherever there is a ±, on screens and with
// --verbose.
TEST_F(Screens, ValuesHaveTheDigitsOfTheirU) {
  const std::regex pair("(-?[0-9]+)(\\.[0-9]+)? ± ([0-9]+)(\\.[0-9]+)?(e[-+]?[0-9]+)?");
  auto all = machine_commands();
  for (const std::string& one : lathe_commands()) all.push_back(one);
  std::size_t pairs = 0;
  for (const std::string& one : all)
    for (const char* const how : {"", " --verbose"}) {
      const std::string& text = in_pipe(one, how).out;
      for (auto at = std::sregex_iterator(text.begin(), text.end(), pair);
           at != std::sregex_iterator(); ++at, ++pairs) {
        EXPECT_EQ((*at)[2].length(), (*at)[4].length()) << one << how << ": " << at->str();
        EXPECT_FALSE((*at)[5].matched) << one << how << ": " << at->str();
      }
    }
  EXPECT_GT(pairs, 120u);
}

// A length of 10 m and more, a speed that no lathe has, an angle of more than ten turns.
TEST_F(Screens, NoNumberMeansNever) {
  const std::regex never(
      "(^|[^.0-9])[0-9]{5,}(\\.[0-9]+)? (mm|rpm|deg|s)\\b|[0-9]e\\+?[0-9]+ (mm|µm|deg|rpm|s)\\b");
  for (const std::string& one : lathe_commands())
    for (const char* const how : {"", " --verbose"}) {
      const std::string& text = in_pipe(one, how).out;
      std::smatch found;
      EXPECT_FALSE(std::regex_search(text, found, never)) << one << how << ": " << found.str();
    }
}

}  // namespace
}  // namespace trueaxis::testing

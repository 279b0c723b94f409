// SPDX-License-Identifier: Apache-2.0
// The pages say every key, word and code that a reader meets.
#include <regex>
#include <set>
#include <sstream>

#include "support/command_fixture.hpp"
#include "support/places.hpp"

namespace trueaxis::testing {
namespace {

const std::filesystem::path root = places::source();

std::string page(const std::string& name) { return read_text(root / "docs" / name); }

/// From one heading of a page to the next of its level.
std::string section_of(const std::string& text, const std::string& heading) {
  const std::size_t from = text.find("\n" + heading + "\n");
  return from == std::string::npos ? "" : text.substr(from, text.find("\n## ", from + 4) - from);
}

/// Every key that a reader of TOML asks for, as its source says it, with the unit of the edge.
std::set<std::string> keys_in(const std::string& source) {
  const std::string text = read_text(root / source);
  const std::regex asks(
      "\\.(?:maybe_|required_)?(?:number|numbers|integer|flag|text|texts|path|choice|table|tables|"
      "has)"
      "(?:<[^>]*>)?\\(\\s*\"([a-z0-9_]+)\"");
  const std::regex renamed("\\.name_of\\(\"([a-z0-9_]+)\", \"([a-z0-9_]+)\"\\)");
  std::set<std::string> keys;
  const auto add = [&](std::string key) {
    if (key.ends_with("_rad")) key.replace(key.size() - 3, 3, "deg");
    keys.insert(key);
  };
  for (std::sregex_iterator at(text.begin(), text.end(), asks), end; at != end; ++at) add((*at)[1]);
  for (std::sregex_iterator at(text.begin(), text.end(), renamed), end; at != end; ++at)
    add((*at)[1]), add((*at)[2]);
  return keys;
}

TEST(DocsWords, EveryKeyOfAScenarioIsOnThePage) {
  const std::string scenario = page("reference/scenario.md");
  ASSERT_FALSE(scenario.empty());
  auto keys = keys_in("src/simulate/files/scenario_toml.cpp");
  for (const char* const made :
       {"z_start_mm", "z_end_mm", "z_mm", "x_start_mm", "x_end_mm", "x_mm"})
    keys.insert(made);          // of a pass, made of its axis and an ending
  EXPECT_GT(keys.size(), 60u);  // the reader is read, not an empty file
  for (const std::string& key : keys)
    EXPECT_TRUE(contains(scenario, "`" + key) || contains(scenario, "[" + key + "]") ||
                contains(scenario, "." + key + "]"))
        << "docs/reference/scenario.md lacks " << key;
}

TEST(DocsWords, EveryKeyOfASweepIsOnThePage) {
  const std::string sweep = page("reference/sweep.md");
  std::size_t found = 0;
  for (const char* const source :
       {"src/study/sweep/files/sweep_axes.cpp", "src/study/sweep/files/sweep_toml.cpp",
        "studies/published/published_toml.cpp"})
    for (const std::string& key : keys_in(source)) {
      ++found;
      EXPECT_TRUE(contains(sweep, "`" + key) || contains(sweep, "[" + key + "]") ||
                  contains(sweep, "." + key + "]"))
          << "docs/reference/sweep.md lacks " << key;
    }
  EXPECT_GT(found, 20u);
}

// The report's list of terms is a part of the glossary, word for word.
TEST(DocsWords, ReportAndGlossaryAgree) {
  const std::string script = read_text(root / "src/report/glossary.js"),
                    words = page("reference/glossary.md");
  const std::regex entry("\\['((?:[^'\\\\]|\\\\.)*)', '((?:[^'\\\\]|\\\\.)*)'\\]");
  std::size_t entries = 0;
  for (std::sregex_iterator at(script.begin(), script.end(), entry), end; at != end; ++at) {
    ++entries;
    const std::string row = std::regex_replace(
        "| " + (*at)[1].str() + " | " + (*at)[2].str() + " |\n", std::regex("\\\\'"), "'");
    EXPECT_TRUE(contains(words, row)) << "docs/reference/glossary.md lacks the row\n" << row;
  }
  EXPECT_GT(entries, 10u);
}

class GlossaryOfScreens : public CommandTest {};

// The word that a line of a screen begins with.
TEST_F(GlossaryOfScreens, HasTheWordOfEveryLine) {
  const std::string data = places::source() + "/data/", of = data + "five_axis/";
  const std::string words =
      section_of(page("reference/glossary.md"), "## Verdicts and lines of a screen");
  std::set<std::string> heads;
  for (const std::string& one :
       {"run " + data + "jobs/shaft.toml -o a", "run " + data + "jobs/shaft_three_lobes.toml -o b",
        "fit " + data + "streams/shaft_cone_seat.csv --surface cone",
        "run " + data + "jobs/blade.toml -o c", "setup locators " + of + "hong.toml",
        "machine calibrate --machine " + of + "trunnion_ac.toml " + of +
            "trunnion_ac_ball.csv -o e.toml",
        "machine diagnose " + of + "zxacy_ball.csv --machine " + of + "zxacy.toml --program " + of +
            "blade.nc",
        "advise " + of + "zxacy_ball.csv --machine " + of + "zxacy.toml",
        "machine compensate " + of + "holes.nc --machine " + of + "zxacy.toml --errors " + of +
            "zxacy_errors.toml -o n.nc"}) {
    std::istringstream lines(command(one).out);
    std::string line;
    std::getline(lines, line);
    while (std::getline(lines, line))
      if (!line.empty() && line[0] != ' ') heads.insert(line.substr(0, line.find(' ')));
  }
  EXPECT_GT(heads.size(), 15u);
  for (const std::string& head : heads)
    EXPECT_TRUE(std::regex_search(words, std::regex("[| ]" + head + "[, ]")))
        << "docs/reference/glossary.md has no `" << head << "` among the lines of a screen";
}

TEST(DocsWords, CodesAreSaidWhereTheyAreUsed) {
  const std::string words = page("reference/glossary.md"), effects = page("reference/effects.md");
  const std::regex row("\n\\| ([A-Z0-9]{2}) \\| ([^|]+) \\|");
  std::size_t codes = 0;
  for (std::sregex_iterator at(effects.begin(), effects.end(), row), end; at != end; ++at, ++codes)
    EXPECT_TRUE(contains(words, "\n| " + (*at)[1].str() + " | ")) << (*at)[1];
  EXPECT_EQ(codes, 11u);
  for (const char* const name : {"evidence/blind_study.md", "evidence/axis_study.md"}) {
    const std::string text = std::regex_replace(page(name), std::regex("\n"), " ");
    const std::size_t at = text.find("**The plans**");
    ASSERT_NE(at, std::string::npos) << name;
    for (const char* const plan :
         {"P1: one helical pass", "P2: out and back;", "P3: out and back at two",
          "P4: out and back", "P5: as P3", "P6: as P3", "P7: as P3", "P8: all"})
      EXPECT_NE(text.find(plan, at), std::string::npos) << name << ' ' << plan;
  }
  // A page that is made again carries them: the scripts hold the same sentence.
  for (const char* const script : {"blind_study", "axis_study"})
    EXPECT_TRUE(contains(read_text(root / "scripts" / script), "**The plans**")) << script;
}

TEST(DocsWords, TheDrawingOfTheFrameIsWhereItIsNeeded) {
  for (const char* const name :
       {"tutorial/first-axis.md", "reference/job.md", "explanation/theory/frames-and-surfaces.md",
        "reference/glossary.md"})
    EXPECT_TRUE(contains(page(name), "../images/frame.svg)")) << name;
  const std::string drawing = page("images/frame.svg");
  for (const char* const part : {"<title", "X_M &gt; 0", "X_M &lt; 0", "C grows", "rear", "front",
                                 "nose", "ball", "prefers-color-scheme: dark"})
    EXPECT_TRUE(contains(drawing, part)) << part;
}

// Sentences that nobody understood at first reading, and that are gone.
TEST(DocsWords, NoRiddles) {
  std::size_t pages = 0;
  for (const auto& file : std::filesystem::recursive_directory_iterator(root / "docs")) {
    if (file.path().extension() != ".md") continue;
    ++pages;
    const std::string text = read_text(file.path());
    for (const char* const riddle :
         {"error of the probe never is", "noise that remembers", "passes the spindle axis by",
          "radius that nobody took off", "exact twins", "beyond sense"})
      EXPECT_FALSE(contains(text, riddle)) << file.path() << ": " << riddle;
  }
  EXPECT_GE(pages, 15u);
}

TEST_F(GlossaryOfScreens, TheShippedCutIsTrueToTheSeats) {
  const std::string data = places::source() + "/data/";
  ASSERT_EQ(command("run " + data + "jobs/shaft.toml -o shaft").exit_code, 0);
  ASSERT_EQ(
      command("simulate " + data + "scenarios/shaft_cut.toml --table shaft/table.csv -o a.csv")
          .exit_code,
      0);
  ASSERT_EQ(command("fit a.csv --surface cylinder --json a.json").exit_code, 0);
  const auto fit = result("a.json");
  const auto value = [&](const char* name) {
    return fit.at("parameters").at(name).at("value").get<double>();
  };
  // The seats' axes of data/scenarios/shaft_*_seat.toml at both ends of the cut. They are 2.5 µm
  // apart; the target axis lies between them, and half the job's tolerance is 5 µm.
  for (const double z : {102.0, 128.0}) {
    const double x = value("x0") + z * value("l"), y = value("y0") + z * value("m");
    EXPECT_LT(std::hypot(x - (0.048 + z * 0.00035), y - (-0.031 - z * 0.00021)), 0.0075) << z;
    EXPECT_LT(std::hypot(x - (0.050 + z * 0.00035), y - (-0.0295 - z * 0.00021)), 0.0075) << z;
    EXPECT_GT(std::hypot(x, y), 0.09) << z;  // and not about the spindle
  }
}

}  // namespace
}  // namespace trueaxis::testing

// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>

#include "study/sweep/files/sweep_toml.hpp"
#include "support/sweep_text.hpp"
#include "trueaxis/error.hpp"

/// Cases of an axis that replace whole lists of the scenario, and the order in which a cell is set.
namespace trueaxis {
namespace {

using study::scenario_of;
using testing::expect_complaint;
using testing::parse_sweep;
using virtual_lathe::Scenario;

const std::string part = R"(
[part]
kind = "cylinder"
radius_mm = 20
[[pass]]
z_start_mm = 0
z_end_mm = -30
[[effect]]
id = "part.roundness"
order = 3
amplitude_um = 2
)";

const std::string plans = R"(
[[axis]]
name = "plan"
[[axis.case]]
label = "as given"
[[axis.case]]
label = "there and back"
set = { "pass.1.pause_s" = 7 }
[[axis.case.pass]]
z_start_mm = 5
z_end_mm = 45
[[axis.case.pass]]
z_start_mm = 45
z_end_mm = 5
setup = 2
[[axis.case.setup]]
number = 2
reindex_deg = 90
)";

const std::string effects = R"(
[[axis]]
name = "part"
[[axis.case]]
label = "round"
effect = []
[[axis.case]]
label = "oval"
[[axis.case.effect]]
id = "part.roundness"
order = 2
amplitude_um = 3
[[axis.case.effect]]
id = "part.taper"
amplitude_um = 1
)";

const std::string length = "[[axis]]\nkey = \"pass.length_mm\"\nvalues = [10]\n";

/// "sweep.toml:LINE:" of the first line that holds `words`.
std::string line_of(const std::string& text, const std::string& words) {
  const std::size_t at = text.find(words);
  const auto line = 1 + std::count(text.begin(), text.begin() + static_cast<long>(at), '\n');
  return "sweep.toml:" + std::to_string(line) + ":";
}

TEST(SweepLists, ReplaceThoseOfTheScenario) {
  const study::Sweep sweep = parse_sweep(part + plans + effects);
  ASSERT_EQ(study::cell_count(sweep), 4U);
  const Scenario given = scenario_of(sweep, 1);  // as given, oval
  EXPECT_EQ(given.plan.passes.size(), 1U);
  EXPECT_TRUE(given.plan.setups.empty());
  ASSERT_EQ(given.effects.size(), 2U);
  EXPECT_EQ(given.effects[0].parameters.at("amplitude_mm"), 0.003);
  EXPECT_EQ(given.effects[1].id, "part.taper");
  const Scenario back = scenario_of(sweep, 2);  // there and back, round
  ASSERT_EQ(back.plan.passes.size(), 2U);
  EXPECT_EQ(back.plan.passes[1].end_mm, 5.0);
  EXPECT_EQ(back.plan.passes[1].setup, 2);
  EXPECT_EQ(back.plan.passes[1].pause_s, 7.0);
  ASSERT_EQ(back.plan.setups.size(), 1U);
  EXPECT_NEAR(back.plan.setups[0].reindex_rad, 1.5707963267948966, 1e-15);
  EXPECT_TRUE(back.effects.empty());
}

// Lists first, then the numbers, wherever the axes are in the file; a travel keeps the way of its
// pass.
TEST(SweepLists, ComeBeforeAllNumbers) {
  for (const std::string& text : {part + plans + length, part + length + plans}) {
    const study::Sweep sweep = parse_sweep(text);
    EXPECT_EQ(scenario_of(sweep, 0).plan.passes[0].end_mm, -10.0);
    const Scenario back = scenario_of(sweep, 1);
    EXPECT_EQ(back.plan.passes[0].end_mm, 15.0);
    EXPECT_EQ(back.plan.passes[1].end_mm, 35.0);
  }
}

TEST(SweepLists, KeysExistInEveryCase) {
  const auto axis = [](const std::string& key) {
    return "[[axis]]\nkey = \"" + key + "\"\nvalues = [3]\n";
  };
  const std::string pass = part + axis("pass.1.pause_s") + plans;
  expect_complaint(pass, "which the case \"as given\" of \"plan\" does not have");
  expect_complaint(pass, line_of(pass, "\"pass.1.pause_s\""));
  const std::string effect = part + effects + plans + axis("effect.0.order");
  expect_complaint(effect, "which the case \"round\" of \"part\" does not have");
  expect_complaint(effect, line_of(effect, "\"effect.0.order\""));
  // What every case has is a key, whatever the scenario's own list is.
  const std::string all_have =
      "[[axis]]\nname = \"n\"\n[[axis.case]]\nlabel = \"a\"\n[[axis.case.effect]]\n"
      "id = \"part.taper\"\namplitude_um = 1\n";
  EXPECT_EQ(scenario_of(parse_sweep(part + all_have + axis("effect.0.amplitude_mm")), 0)
                .effects[0]
                .parameters.at("amplitude_mm"),
            3.0);
  expect_complaint(part + all_have + axis("effect.0.order"), "\"a\" of \"n\" does not have");
  // The set of a case sees its own lists, and of those of other axes what all their cases have.
  std::string own = part + plans;
  own.replace(own.find("pass.1.pause_s"), 14, "pass.2.pause_s");
  expect_complaint(own, "which the case \"there and back\" of \"plan\" does not have");
  own.replace(own.find("pass.2.pause_s"), 14, "effect.1.amplitude_um");
  expect_complaint(own + effects, "which the case \"round\" of \"part\" does not have");
  const std::string drawn = axis("effect.1.amplitude_mm");
  expect_complaint(part + effects + drawn.substr(0, drawn.find("values")) +
                       "distribution = \"uniform\"\nlow = 0\nhigh = 1\n",
                   "which the case \"round\"");
}

TEST(SweepLists, AreReadAsInAScenario) {
  expect_complaint(part + plans + "colour = 3\n", "no key `colour`");
  expect_complaint(part + plans + "[[axis.case.pass]]\nz_mm = 3\n", "makes a dwell");
  expect_complaint(part + "[[axis]]\nname = \"n\"\n[[axis.case]]\nlabel = \"a\"\npass = []\n",
                   "is empty: give at least one pass");
  expect_complaint(part + effects + "[[axis.case.effect]]\nid = \"part.roundnes\"\n",
                   "is not known");
  // With or without the scenario.
  expect_complaint("[part]\n" + plans, "needs `surface`");
}

TEST(SweepLists, AreOfOneAxisAndHaveNames) {
  std::string twice = effects;
  twice.replace(twice.find("\"part\""), 6, "\"form\"");
  expect_complaint(part + effects + twice, "only one axis may replace a list");
  expect_complaint(part + effects + effects, "is that of an axis before");
  expect_complaint(part + effects + "[[axis.case]]\nlabel = \"oval\"\neffect = []\n",
                   "is that of a case before");
  expect_complaint(part + "[[axis]]\nname = \"n\"\n[[axis.case]]\nlabel = \"a\"\n", "needs `set`");
}

const std::string paper = R"(
[paper]
source = "a table"
parameters = ["x0"]
[[paper.row]]
at = ["there and back"]
values = ["0.1"]
[[paper.reading]]
name = "slower"
)";

TEST(SweepLists, ReadingsOfPaperSetWhatEveryCaseHas) {
  const study::PublishedSweep file = parse_published_sweep(
      part + plans + paper + "set = { \"pass.0.pause_s\" = 9 }\n", "sweep.toml");
  ASSERT_TRUE(file.published.has_value());
  study::Sweep read = file.sweep;
  read.settings = file.published->readings[0].settings;
  EXPECT_EQ(scenario_of(read, 0).plan.passes[0].pause_s, 9.0);
  EXPECT_EQ(scenario_of(read, 1).plan.passes[0].pause_s, 9.0);  // after the lists
  EXPECT_EQ(scenario_of(read, 1).plan.passes[1].pause_s, 7.0);  // before the axes
  expect_complaint(part + plans + paper + "set = { \"pass.1.feed_mm_per_rev\" = 9 }\n",
                   "which the case \"as given\" of \"plan\" does not have");
}

}  // namespace
}  // namespace trueaxis

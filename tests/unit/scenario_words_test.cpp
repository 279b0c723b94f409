// SPDX-License-Identifier: Apache-2.0
// Scenario and job use the same words; those that a scenario had before mean the same.
#include <gtest/gtest.h>

#include <limits>

#include "base/never.hpp"
#include "format/text_layout.hpp"
#include "simulate/files/scenario_files.hpp"

namespace trueaxis {
namespace {

using namespace virtual_lathe;

const std::string pass = "[[pass]]\nz_start_mm = 0\nz_end_mm = 10\n";

std::string with_cut(const std::string& part, const std::string& target, const std::string& tool) {
  return "[part]\n" + part + pass + "[cut]\nuse = \"none\"\n[cut.target]\n" + target +
         "[cut.tool]\n" + tool;
}

/// Why it is refused.
std::string refusal(const std::string& content) {
  try {
    parse_scenario_toml(content, "s.toml");
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(ScenarioWords, OfAJobAndOfBeforeMeanTheSame) {
  const Scenario now = parse_scenario_toml(
      with_cut("surface = \"cylinder\"\nfeature = \"bore\"\nradius_mm = 20\n",
               "surface = \"cone\"\nfeature = \"bore\"\nradius_mm = 21\nz_start_mm = 9\n"
               "z_end_mm = 1\nhalf_angle_deg = 5\nopens = \"-z\"\n",
               "sense = \"-c\"\ntool_height_mm = 0.2\n"),
      "now.toml");
  const Scenario before = parse_scenario_toml(
      with_cut("kind = \"cylinder\"\nbore = true\nradius_mm = 20\n",
               "kind = \"cone\"\nbore = true\nradius_mm = 21\nz_start_mm = 9\nz_end_mm = 1\n"
               "half_angle_deg = -5\n",
               "sense = -1\nheight_mm = 0.2\n"),
      "before.toml");
  for (const Scenario& one : {now, before}) {
    EXPECT_EQ(one.part.kind, PartKind::cylinder);
    EXPECT_TRUE(one.part.bore);
    EXPECT_EQ(one.cut->target.kind, CutKind::cone);
    EXPECT_TRUE(one.cut->target.bore);
    EXPECT_DOUBLE_EQ(one.cut->target.half_angle_rad, -5.0 * rad_per_deg);
    EXPECT_EQ(one.cut->tool.sense, -1);
    EXPECT_DOUBLE_EQ(one.cut->tool.height_mm, 0.2);
  }
}

TEST(ScenarioWords, OfAFace) {
  for (const char* const target :
       {"surface = \"face\"\nz_mm = -1\nradius_start_mm = 30\nradius_end_mm = 5\n",
        "kind = \"face\"\nz_face_mm = -1\nx_start_mm = 30\nx_end_mm = 5\n"}) {
    const Scenario scenario = parse_scenario_toml(
        with_cut("surface = \"cylinder\"\nradius_mm = 20\n", target, "sense = \"+c\"\n"), "f.toml");
    EXPECT_EQ(scenario.cut->target.z_face_mm, -1.0);
    EXPECT_EQ(scenario.cut->target.start_mm, 30.0);
    EXPECT_EQ(scenario.cut->target.end_mm, 5.0);
    EXPECT_EQ(scenario.cut->tool.sense, 1);
  }
}

TEST(ScenarioWords, BothNamesOfOneThingAreOneTooMany) {
  const std::string part = "[part]\nradius_mm = 20\nsurface = \"cylinder\"\n";
  EXPECT_NE(
      refusal(part + "kind = \"cone\"\n" + pass)
          .find(
              "s.toml:4:8: `kind`, an earlier name of `surface`, is given as well: keep that one"),
      std::string::npos)
      << refusal(part + "kind = \"cone\"\n" + pass);
  EXPECT_NE(refusal(part + "bore = true\nfeature = \"shaft\"\n" + pass).find("`feature`"),
            std::string::npos);
  EXPECT_NE(
      refusal("[part]\nradius_mm = 20\nsurface = \"cylindr\"\n" + pass).find("must be one of"),
      std::string::npos);
  const std::string sense = refusal(with_cut(
      "surface = \"cylinder\"\nradius_mm = 20\n",
      "surface = \"cylinder\"\nradius_mm = 21\nz_start_mm = 9\nz_end_mm = 1\n", "sense = 2\n"));
  EXPECT_NE(sense.find("`sense` is \"2\" but must be one of: +c, -c"), std::string::npos) << sense;
}

// A message about an earlier word used alone has the word of today.
TEST(ScenarioWords, AnEarlierWordIsToldTheNameOfToday) {
  const std::string target =
      "surface = \"cylinder\"\nradius_mm = 21\nz_start_mm = 9\nz_end_mm = 1\n";
  const std::string part = "surface = \"cylinder\"\nradius_mm = 20\n";
  const std::pair<std::string, const char*> cases[] = {
      {refusal("[part]\nkind = \"cylindr\"\n" + pass),
       "`kind`, an earlier name of `surface`, is \"cylindr\" but must be one of"},
      {refusal("[part]\nkid = \"cylinder\"\n" + pass), "did you mean `surface`?"},
      {refusal("[part]\nbore = \"yes\"\n" + part + pass),
       "`bore`, an earlier name of `feature`, is a string: give true or false"},
      {refusal(with_cut(part, target, "height_um = \"low\"\n")),
       "`height_um`, an earlier name of `tool_height_um`, is a string"},
      {refusal(with_cut(part, target, "hight_um = 1\n")), "did you mean `tool_height_um`?"}};
  for (const auto& [said, expected] : cases)
    EXPECT_NE(said.find(expected), std::string::npos) << said;
}

TEST(Never, SizesThatNothingHasAreSaidInWords) {
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(or_never(50225.0, "mm", "50225 mm", "no size"), "no size");
  EXPECT_EQ(or_never(4e8, "rad", "4e8 rad", "no size"), "no size");
  EXPECT_EQ(or_never(18180.9, "rpm", "18180.9 rpm", "at every speed"), "at every speed");
  EXPECT_EQ(or_never(infinity, "Hz", "inf", "none"), "none");
  EXPECT_EQ(or_never(7.35, "mm", "7.35 mm", "no size"), "7.35 mm");
  EXPECT_EQ(or_never(-50225.0, "mm", "-50225 mm", "no size"), "no size");
  EXPECT_TRUE(is_never(std::nan(""), "mm"));
}

TEST(Never, LengthsFromAMillimetreOnAreInMillimetres) {
  EXPECT_EQ(layout::um(0.0992), "99.2 µm");
  EXPECT_EQ(layout::um(0.9991), "999 µm");
  EXPECT_EQ(layout::um(0.9996), "1 mm");
  EXPECT_EQ(layout::um(3.13), "3.13 mm");
}

}  // namespace
}  // namespace trueaxis

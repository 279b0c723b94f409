// SPDX-License-Identifier: Apache-2.0
#include "format/toml_reader.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace trueaxis {
namespace {

TEST(TomlReader, ReadsTypedKeysInTheUnitInside) {
  TomlDocument document(
      "name = 'a'\nl = 0.5\nx0_um = 50\nhalf_angle_deg = 180\ndelay_ms = 2\nfast = true\n"
      "count = 3\ntable = 'p/t.csv'\nlist_mm = [1, 2.5]\n[tool]\nheight_in = 1\n"
      "feed_um_per_rev = 100\n[[pass]]\nn = 1\n[[pass]]\nn = 2\n",
      "/jobs/a.toml");
  TomlTable root = document.root();
  EXPECT_EQ(root.required_text("name"), "a");
  EXPECT_EQ(root.number("l", 0.0), 0.5);
  EXPECT_DOUBLE_EQ(root.required_number("x0_mm"), 0.05);
  EXPECT_DOUBLE_EQ(root.required_number("half_angle_rad"), std::numbers::pi);
  EXPECT_DOUBLE_EQ(root.number("delay_s", 0.0), 0.002);
  EXPECT_TRUE(root.flag("fast", false));
  EXPECT_EQ(root.integer("count", 0), 3);
  EXPECT_EQ(root.required_path("table"), "/jobs/p/t.csv");
  EXPECT_EQ(root.numbers("list_mm"), (std::vector<double>{1.0, 2.5}));
  TomlTable tool = root.required_table("tool");
  EXPECT_DOUBLE_EQ(tool.number("height_mm", 0.0), 25.4);
  EXPECT_DOUBLE_EQ(tool.number("feed_mm_per_rev", 0.0), 0.1);
  std::vector<TomlTable> passes = root.tables("pass");
  ASSERT_EQ(passes.size(), 2u);
  EXPECT_EQ(passes[0].integer("n", 0), 1);
  EXPECT_EQ(passes[1].integer("n", 0), 2);
  EXPECT_EQ(root.number("absent", 7.0), 7.0);
  EXPECT_NO_THROW(document.finish());
}

TEST(TomlReader, CollectsEveryDiagnosticWithItsPlace) {
  TomlDocument document(
      "x0 = 1\n"                // unit missing
      "radius_mm = 'ten'\n"     // wrong type
      "half_angle_deg = 95\n"   // out of range
      "side = 'up'\n"           // unknown word
      "y0_mm = 1\ny0_um = 2\n"  // twice
      "[part]\nextra = 1\n",
      "s.toml");
  TomlTable root = document.root();
  enum class Side { front, rear };
  root.number("x0_mm", 0.0);
  EXPECT_TRUE(std::isnan(root.required_number("radius_mm")));
  root.number("half_angle_rad", 0.1, Range::inside(0.0, std::numbers::pi / 2));
  EXPECT_EQ(root.choice("side", {{"front", Side::front}, {"rear", Side::rear}}, Side::rear),
            Side::rear);
  root.number("y0_mm", 0.0);
  root.required_table("part").required_number("k_mm");
  root.required_table("plan").required_number("feed_mm_per_rev");
  try {
    document.finish();
    FAIL() << "no diagnostics";
  } catch (const InputError& error) {
    const auto& all = error.diagnostics();
    ASSERT_EQ(all.size(), 8u) << error.what();
    const auto is = [&](std::size_t i, std::size_t line, const char* part) {
      EXPECT_EQ(all[i].file, "s.toml");
      EXPECT_EQ(all[i].line, line) << all[i].message;
      EXPECT_NE(all[i].message.find(part), std::string::npos) << all[i].message;
    };
    is(0, 1, "needs `plan`");
    is(1, 1, "did you mean `x0_mm`");
    is(2, 2, "is a string: give a number");
    is(3, 3, "is 95 but must be in (0, 90)");
    is(4, 4, "must be one of: front, rear");
    is(5, 6, "repeats `y0_mm`");
    is(6, 7, "[part] needs `k_mm`");
    is(7, 8, "[part] has no key `extra`");
  }
}

TEST(TomlReader, ReportsAParseErrorWhereItIs) {
  try {
    TomlDocument document("a = 1\nb = = 2\n", "bad.toml");
    FAIL() << "parsed";
  } catch (const InputError& error) {
    ASSERT_EQ(error.diagnostics().size(), 1u);
    EXPECT_EQ(error.diagnostics()[0].line, 2u);
    EXPECT_GT(error.diagnostics()[0].column, 1u);
  }
}

}  // namespace
}  // namespace trueaxis

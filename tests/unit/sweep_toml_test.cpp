// SPDX-License-Identifier: Apache-2.0
#include "trueaxis/io/sweep_toml.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "trueaxis/base/error.hpp"

namespace trueaxis {
namespace {

using study::Drawn;
using study::Method;

const std::string part = R"(
[part]
kind = "cylinder"
radius_mm = 20
[noise]
sigma_um = 5
[[pass]]
z_start_mm = 0
z_end_mm = -30
[[effect]]
id = "part.roundness"
order = 3
amplitude_um = 2
)";

study::Sweep parse(const std::string& text) { return parse_sweep_toml(text, "sweep.toml"); }

/// All that is said of a wrong sweep.
std::string complaints(const std::string& text) {
  try {
    parse(text);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

void expect_complaint(const std::string& text, const std::string& expected) {
  const std::string said = complaints(text);
  EXPECT_NE(said.find(expected), std::string::npos)
      << "expected: " << expected << "\nsaid: " << said;
}

TEST(SweepToml, ReadsAxesInAnyUnit) {
  const study::Sweep sweep =
      parse("seed = 7\nrepeats = 50\nmethods = [\"fit\", \"tukey\"]\n" + part + R"(
[[axis]]
key = "noise.sigma_um"
values = [2, 5]
[[axis]]
key = "pass.length_mm"
from = 10
to = 40
count = 3
spacing = "log"
[[axis]]
key = "effect.0.phase_deg"
distribution = "uniform"
low = 0
high = 360
[[axis]]
name = "noise kind"
[[axis.case]]
label = "uniform"
set = { "noise.rho" = 0.1, "noise.uniform_um" = 5 }
)");
  EXPECT_EQ(sweep.seed, 7U);
  EXPECT_EQ(sweep.repeats, 50U);
  EXPECT_EQ(sweep.methods, (std::vector<Method>{Method::fit, Method::tukey}));
  ASSERT_EQ(sweep.axes.size(), 3U);
  EXPECT_EQ(sweep.axes[0].name, "noise.sigma_um");
  EXPECT_EQ(sweep.axes[0].points[1].label, "5");
  EXPECT_EQ(sweep.axes[0].points[1].settings[0].path, "noise.sigma_mm");
  EXPECT_DOUBLE_EQ(sweep.axes[0].points[1].settings[0].value, 0.005);
  EXPECT_DOUBLE_EQ(sweep.axes[1].points[1].settings[0].value, 20.0);  // the geometric middle
  EXPECT_EQ(sweep.axes[2].points[0].label, "uniform");
  EXPECT_DOUBLE_EQ(sweep.axes[2].points[0].settings[1].value, 0.005);
  ASSERT_EQ(sweep.drawn.size(), 1U);
  EXPECT_EQ(sweep.drawn[0].path, "effect.0.phase_rad");
  EXPECT_DOUBLE_EQ(sweep.drawn[0].second, 2.0 * std::numbers::pi);
  EXPECT_EQ(study::cell_count(sweep), 2U * 3U * 1U * 2U);
}

TEST(SweepToml, SaysEverythingThatIsWrongAtOnce) {
  const std::string said =
      complaints("repeats = 0\nmethods = [\"guess\"]\nlenght = 3\n" + part + R"(
[[axis]]
key = "noise.sigam_um"
values = [2]
[[axis]]
key = "noise.outlier_fraction"
values = [0.5, 2]
[[axis]]
key = "pass.length_mm"
[[axis]]
key = "part.x0_mm"
distribution = "log-uniform"
low = -1
high = -2
)");
  for (const char* part_of :
       {"`repeats` is 0", "names \"guess\"", "no key `lenght`", "did you mean \"noise.sigma_um\"",
        "gives 2 but must give", "needs `values`, `from` `to` `count`, or a `distribution`",
        "must be more than `low`", "must be more than 0"})
    EXPECT_NE(said.find(part_of), std::string::npos) << part_of << "\nsaid: " << said;
  EXPECT_NE(said.find("sweep.toml:19:"), std::string::npos) << said;  // where sigam stands
}

TEST(SweepToml, RefusesWhatIsNoSweep) {
  expect_complaint("", "needs `part`");
  expect_complaint("scenario = \"not_there.toml\"\n", "not_there.toml");
  expect_complaint(part + "[[axis]]\nkey = \"effect.1.order\"\nvalues = [3]\n", "effect.1.order");
  expect_complaint(part + "[[axis]]\nkey = \"part.half_angle_deg\"\nvalues = [3]\n",
                   "does not have");
  expect_complaint(part + "[[axis]]\nkey = \"noise.rho\"\nvalues = []\n", "is empty");
  expect_complaint(
      part +
          "[[axis]]\nkey = \"noise.rho\"\nvalues = [0]\n[[axis]]\nkey = \"noise.rho\"\n"
          "distribution = \"uniform\"\nlow = 0\nhigh = 0.5\n",
      "vary a number once");
  expect_complaint(
      part + "[[axis]]\nname = \"n\"\n[[axis.case]]\nlabel = \"a\"\nset = { \"noise.x\" = 1 }\n",
      "noise.x");
  expect_complaint(
      part + "[cut.target]\nkind = \"cylinder\"\nz_start_mm = 0\nz_end_mm = 1\nradius_mm = 2\n",
      "a [cut] is a study of its own");
}

TEST(SweepToml, TheHashIsThatOfAllBytes) {
  EXPECT_EQ(parse(part).input_hash, parse(part).input_hash);
  EXPECT_NE(parse(part).input_hash, parse(part + "# a remark\n").input_hash);
}

}  // namespace
}  // namespace trueaxis

// SPDX-License-Identifier: Apache-2.0
#include "study/sweep/files/sweep_toml.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/sweep_text.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis {
namespace {

using study::Drawn;
using study::Method;
using testing::complaints_of_sweep;
using testing::expect_complaint;
using testing::parse_sweep;

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

TEST(SweepToml, ReadsAxesInAnyUnit) {
  const study::Sweep sweep =
      parse_sweep("seed = 7\nrepeats = 50\nmethods = [\"fit\", \"tukey\"]\n" + part + R"(
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
      complaints_of_sweep("repeats = 0\nmethods = [\"guess\"]\nlenght = 3\n" + part + R"(
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
  EXPECT_NE(said.find("sweep.toml:19:"), std::string::npos) << said;  // where `sigam` is
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
  const std::string cut =
      "[cut.target]\nkind = \"cylinder\"\nz_start_mm = 0\nz_end_mm = 1\nradius_mm = 2\n";
  expect_complaint(part + "[cut]\ntable = \"t.csv\"\n" + cut, "remove `table`");
  expect_complaint("surface = \"section\"\n" + part + cut, "an axis with a direction");
  expect_complaint(
      part + "[cut.target]\nkind = \"face\"\nx_start_mm = 1\nx_end_mm = 9\nz_face_mm = 0\n",
      "a sweep cuts a cylinder or a cone");
}

std::string axis(const std::string& key, const std::string& values) {
  return "[[axis]]\nkey = \"" + key + "\"\nvalues = [" + values + "]\n";
}
std::string drawn(const std::string& key) {
  return "[[axis]]\nkey = \"" + key + "\"\ndistribution = \"uniform\"\nlow = 1\nhigh = 2\n";
}
std::string one_case(const std::string& set) {
  return "[[axis]]\nname = \"n\"\n[[axis.case]]\nlabel = \"a\"\nset = { " + set + " }\n";
}

// Two names of one number are one number.
TEST(SweepToml, ANumberIsWrittenOnce) {
  const std::string once = "vary a number once";
  for (const auto& [a, b] :
       {std::pair("pass.feed_mm_per_rev", "pass.0.feed_mm_per_rev"),
        std::pair("pass.length_mm", "pass.z_end_mm"),
        std::pair("pass.length_mm", "pass.0.z_end_um"),
        std::pair("pass.0.length_mm", "pass.length_um"), std::pair("part.x0_mm", "part.x0_um")}) {
    expect_complaint(part + axis(a, "1, 2") + axis(b, "3"), once);
    expect_complaint(part + axis(b, "1, 2") + axis(a, "3"), once);
    expect_complaint(part + axis(a, "1") + drawn(b), once);
    expect_complaint(part + drawn(b) + drawn(a), once);
    expect_complaint(part + axis(a, "1") + one_case('"' + std::string(b) + "\" = 2"), once);
    expect_complaint(part + one_case('"' + std::string(b) + "\" = 2") + axis(a, "1"), once);
    expect_complaint(part + one_case('"' + std::string(a) + "\" = 2, \"" + b + "\" = 3"),
                     "keep one of them");
  }
  const std::string second = "[[pass]]\nz_start_mm = 5\nz_end_mm = 9\n";
  EXPECT_EQ(complaints_of_sweep(part + second + axis("pass.0.length_mm", "1") +
                                axis("pass.1.z_end_mm", "3")),
            "");
}

// The travel starts where the start was set, and keeps its way, whatever the order.
TEST(SweepToml, AStartAndATravelGoTogether) {
  const std::string start = axis("pass.z_start_mm", "-50, 20"),
                    travel = axis("pass.length_mm", "10");
  for (const std::string& text : {part + start + travel, part + travel + start}) {
    const study::Sweep sweep = parse_sweep(text);
    EXPECT_EQ(study::scenario_of(sweep, 0).plan.passes[0].end_mm, -60.0);
    EXPECT_EQ(study::scenario_of(sweep, 1).plan.passes[0].end_mm, 10.0);
  }
  const study::Sweep sweep =
      parse_sweep(part + axis("pass.length_mm", "10") + drawn("pass.z_start_mm"));
  EXPECT_EQ(study::scenario_of(sweep, 0).plan.passes[0].end_mm, 1.5 - 10.0);
}

// A reading of print comes before the axes: what they set again would be lost without a word.
TEST(SweepToml, AReadingSetsWhatNoAxisSets) {
  const auto reading = [](const std::string& set) {
    return axis("pass.length_mm", "10, 20") + axis("noise.sigma_um", "5") +
           "[paper]\nsource = \"s\"\nparameters = [\"x0\"]\n[[paper.row]]\nat = [\"10\", \"5\"]\n"
           "values = [\"0.1\"]\n[[paper.reading]]\nname = \"r\"\nset = { " +
           set + " }\n";
  };
  EXPECT_EQ(complaints_of_sweep(part + reading("\"pass.z_end_mm\" = 5")),
            "");  // the way of the travel
  expect_complaint(part + reading("\"noise.sigma_um\" = 5"), "sets afterwards: remove it");
  expect_complaint(part + reading("\"pass.0.length_mm\" = 5"), "sets afterwards: remove it");
  expect_complaint(part + reading("\"pass.feed_mm_per_rev\" = 5, \"pass.0.feed_mm_per_rev\" = 1"),
                   "keep one of them");
}

// Not every key that there is, on one line.
TEST(SweepToml, AnUnknownKeyIsToldTheNearestAndItsTable) {
  const std::string said = complaints_of_sweep(part + axis("noise.sigam_um", "2"));
  EXPECT_NE(said.find("noise.rho"), std::string::npos) << said;
  EXPECT_EQ(said.find("part.x0_mm"), std::string::npos) << said;
}

TEST(SweepToml, AnAxisWithANameNeedsCases) {
  expect_complaint(part + "[[axis]]\nname = \"noise kind\"\n", "give it [[axis.case]]");
}

TEST(SweepToml, AScenarioThatCannotBeReadHasAPlace) {
  expect_complaint("seed = 1\nscenario = \"nix.toml\"\n", "sweep.toml:2:12: `scenario`");
}

TEST(SweepToml, ARelativeGaugeNeedsItsNominalRadius) {
  const std::string gauge = "[probe]\nrelative_zero_mm = 20\n";
  const std::string why = "give `probe.nominal_radius_mm` too";
  expect_complaint(gauge + part, why);
  expect_complaint(gauge + part, "sweep.toml:2:");
  expect_complaint(part + axis("probe.relative_zero_mm", "20"), why);
  expect_complaint(part + one_case("\"probe.relative_zero_mm\" = 20"), why);
  expect_complaint(part + drawn("probe.relative_zero_mm"), why);
  expect_complaint(part +
                       "[[axis]]\nname = \"first\"\n[[axis.case]]\nlabel = \"a\"\nset = { "
                       "\"noise.rho\" = 0 }\n" +
                       one_case("\"probe.relative_zero_mm\" = 20"),
                   "sweep.toml:20:8: `name` sets `probe.relative_zero_mm`");
  EXPECT_EQ(complaints_of_sweep(gauge + "nominal_radius_mm = 20\n" + part), "");
  EXPECT_EQ(complaints_of_sweep(gauge + part + axis("probe.nominal_radius_mm", "19, 20")), "");
  EXPECT_EQ(
      complaints_of_sweep(
          gauge + "[part]\nkind = \"face\"\nd_mm = 0\n[[pass]]\nx_start_mm = 10\nx_end_mm = 20\n"),
      "");
}

TEST(SweepToml, RhoAndAnAutoregressionContradict) {
  std::string ar = part;
  ar.replace(ar.find("sigma_um = 5"), 12, "sigma_um = 5\nautoregression = [0.5, 0.3]");
  const std::string why = "keep one of them";
  expect_complaint(ar + axis("noise.rho", "0, 0.6"), why);
  expect_complaint(ar + one_case("\"noise.rho\" = 0.6"), why);
  EXPECT_EQ(complaints_of_sweep(ar + axis("noise.rho", "0")), "");
  EXPECT_EQ(complaints_of_sweep(part + axis("noise.rho", "0, 0.6")), "");
}

TEST(SweepToml, TheHashIsThatOfAllBytes) {
  EXPECT_EQ(parse_sweep(part).input_hash, parse_sweep(part).input_hash);
  EXPECT_NE(parse_sweep(part).input_hash, parse_sweep(part + "# a remark\n").input_hash);
}

}  // namespace
}  // namespace trueaxis

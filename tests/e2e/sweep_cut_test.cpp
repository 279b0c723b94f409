// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "support/command_fixture.hpp"
#include "support/places.hpp"

/// Sweeps whose scenario cuts: the residual on the part, against plain geometry.
namespace trueaxis::testing {
namespace {

class SweepCut : public CommandTest {
 protected:
  nlohmann::json cells_of(const std::string& cut, const std::string& axes, int repeats,
                          const std::string& feed = "0.8") {
    write_text(folder_ / "sweep.toml",
               "seed = 7\nrepeats = " + std::to_string(repeats) +
                   "\n[part]\nkind = \"cylinder\"\nx0_mm = 0.08\ny0_mm = -0.06\nl = 0.0003\n"
                   "m = -0.0002\nradius_mm = 32\n[noise]\nsigma_um = 1\n[[pass]]\nz_start_mm = 0\n"
                   "z_end_mm = 40\nfeed_mm_per_rev = 2\nreadings_per_revolution = 24.3\n[cut]\n" +
                   cut +
                   "[cut.target]\nkind = \"cylinder\"\nradius_mm = 30\nz_start_mm = 40\n"
                   "z_end_mm = 20\n[cut.tool]\nfeed_mm_per_rev = " +
                   feed +
                   "\n[cut.actuator]\n"
                   "perfect = true\n" +
                   axes);
    const CommandStreams done = command("study sweep sweep.toml -o out");
    EXPECT_EQ(done.exit_code, 0) << done.err;
    return result("out/sweep.json")["cells"];
  }

  static const nlohmann::json& row(const nlohmann::json& cell, const std::string& name) {
    for (const nlohmann::json& one : cell["rows"])
      if (one["parameter"] == name) return one;
    throw std::runtime_error("no row " + name);
  }
};

// Uncorrected the part is turned about the spindle: the coaxiality is twice how far the reference
// is off it at the worse end of the cut, Z = 40 mm, by the axis as written; 1 nm for contact and
// fit.
TEST_F(SweepCut, UncorrectedItIsTheReferencesOwnEccentricity) {
  const auto cells = cells_of("use = \"none\"\n", "", 3);
  const double n = std::sqrt(1.0 - 0.0003 * 0.0003 - 0.0002 * 0.0002);
  const double off = std::hypot(0.08 + 0.0003 / n * 40.0, -0.06 - 0.0002 / n * 40.0);
  EXPECT_NEAR(row(cells[0], "coaxiality")["bias"]["value"].get<double>(), 2.0 * off, 1e-6);
  EXPECT_TRUE(row(cells[0], "coaxiality")["bound"].is_null());
}

// Followed without error the residual goes with the noise. Without noise there is nothing (10 nm:
// the virtual lathe's table is linear between 360 rows per revolution, A (π/360)²/2 of 0.11 mm
// being 4 nm). Ten times the noise leaves ten times as much, as closely as 50 repeats tell. A
// length of two components has squares that scatter by their mean at most. A root mean square
// therefore scatters by 1/(2 √50), the ratio by √2 of it, and four times that is 40 %. The diameter
// that a run states is kept with 95 %: within five standard deviations of a binomial of 50.
TEST_F(SweepCut, CorrectedItGoesWithTheNoise) {
  const auto cells = cells_of("use = \"wanted\"\n",
                              "[[axis]]\nkey = \"noise.sigma_um\"\nvalues = [0, 1, 10]\n", 50, "2");
  ASSERT_EQ(cells.size(), 3U);
  const auto rmse = [&](std::size_t cell) {
    return row(cells[cell], "coaxiality")["rmse"].get<double>();
  };
  EXPECT_LT(rmse(0), 1e-5);
  EXPECT_NEAR(rmse(2) / rmse(1), 10.0, 4.0);
  for (const std::size_t cell : {1U, 2U}) {
    const double covered = row(cells[cell], "coaxiality")["coverage"]["value"].get<double>();
    EXPECT_NEAR(covered, 0.95, 5.0 * std::sqrt(0.95 * 0.05 / 50.0));
  }
}

// An actuator that follows at once is not sent ahead, whatever the speed: the same 10 nm as above.
TEST_F(SweepCut, WhatFollowsAtOnceIsNotSentAhead) {
  const auto cells =
      cells_of("use = \"command\"\n", "[[axis]]\nkey = \"noise.sigma_um\"\nvalues = [0]\n", 2, "2");
  EXPECT_LT(row(cells[0], "coaxiality")["rmse"].get<double>(), 1e-5);
}

// A pointed tool leaves no feed marks and a nose of radius r leaves arcs of height f²/(8 r), which
// scatter by their height over √(45/4) about their mean; to f²/r² of it and what the probe's lead
// leaves out.
TEST_F(SweepCut, ANumberOfTheCutIsAnAxis) {
  const auto cells =
      cells_of("use = \"wanted\"\n",
               "[[axis]]\nkey = \"cut.tool.nose_radius_mm\"\nvalues = [0, 0.8, 1.6]\n", 2);
  const auto left = [&](std::size_t cell) {
    return row(cells[cell], "cut_residual")["bias"]["value"].get<double>();
  };
  EXPECT_LT(left(0), 1e-5);
  for (const auto& [cell, nose] : {std::pair{1, 0.8}, {2, 1.6}}) {
    const double height = 0.8 * 0.8 / (8.0 * nose);
    EXPECT_NEAR(left(static_cast<std::size_t>(cell)), height / std::sqrt(45.0 / 4.0),
                0.15 * height);
  }
}

TEST_F(SweepCut, TheShippedExampleRuns) {
  const CommandStreams done =
      command("study sweep '" + places::source() + "/data/sweeps/cut.toml' -o out");
  ASSERT_EQ(done.exit_code, 0) << done.err;
  EXPECT_EQ(result("out/sweep.json")["cells"].size(), 8U);
  EXPECT_TRUE(contains(read_text(folder_ / "out/sweep.csv"), ",coaxiality,mm,0,"));
  EXPECT_TRUE(contains(read_text(folder_ / "out/report.html"), "cut_residual"));
}

}  // namespace
}  // namespace trueaxis::testing

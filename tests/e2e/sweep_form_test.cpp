// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "support/command_fixture.hpp"

/// Sweeps that compare the roundness: against lobes whose range is known, and what noise does to
/// it.
namespace trueaxis::testing {
namespace {

class SweepForm : public CommandTest {
 protected:
  nlohmann::json cells_of(const std::string& more) {
    write_text(
        folder_ / "sweep.toml",
        "seed = 11\nrepeats = 40\nsurface = \"section\"\n" + more +
            "[part]\nsurface = \"cylinder\"\nradius_mm = 20\n[noise]\nsigma_um = 0.1\n"
            "[[pass]]\nz_start_mm = 0\nz_end_mm = 0.05\nfeed_mm_per_rev = 0.01\n"
            "readings_per_revolution = 106\n[[effect]]\nid = \"part.roundness\"\norder = 3\n"
            "amplitude_um = 0.5\n[[axis]]\nkey = \"noise.sigma_um\"\nvalues = [0.01, 0.4]\n");
    const CommandStreams done = command("study sweep sweep.toml -o out");
    EXPECT_EQ(done.exit_code, 0) << done.err;
    return done.exit_code == 0 ? result("out/sweep.json")["cells"] : nlohmann::json();
  }

  static const nlohmann::json& row(const nlohmann::json& cell, const std::string& name) {
    for (const nlohmann::json& one : cell["rows"])
      if (one["parameter"] == name) return one;
    throw std::runtime_error("no row " + name);
  }
};

const char* const circles[] = {"RONt_LSCI", "RONt_MZCI", "RONt_MCCI", "RONt_MICI"};

// Three lobes of 0.5 µm through the filter, 2^−(3/15)² of ISO 16610-21, are a range of twice that
// about every circle but for second order, 3²(0.5 µm)²/20 mm; between 300 readings a wave a peak is
// missed by 1 − cos(π/300) = 5.5e-5 of it. Z stays within one section.
TEST_F(SweepForm, IsHeldAgainstWhatDenseReadingsWithoutNoiseShow) {
  const nlohmann::json cells = cells_of("form_upr = [1, 15]\n");
  ASSERT_EQ(cells.size(), 2U);
  const double range_mm = 1e-3 * std::exp2(-std::pow(3.0 / 15.0, 2));
  for (const char* circle : circles) {
    EXPECT_NEAR(row(cells[0], circle).at("true").get<double>(), range_mm, 1.2e-4 * range_mm);
    // If repeats are right with 95 %, fewer than 30 of 40 hold the truth once in 10⁵ sweeps.
    for (const nlohmann::json& cell : cells)
      EXPECT_GE(row(cell, circle).at("coverage").at("value").get<double>(), 0.75) << circle;
    // A range grows with the noise: of σ = 0.4 µm, of which 15 of 53 orders pass, by some 0.4 µm.
    const nlohmann::json &quiet = row(cells[0], circle), &noisy = row(cells[1], circle);
    EXPECT_LT(std::abs(quiet.at("bias").at("value").get<double>()), 2e-5) << circle;
    EXPECT_GT(noisy.at("bias").at("value").get<double>(), 5e-5) << circle;
    EXPECT_TRUE(noisy.at("bound").is_null()) << circle;
  }
  // The zone is the least range of all.
  const auto bias = [&](const char* circle) {
    return row(cells[1], circle).at("bias").at("value").get<double>();
  };
  EXPECT_LT(bias("RONt_MZCI"), bias("RONt_LSCI"));
  EXPECT_LT(bias("RONt_MZCI"), bias("RONt_MCCI"));
}

TEST_F(SweepForm, WithoutABandThereIsNone) {
  const nlohmann::json cells = cells_of("");
  ASSERT_FALSE(cells[0]["rows"].empty());
  for (const nlohmann::json& one : cells[0]["rows"])
    EXPECT_EQ(one["parameter"].get<std::string>().find("RONt"), std::string::npos);
}

TEST_F(SweepForm, ABandThatTheReadingsDoNotCarryFailsWithTheReason) {
  const nlohmann::json cells = cells_of("form_upr = [1, 50]\n");
  EXPECT_EQ(cells[0]["failures"], 40);
  EXPECT_NE(cells[0].dump().find("50 UPR"), std::string::npos) << cells[0].dump();
}

}  // namespace
}  // namespace trueaxis::testing

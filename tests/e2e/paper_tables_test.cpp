// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "support/command_fixture.hpp"
#include "support/places.hpp"

/// The paper's tables as a user runs them. The expected figures are those of
/// tests/reference/paper_tables.py, which shares no code with the engine.
namespace trueaxis::testing {
namespace {

class PaperTables : public CommandTest {
 protected:
  nlohmann::json published(const std::string& table) {
    const CommandStreams done =
        command("study sweep '" + places::source() + "/data/sweeps/" + table + ".toml' -o out");
    EXPECT_EQ(done.exit_code, 0) << done.err;
    printed_ = done.out;
    return result("out/published.json");
  }

  static double chi_squared(const nlohmann::json& reading, std::size_t run) {
    return reading.at("runs").at(run).at("chi_squared");
  }

  std::string printed_;
};

/// The expected figures have two decimals.
constexpr double relative = 0.015;

TEST_F(PaperTables, Table1StandsBesideItsDistribution) {
  const nlohmann::json json = published("table1");
  for (const char* part_of :
       {"Table 1", "pass.length_mm = 50", "402.036", "15.5006", "RMSE / bound", "χ²(6)",
        "Readings of the printed numbers", "out/report.html"})
    EXPECT_TRUE(contains(printed_, part_of)) << part_of << '\n' << printed_;
  const nlohmann::json& plain = json["readings"][0];
  const double expected[] = {6.57, 35.68, 13.37, 0.65, 0.88};
  for (std::size_t run = 0; run < 5; ++run)
    EXPECT_NEAR(chi_squared(plain, run), expected[run], relative * expected[run]) << run;
  EXPECT_LT(plain["runs"][1]["p_value"], 1e-5);
  // k and the angle are all within a quarter of a standard deviation (paper's errors, table above).
  for (const nlohmann::json& run : plain["runs"]) {
    EXPECT_LT(std::abs(run["in_sd"]["k"].get<double>()), 0.25);
    EXPECT_LT(std::abs(run["in_sd"]["half_angle"].get<double>()), 0.255);
  }
  EXPECT_NEAR(plain["runs"][1]["in_sd"]["x0"], 1.19, 0.01);
  EXPECT_NEAR(plain["runs"][4]["in_sd"]["y0"], -0.68, 0.01);
  EXPECT_NEAR(plain["log_likelihood"], 179.12, 0.05);
}

TEST_F(PaperTables, Table1IsReadBestWithTwiceTheAngleAndLessNoise) {
  const nlohmann::json readings = published("table1")["readings"];
  const nlohmann::json* best = &readings[0];
  for (const nlohmann::json& reading : readings)
    if (reading["log_likelihood"] > (*best)["log_likelihood"]) best = &reading;
  EXPECT_EQ((*best)["name"], "Z in [-L, 0], angle error twice, sigma fitted");
  EXPECT_NEAR((*best)["gain"], 30.16, 0.1);
  const nlohmann::json& factor = (*best)["noise_factor"];
  EXPECT_NEAR(factor["value"], 0.2254, 0.001);  // of 10 µm
  EXPECT_NEAR(factor["interval_95"][0], 0.1638, 0.001);
  EXPECT_NEAR(factor["interval_95"][1], 0.3371, 0.001);
}

TEST_F(PaperTables, TheDamagedLevelOfTable2HasAnInterval) {
  const nlohmann::json json = published("table2");
  EXPECT_TRUE(contains(printed_, "noise.sigma_um = ?")) << printed_;
  const double expected[] = {17.94, 15.62, 35.16};
  for (std::size_t run = 0; run < 3; ++run)
    EXPECT_NEAR(chi_squared(json["readings"][0], run), expected[run], relative * expected[run]);
  const nlohmann::json& plain = json["unknown_levels"][0];
  EXPECT_NEAR(plain["best"], 0.0151, 0.0003);
  EXPECT_NEAR(plain["interval_95"][0], 0.00628, 0.0001);
  EXPECT_NEAR(plain["interval_95"][1], 0.0340, 0.0005);
  // With the noise that fits Table 1, 2, 5 and 10 µm are within two units of log-likelihood and 20
  // is beyond three.
  const nlohmann::json& level = json["unknown_levels"][6];
  ASSERT_EQ(json["readings"][6]["noise_factor"]["value"], 0.225);
  const nlohmann::json& at = level["log_likelihood"];
  for (const std::size_t point : {0, 1, 2}) EXPECT_LT(at[point]["below_best"], 2.0) << point;
  EXPECT_GT(at[3]["below_best"], 3.0);
}

TEST_F(PaperTables, AreTheSameBytesOnAnyNumberOfThreads) {
  std::string sweep = read_text(places::source() + "/data/sweeps/table1.toml");
  const std::string repeats = "repeats = 2000";
  ASSERT_NE(sweep.find(repeats), std::string::npos);
  file("sweep.toml", sweep.replace(sweep.find(repeats), repeats.size(), "repeats = 300"));
  for (const std::string threads : {"1", "3"})
    ASSERT_EQ(command("study sweep sweep.toml --threads " + threads + " -o t" + threads).exit_code,
              0);
  for (const char* name : {"published.json", "report.html"})
    EXPECT_EQ(read_text(folder_ / "t1" / name), read_text(folder_ / "t3" / name)) << name;
}

TEST_F(PaperTables, CylinderAndPlaneReachTheBound) {
  for (const char* table : {"table1_cylinder", "table1_plane"}) {
    const CommandStreams done = command(
        std::string("study sweep '" + places::source() + "/data/sweeps/") + table + ".toml'");
    ASSERT_EQ(done.exit_code, 0) << done.err;
    const bool cylinder = std::string(table) == "table1_cylinder";
    EXPECT_TRUE(contains(done.out, cylinder ? "45 of 45 ratios" : "15 of 15 ratios")) << done.out;
  }
  EXPECT_TRUE(files_in(folder_).empty()) << "without -o nothing is written";
}

}  // namespace
}  // namespace trueaxis::testing

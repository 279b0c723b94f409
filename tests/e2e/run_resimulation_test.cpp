// SPDX-License-Identifier: Apache-2.0
// `trueaxis run` simulates what it diagnosed again: result, readings and report say the same.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "support/command_fixture.hpp"
#include "support/hidden_effect.hpp"

namespace trueaxis::testing {
namespace {

using nlohmann::json;

class RunResimulation : public CommandTest {
 protected:
  void SetUp() override {
    CommandTest::SetUp();
    file("part.toml", hidden_.scenario());
    ASSERT_EQ(command("simulate part.toml -o part.csv").exit_code, 0);
    file("job.toml", simple_job(cylinder_reference));
    done_ = command("run job.toml -o out --verbose");
    ASSERT_EQ(done_.exit_code, 0) << done_.err;
    EXPECT_EQ(done_.err, "");
  }
  json summary() { return result("out/result.json").at("references").at(0).at("diagnosis"); }

  HiddenEffect hidden_;
  CommandStreams done_;
};

TEST_F(RunResimulation, TheDiscrepancyLosesWhatTheEffectWas) {
  expect_effect_taken_out(summary().at("simulated_again"), hidden_);
  EXPECT_TRUE(contains(done_.out, "simulated   measured − simulated ")) << done_.out;
}

TEST_F(RunResimulation, IsWhatSimulateFromSays) {
  ASSERT_EQ(command("simulate --from out/diagnosis_1_cylinder.json --stream part.csv --json c.json")
                .exit_code,
            0);
  json alone = result("c.json");
  for (const char* key : {"schema", "version", "diagnosis", "input"}) alone.erase(key);
  EXPECT_EQ(alone, summary().at("simulated_again"));
}

TEST_F(RunResimulation, ReadingsHoldMeasuredAndBothSimulations) {
  EXPECT_EQ(summary().at("readings"), "readings_1_cylinder.csv");
  const std::string csv = read_text(folder_ / "out/readings_1_cylinder.csv");
  EXPECT_EQ(first_line(csv.substr(csv.find('\n') + 1)),
            "row,C[deg],Z[mm],X_M[mm],residual_before[um],effect[um],residual_after[um],masked,"
            "simulated_before[mm],simulated_after[mm]");
  const auto measured = column(csv, "X_M[mm]"), before = column(csv, "simulated_before[mm]"),
             after = column(csv, "simulated_after[mm]"), left = column(csv, "residual_after[um]");
  ASSERT_EQ(static_cast<double>(measured.size()), hidden_.readings);
  double squares = 0.0, gained = 0.0, lathe_and_model = 0.0;
  const double phase = 40.0 * std::numbers::pi / 180.0;
  const auto c_deg = column(csv, "C[deg]");
  for (std::size_t i = 0; i < measured.size(); ++i) {
    squares += std::pow(measured[i] - before[i], 2);
    const double c = c_deg[i] * std::numbers::pi / 180.0;
    const double lobes = hidden_.amplitude_mm * std::cos(3.0 * c - phase);
    gained = std::max(gained, std::abs(after[i] - before[i] - lobes));
    const double by_lathe_um = 1000.0 * (measured[i] - after[i]);
    lathe_and_model = std::max(lathe_and_model, std::abs(by_lathe_um - left[i]));
  }
  const double stated =
      summary().at("simulated_again").at("before").at("rms").at("value").get<double>();
  EXPECT_NEAR(std::sqrt(squares / hidden_.readings), stated, 1e-7);
  // What came in is the lobes, to five times the largest u of four amplitudes and of the axis'
  // six parameters at the ends: 5 σ √(2 · 10/n).
  EXPECT_LT(gained, 5.0 * hidden_.sigma_mm * std::sqrt(20.0 / hidden_.readings));
  // Model and lathe are estimates of one part: they agree within a tenth of the standard
  // uncertainty of an axis' end, σ √(2 · 6/n).
  EXPECT_LT(lathe_and_model, 0.1 * 1000.0 * hidden_.sigma_mm * std::sqrt(12.0 / hidden_.readings));
}

TEST_F(RunResimulation, ReportShowsTheLathesMaps) {
  const std::string page = read_text(folder_ / "out/report.html");
  for (const char* part : {"\"by_lathe\":true", "\"measured_um\"", "\"before_um\"", "\"after_um\""})
    EXPECT_TRUE(contains(page, part)) << part;
}

}  // namespace
}  // namespace trueaxis::testing

// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <numbers>

#include "support/command_fixture.hpp"
#include "support/places.hpp"

/// `data/sweeps/plans.toml`: cases that replace the passes and the effects of a scenario.
namespace trueaxis::testing {
namespace {

class SweepPlans : public ::testing::Test {
 protected:
  /// The sweep is made once: the tests look at its results.
  static void SetUpTestSuite() {
    folder_ = fresh_folder("command/SweepPlans");
    const CommandStreams done =
        run_in(folder_, "study sweep '" + places::source() + "/data/sweeps/plans.toml' -o out");
    ASSERT_EQ(done.exit_code, 0) << done.err;
    json_ = read_json(folder_ / "out/sweep.json");
  }

  static const nlohmann::json& cell(const std::string& plan, const std::string& probe,
                                    const std::string& method) {
    for (const nlohmann::json& one : json_["cells"]) {
      if (one["at"] == nlohmann::json{{"plan", plan}, {"probe", probe}} && one["method"] == method)
        return one;
    }
    throw std::runtime_error("no cell " + plan + ", " + probe + ", " + method);
  }

  static const nlohmann::json& row(const nlohmann::json& cell, const std::string& name) {
    for (const nlohmann::json& one : cell["rows"]) {
      if (one["parameter"] == name) return one;
    }
    throw std::runtime_error("no row " + name);
  }

  /// The bias is `expected` within five of its standard uncertainties: 1 in 10⁶ is not.
  static void expect_bias(const nlohmann::json& cell, const std::string& name, double expected) {
    const nlohmann::json& bias = row(cell, name)["bias"];
    EXPECT_NEAR(bias["value"].get<double>(), expected, 5.0 * bias["u"].get<double>())
        << name << ' ' << cell["at"] << ' ' << cell["method"];
  }

  static inline std::filesystem::path folder_;
  static inline nlohmann::json json_;
};

TEST_F(SweepPlans, EachCellHasItsPassesAndEffects) {
  ASSERT_EQ(json_["cells"].size(), 3U * 2U * 2U);
  // 40 mm at 1 mm a revolution, or twice at 2: 972 readings, and one at the end of each pass.
  EXPECT_EQ(cell("one pass", "in time", "fit")["readings"], 973);
  for (const char* plan : {"there and back", "two speeds"})
    EXPECT_EQ(cell(plan, "in time", "fit")["readings"], 974) << plan;
  for (const char* plan : {"one pass", "there and back", "two speeds"}) {
    for (const char* name : {"x0", "y0"}) expect_bias(cell(plan, "in time", "fit"), name, 0.0);
  }
  const std::string csv = read_text(folder_ / "out/sweep.csv");
  EXPECT_TRUE(contains(csv, "cell,plan,probe,method,")) << csv.substr(0, 300);
  EXPECT_TRUE(contains(csv, "\n11,two speeds,late by 2 ms,diagnosis,"));
}

// One speed: the eccentricity (0.2, 0.1) is turned by 2π/s × 2 ms, and nothing shows it.
TEST_F(SweepPlans, ALateProbeTurnsTheEccentricity) {
  const double turn = 2.0 * std::numbers::pi * 0.002;
  for (const char* method : {"fit", "diagnosis"}) {
    const nlohmann::json& late = cell("one pass", "late by 2 ms", method);
    expect_bias(late, "x0", -turn * 0.1);
    expect_bias(late, "y0", turn * 0.2);
  }
  EXPECT_EQ(cell("one pass", "late by 2 ms", "diagnosis")["named"]["value"], 0.0);
}

// There and back the radius in the middle differs by 2 v delay tan(half angle), v = 2 mm/s: 0.5
// mm/s times the delay. Its u is twice that of all readings together; times 2π/s × 0.216 mm, where
// x is at the far end, it widens the u of y there. A backlash would do the same to the radius and
// nothing to the eccentricity: the readings cannot tell the two, which widens it further. The width
// is the 2.7 µm between their axes times the root of the probability of a rival cause, at most one
// half.
TEST_F(SweepPlans, ASecondSpeedTellsItBest) {
  const nlohmann::json& back = cell("there and back", "late by 2 ms", "diagnosis");
  const nlohmann::json& speeds = cell("two speeds", "late by 2 ms", "diagnosis");
  const double of_radius = row(back, "radius_mid")["bound"],
               of_y = row(back, "y_at_max_z")["bound"];
  const double of_delay_s =
      2.0 * of_radius / (2.0 * 2.0 * std::tan(7.125 * std::numbers::pi / 180));
  const double expected = std::hypot(of_y, 2.0 * std::numbers::pi * 0.216 * of_delay_s);
  const double u_back = row(back, "y_at_max_z")["mean_u"];
  const double apart = 2.0 * std::numbers::pi * 0.002 * 0.216;
  EXPECT_GT(u_back, 0.9 * expected);  // mean of 30, each ±2 % from 960 readings
  EXPECT_LT(u_back, std::hypot(1.1 * expected, std::sqrt(0.5) * apart));
  EXPECT_EQ(speeds["named"]["value"], 1.0);
  expect_bias(speeds, "y_at_max_z", 0.0);
  // What neither plan shows, such as the height of the probe, is in both: of the delay's share at
  // most 0.7 is left.
  const double u_speeds = row(speeds, "y_at_max_z")["mean_u"];
  EXPECT_GT(u_back * u_back - u_speeds * u_speeds, (1.0 - 0.49) * expected * expected);
}

}  // namespace
}  // namespace trueaxis::testing

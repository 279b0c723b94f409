// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "simulate/files/scenario_files.hpp"
#include "study/sweep/files/sweep_toml.hpp"
#include "support/sweep_examples.hpp"
#include "support/sweep_text.hpp"
#include "trueaxis/error.hpp"

/// The kind of noise as an axis: φ of an autoregression.
namespace trueaxis {
namespace {

using testing::complaints_of_sweep;
using testing::expect_complaint;

std::string part(const std::string& autoregression) {
  return "[part]\nkind = \"cylinder\"\nradius_mm = 20\n[noise]\nsigma_um = 5\nautoregression = " +
         autoregression + "\n[[pass]]\nz_start_mm = 0\nz_end_mm = -30\n";
}

std::string axis(int j, const std::string& rest) {
  return "[[axis]]\nkey = \"noise.autoregression." + std::to_string(j) + "\"\n" + rest + "\n";
}

TEST(SweepAutoregression, IsReadAndSet) {
  EXPECT_EQ(parse_scenario_toml(part("[0.5, -0.25]"), "s.toml").noise.autoregression,
            (std::vector<double>{0.5, -0.25}));
  const study::Sweep sweep = parse_sweep_toml(
      part("[0, 0]") + axis(0, "values = [0, 0.6]") + axis(1, "values = [0, 0.3]"), "sweep.toml");
  const auto of = [&](std::size_t cell) {
    return study::scenario_of(sweep, cell).noise.autoregression;
  };
  EXPECT_TRUE(of(0).empty()) << "all 0 is white noise";
  EXPECT_EQ(of(1), (std::vector<double>{0.0, 0.3}));
  EXPECT_EQ(of(2), (std::vector<double>{0.6}));
  EXPECT_EQ(of(3), (std::vector<double>{0.6, 0.3}));
}

// Order 2 is stationary inside the triangle φ2 < 1 − φ1, φ2 < 1 + φ1, φ2 > −1 (Box and Jenkins).
TEST(SweepAutoregression, IsStationaryOrRefused) {
  expect_complaint(part("[0.6, 0.41]"), "is not stationary");
  EXPECT_EQ(complaints_of_sweep(part("[0.6, 0.39]")), "");
  expect_complaint(part("[1.0]"), "is not stationary");
  expect_complaint(part("[0, 0]") + axis(1, "values = [-0.99, -1.01]"),
                   "not stationary at noise.autoregression.1 = -1.01");
  const std::string both = axis(0, "values = [0, 0.9]") + axis(1, "values = [0, 0.3]");
  expect_complaint(part("[0, 0]") + both,
                   "not stationary at noise.autoregression.0 = 0.9, noise.autoregression.1 = 0.3");
  expect_complaint(part("[0, 0]") + both, "sweep.toml:13:");
  EXPECT_EQ(complaints_of_sweep(part("[0, 0]") + axis(0, "values = [0, 0.9]") +
                                axis(1, "values = [-0.9]")),
            "");
  const std::string drawn = "distribution = \"uniform\"\nlow = -0.5\nhigh = ";
  EXPECT_EQ(complaints_of_sweep(part("[0]") + axis(0, drawn + "0.9")), "");
  expect_complaint(part("[0]") + axis(0, drawn + "1.1"),
                   "not stationary at noise.autoregression.0 = 1.1");
  expect_complaint(part("[0]") + axis(1, "values = [0.1]"), "which the scenario does not have");
  std::string rho = part("[0.1]");
  rho.insert(rho.find("autoregression"), "rho = 0.5\n");
  expect_complaint(rho, "contradicts `rho`");
}

// What reading cannot know is the reason of the cell that fails.
TEST(SweepAutoregression, IsTheReasonOfACellThatFails) {
  study::Sweep sweep;
  sweep.base = testing::probed_part(virtual_lathe::PartKind::face);
  sweep.base.noise.autoregression = {0.0};
  sweep.axes = {testing::over("noise.autoregression.0", {0.0, 0.5, 1.2})};
  sweep.repeats = 3;
  const study::Summary summary = study::summarise(sweep, testing::run_all(sweep, 1));
  EXPECT_EQ(summary.cells[0].failures, 0U);
  EXPECT_TRUE(std::isfinite(summary.rows[0].bound)) << "white: as without an autoregression";
  EXPECT_EQ(summary.cells[1].failures, 0U);
  EXPECT_EQ(summary.cells[2].failures, 3U);
  EXPECT_NE(summary.cells[2].why.find("the autoregression is not stationary"), std::string::npos)
      << summary.cells[2].why;
}

}  // namespace
}  // namespace trueaxis

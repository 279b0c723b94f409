// SPDX-License-Identifier: Apache-2.0
// `trueaxis simulate` and `fit`: two set-ups go through the file and come out as one part.
#include <cmath>

#include "support/command_fixture.hpp"

namespace trueaxis::testing {
namespace {

using nlohmann::json;

constexpr const char* two_set_ups = R"(
seed = 5
[part]
kind = "cone"
x0_mm = 0.3
y0_mm = -0.2
l = 0.001
m = -0.003
k_mm = 125.0
half_angle_deg = 10.0
[noise]
sigma_mm = 0.002
[[pass]]
z_start_mm = 30.0
z_end_mm = 50.0
feed_mm_per_rev = 0.5
[[pass]]
z_start_mm = 42.0
z_end_mm = 62.0
feed_mm_per_rev = 0.5
setup = 2
[[setup]]
number = 2
reindex_deg = 70.0
z_shift_mm = 12.0
side = "rear"
x0_mm = -0.15
y0_mm = 0.4
l = -0.004
m = 0.002
)";

class SetUpsCommand : public CommandTest {};

TEST_F(SetUpsCommand, EachIsListedAndTheLastIsTheResult) {
  file("part.toml", two_set_ups);
  ASSERT_EQ(command("simulate part.toml -o part.csv").exit_code, 0);
  const CommandStreams text = command("fit part.csv --surface cone --verbose");
  EXPECT_NE(text.out.find("set-up 1         front: x0"), std::string::npos) << text.out;
  EXPECT_NE(text.out.find("set-up 2         rear:  x0"), std::string::npos) << text.out;
  const json fit = json::parse(command("fit part.csv --surface cone --json -").out);
  EXPECT_EQ(fit.at("status"), "converged");
  const json& list = fit.at("set_ups");
  ASSERT_EQ(list.size(), 2u);
  EXPECT_EQ(list[1].at("side"), "rear");
  EXPECT_NEAR(list[1].at("reindex").at("value").get<double>(), 70.0, 1e-9);
  EXPECT_EQ(list[1].at("z_shift").at("value"), 12.0);
  EXPECT_EQ(fit.at("parameters"), list[1].at("parameters"));
  const auto expect = [&](int set_up, const char* name, double truth) {
    const json& p = list[static_cast<std::size_t>(set_up - 1)].at("parameters").at(name);
    EXPECT_NEAR(p.at("value").get<double>(), truth, 4.5 * p.at("u").get<double>()) << name;
  };
  // The scenario's x0 of a shifted part is at its shift: 12 mm up an axis of slope l/n.
  const double n = std::sqrt(1.0 - 0.004 * 0.004 - 0.002 * 0.002);
  expect(1, "x0", 0.3);
  expect(1, "k", 125.0);
  expect(2, "x0", -0.15 + 12.0 * 0.004 / n);
  expect(2, "m", 0.002);
  expect(2, "k", 125.0 + 12.0 / n);
  expect(2, "half_angle", 10.0);
}

}  // namespace
}  // namespace trueaxis::testing

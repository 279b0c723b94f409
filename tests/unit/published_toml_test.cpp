// SPDX-License-Identifier: Apache-2.0
#include "studies/published/published_toml.hpp"

#include <gtest/gtest.h>

#include "trueaxis/error.hpp"

namespace trueaxis {
namespace {

const std::string sweep_head = R"(repeats = 5
[part]
kind = "cone"
k_mm = 402
half_angle_deg = 15.5
[noise]
sigma_um = 10
[[pass]]
z_start_mm = 0
z_end_mm = 30
[[axis]]
key = "pass.length_mm"
values = [10, 20]
[[axis]]
key = "noise.sigma_um"
values = [2, 50]
)";

study::PublishedSweep parse(const std::string& paper) {
  return parse_published_sweep(sweep_head + paper, "sweep.toml");
}

std::string complaint(const std::string& paper) {
  try {
    parse(paper);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(PublishedToml, RowsKeepTheirDigits) {
  const study::PublishedSweep sweep = parse(R"([paper]
source = "someone"
parameters = ["k", "half_angle"]
[[paper.row]]
at = ["20", "2"]
values = ["402.036", "-15.50"]
[[paper.row]]
name = "damaged"
at = ["20", "?"]
values = ["402", "15.5"]
[[paper.reading]]
name = "plain"
[[paper.reading]]
name = "other side"
set = { "pass.z_end_mm" = -30 }
printed_per_error = { half_angle = 2 }
noise_factor = 0.5
fit_noise = true
least_decimals = { k = 4 }
)");
  ASSERT_TRUE(sweep.published);
  const study::Published& paper = *sweep.published;
  EXPECT_EQ(paper.source, "someone");
  ASSERT_EQ(paper.rows.size(), 2u);
  EXPECT_EQ(paper.rows[0].grid, 2u);  // the second length, the first level
  EXPECT_EQ(paper.rows[0].name, "pass.length_mm = 20, noise.sigma_um = 2");
  EXPECT_EQ(paper.rows[0].values[0].value, 402.036);
  EXPECT_EQ(paper.rows[0].values[0].decimals, 3);
  EXPECT_EQ(paper.rows[0].values[1].value, -15.5);
  EXPECT_EQ(paper.rows[0].values[1].decimals, 2) << "zeros at the end count";
  EXPECT_EQ(paper.rows[1].values[0].decimals, 0);
  EXPECT_EQ(paper.rows[1].name, "damaged");
  EXPECT_EQ(paper.rows[1].unknown_axis, 1u);
  EXPECT_EQ(paper.rows[1].grid, 2u);
  ASSERT_EQ(paper.readings.size(), 2u);
  EXPECT_EQ(paper.readings[0].printed_per_error, (std::vector<double>{1.0, 1.0}));
  const study::PublishedReading& other = paper.readings[1];
  EXPECT_EQ(other.settings.at(0).path, "pass.z_end_mm");
  EXPECT_EQ(other.settings.at(0).value, -30.0);
  EXPECT_EQ(other.printed_per_error, (std::vector<double>{1.0, 2.0}));
  EXPECT_EQ(other.noise_factor, 0.5);
  EXPECT_TRUE(other.fit_noise);
  EXPECT_EQ(other.least_decimals, (std::vector<int>{4, 0}));
}

TEST(PublishedToml, WithoutReadingsThereIsThePlainOne) {
  const study::PublishedSweep sweep = parse(
      "[paper]\nsource = \"x\"\nparameters = [\"k\"]\n[[paper.row]]\nat = [\"10\", \"50\"]\n"
      "values = [\"402\"]\n");
  ASSERT_EQ(sweep.published->readings.size(), 1u);
  EXPECT_EQ(sweep.published->readings[0].noise_factor, 1.0);
  EXPECT_FALSE(parse("").published);
}

TEST(PublishedToml, SaysEverythingThatIsWrong) {
  const std::string said = complaint(R"([paper]
source = "x"
parameters = ["k", "radius", "k"]
[[paper.row]]
at = ["15", "2"]
values = ["402", "4e2", "1"]
[[paper.row]]
at = ["?", "2"]
values = ["402"]
[[paper.row]]
at = ["10"]
values = ["402", "1", "1"]
[[paper.reading]]
name = "a"
set = { "noise.rhoo" = 1 }
printed_per_error = { half_angel = 2 }
noise_factor = 0
)");
  for (const char* part_of :
       {"names \"radius\": the part has x0, y0, l, m, k, half_angle", "names \"k\" twice",
        "pass.length_mm = \"15\": the axis has 10, 20", "\"4e2\", which is not a decimal number",
        "only one noise level can be unknown", "as many texts as there are parameters",
        "must give 2 texts, one value of every axis", "noise.rhoo", "half_angel", "noise_factor"})
    EXPECT_NE(said.find(part_of), std::string::npos) << part_of << "\nsaid: " << said;
  EXPECT_NE(complaint("[paper]\nsource = \"x\"\nparameters = [\"k\"]\n").find("[[paper.row]]"),
            std::string::npos);
}

}  // namespace
}  // namespace trueaxis

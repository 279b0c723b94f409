// SPDX-License-Identifier: Apache-2.0
// The fit and the main job on measured streams (skipped where they are not present). The numbers
// were found in the data by others, apart from this engine.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <sstream>
#include <utility>

#include "measure/files/stream_csv.hpp"
#include "support/command_fixture.hpp"
#include "support/places.hpp"
#include "trueaxis/fit.hpp"

namespace trueaxis::testing {
namespace {

std::string measured(const char* name) {
  return (std::filesystem::path(places::measured_data()) / name).string();
}

double derived(const FitResult& fit, const std::string& name) {
  for (const FitParameter& p : fit.derived)
    if (p.name == name) return p.estimate.value;
  return std::nan("");
}

TEST(MeasuredFit, TubeAsACone) {
  const std::string path = measured("tube_6in.csv");
  if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not here";
  const FitResult result = fit(read_stream_csv(path), FitOptions());
  EXPECT_EQ(result.surface, SurfaceKind::cone);
  EXPECT_NEAR(result.rms_mm, 0.0976, 0.01 * 0.0976);
  EXPECT_EQ(result.points, 60u);
  // Its taper of 0.76 mrad (0.044°) is below 3 u of a form that is 0.1 mm out: no cone, and told
  // so.
  EXPECT_EQ(result.status, FitStatus::rank_deficient);
}

FitResult roundness(const std::string& path, Loss loss) {
  StreamReadOptions options;
  options.indication = Indication::relative;
  options.nominal_radius_mm = 14.5;
  FitOptions fit_options;
  fit_options.surface = SurfaceKind::section;
  fit_options.loss = loss;
  return fit(read_stream_csv(path, options), fit_options);
}

TEST(MeasuredFit, RoundnessTrace) {
  const std::string path = measured("talyrond_trace.csv");
  if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not here";
  const FitResult plain = roundness(path, Loss::plain), robust = roundness(path, Loss::tukey);
  ASSERT_EQ(plain.status, FitStatus::converged);
  ASSERT_EQ(robust.status, FitStatus::converged);
  EXPECT_NEAR(derived(robust, "eccentricity"), 0.2015, 0.0001);
  // The defects, 3 % of the readings and all on one side, pull the plain circle by a share of their
  // mean height.
  EXPECT_NEAR(derived(plain, "eccentricity"), 0.2015, 0.0003);
  EXPECT_NEAR(plain.rms_mm, 0.0013, 0.00005);
  EXPECT_GT(robust.rms_mm, 0.0004);
  EXPECT_LT(robust.rms_mm, 0.0006);
  const double share = static_cast<double>(robust.rejected.size()) / 3600.0;
  EXPECT_GT(share, 0.02);
  EXPECT_LT(share, 0.05);
}

/// Least and greatest X_fts of a table.
std::pair<double, double> wanted_range(const std::string& table) {
  std::istringstream lines(
      table.substr(table.find("\nrev,Z[mm],C[deg],X_fts[mm],X_command[mm]\n")));
  double low = INFINITY, high = -INFINITY;
  for (std::string line; std::getline(lines, line);) {
    double revolution, z, c, wanted;
    if (std::sscanf(line.c_str(), "%lf,%lf,%lf,%lf", &revolution, &z, &c, &wanted) != 4) continue;
    low = std::min(low, wanted);
    high = std::max(high, wanted);
  }
  return {low, high};
}

class MeasuredJob : public CommandTest {};

TEST_F(MeasuredJob, TubeToATable) {
  const std::string path = measured("tube_6in.csv");
  if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not here";
  file(
      "job.toml",
      "[[reference]]\nname = \"tube\"\nstream = \"" + std::filesystem::absolute(path).string() +
          "\"\nsurface = \"cylinder\"\n[target]\nsurface = \"cylinder\"\n"
          "radius_mm = 74\nz_start_mm = 20\nz_end_mm = 0\nstock_um = 5000\n[cut]\nspeed_rpm = 300\n"
          "sense = \"+c\"\nfeed_mm_per_rev = 0.2\nnose_radius_mm = 0.8\n");
  const CommandStreams done = command("run job.toml -o out");
  ASSERT_EQ(done.exit_code, 0) << done.err << done.out;
  EXPECT_EQ(files_in(folder_ / "out"),
            (std::vector<std::string>{"diagnosis_1_tube.json", "readings_1_tube.csv", "report.html",
                                      "result.json", "table.csv"}));
  const nlohmann::json found = result("out/result.json");
  // The sections are 84 to 194 µm off (README of the data); twice that is the stroke.
  const double stroke =
      found.at("correction").at("margin").at("stroke_used").at("value").get<double>();
  EXPECT_GT(stroke, 2 * 0.084);
  EXPECT_LT(stroke, 2 * 0.25);
  // The table against the axis of the same run: once per revolution the tool swings by the offset
  // of the axis, most at the end of the cut that is further off. In second order, offset²/2R: 0.3
  // µm.
  const auto axis = found.at("target_axis");
  const auto value = [&](const char* name) { return axis.at(name).at("value").get<double>(); };
  double offset_mm = 0.0;
  for (const double from_start_mm : {0.0, -20.0}) {
    offset_mm =
        std::max(offset_mm, std::hypot(value("x_at_start") + value("slope_x") * from_start_mm,
                                       value("y_at_start") + value("slope_y") * from_start_mm));
  }
  // And that axis against the fit of the surface alone: within U of what the diagnosis moved.
  const auto fit = found.at("references").at(0).at("fit").at("parameters");
  const auto of = [&](const char* name) { return fit.at(name).at("value").get<double>(); };
  EXPECT_LT(std::hypot(value("x_at_start") - of("x0") - 20.0 * of("l"),
                       value("y_at_start") - of("y0") - 20.0 * of("m")),
            2.0 * value("u_at_start"));
  const auto [low, high] = wanted_range(read_text(folder_ / "out/table.csv"));
  EXPECT_NEAR(high - low, 2 * offset_mm, 0.001);
}

}  // namespace
}  // namespace trueaxis::testing

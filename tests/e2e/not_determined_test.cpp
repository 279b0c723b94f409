// SPDX-License-Identifier: Apache-2.0
// Streams that leave something open: exit code 4, and a result that says what, instead of numbers
// that look fine.
#include "support/command_fixture.hpp"

namespace trueaxis::testing {
namespace {

using nlohmann::json;

class NotDetermined : public CommandTest {
 protected:
  /// The result, written although the exit code is 4.
  json open_fit(const std::string& stream, const std::string& surface) {
    file("open.csv", stream);
    const CommandStreams done = command("fit open.csv --json fit.json --surface " + surface);
    EXPECT_EQ(done.exit_code, 4) << done.err;
    EXPECT_TRUE(contains(done.err, "open.csv: rank_deficient: ")) << done.err;
    const json fit = result("fit.json");
    EXPECT_EQ(fit.at("status"), "rank_deficient");
    EXPECT_GT(fit.at("not_determined").size(), 0u);
    EXPECT_NE(fit.at("message"), "");
    return fit;
  }

  static void expect_withdrawn(const json& fit, const std::string& name) {
    const json& parameter = fit.at("parameters").at(name);
    EXPECT_TRUE(parameter.at("value").is_null()) << name << parameter;
    EXPECT_TRUE(parameter.at("u").is_null()) << name << parameter;
    EXPECT_NE(parameter.value("why", ""), "") << name;
    const json& order = fit.at("covariance").at("order");
    for (std::size_t i = 0; i < order.size(); ++i) {
      if (order[i] != name) continue;
      for (std::size_t j = 0; j < order.size(); ++j)
        EXPECT_TRUE(fit.at("covariance").at("matrix")[i][j].is_null()) << name;
    }
  }
  static void expect_no_axis(const json& fit) {
    for (const char* name : {"x", "y", "slope_x", "slope_y"})
      EXPECT_TRUE(fit.at("axis").at(name).at("value").is_null()) << name;
  }
};

TEST_F(NotDetermined, ConeOfACylinder) {
  for (const double noise_mm : {0.0, 0.002}) {
    const auto fit = open_fit(csv(probe({.noise_mm = noise_mm})), "cone");
    expect_withdrawn(fit, "k");
    expect_withdrawn(fit, "half_angle");
    EXPECT_TRUE(contains(fit.at("message"), "cannot be told from a cylinder"));
    EXPECT_TRUE(fit.at("shape").at("tan_half_angle").at("value").is_null());
    // The axis is determined all the same; u (0.4 µm with noise) bounds how far it may be off.
    EXPECT_NEAR(fit.at("parameters").at("x0").at("value").get<double>(), 0.08, 0.002);
  }
}

TEST_F(NotDetermined, OneSection) {
  for (const char* surface : {"cone", "cylinder"}) {
    const auto fit = open_fit(csv(probe({.sections = 1, .noise_mm = 0.002})), surface);
    expect_withdrawn(fit, "l");
    expect_withdrawn(fit, "m");
    expect_no_axis(fit);
  }
}

TEST_F(NotDetermined, ShortArc) {
  auto readings = probe({.angles = 3600, .noise_mm = 0.002});
  std::erase_if(readings, [](const PartReading& r) { return r.c_deg > 0.8; });
  const auto fit = open_fit(csv(readings), "cylinder");
  expect_withdrawn(fit, "x0");
  expect_withdrawn(fit, "radius");
  expect_no_axis(fit);
}

TEST_F(NotDetermined, NoCorrectionFromIt) {
  open_fit(csv(probe({.noise_mm = 0.002})), "cone");
  file("job.toml", simple_job("stream = \"open.csv\"\nsurface = \"cone\"\nname = \"seat\"\n"));
  expect_input_error("table fit.json --target job.toml -o table.csv", "rank_deficient");
  std::filesystem::create_directories(folder_ / "out");
  file("out/table.csv", earlier_table);
  const CommandStreams done = command("run job.toml -o out");
  EXPECT_EQ(done.exit_code, 4);
  EXPECT_EQ(first_line(done.out).substr(0, 12), "NO-GO: seat:") << done.out;
  EXPECT_FALSE(there("out/table.csv"));
  const json found = result("out/result.json");
  EXPECT_FALSE(found.at("verdict").at("go").get<bool>());
  EXPECT_EQ(found.at("references").at(0).at("fit").at("status"), "rank_deficient");
}

}  // namespace
}  // namespace trueaxis::testing

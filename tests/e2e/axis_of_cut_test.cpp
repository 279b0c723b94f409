// SPDX-License-Identifier: Apache-2.0
// Which axis a cut is about: what is said of the stated, the named and the ideal one, and what a
// job may ask for instead of the stated.
#include <algorithm>
#include <cmath>
#include <filesystem>

#include "support/command_fixture.hpp"
#include "support/places.hpp"

namespace trueaxis::testing {
namespace {

using nlohmann::json;

class AxisOfCut : public CommandTest {
 protected:
  /// A job whose diagnosis moves the axis: a slow asynchronous motion beats with the eccentricity.
  void SetUp() override {
    CommandTest::SetUp();
    file("part.toml", shaft_with("id = \"spindle.asynchronous\"\norder = 0.43\namplitude_um = 10\n",
                                 "1", 30.0, 25.0, 1));
    ASSERT_EQ(command("simulate part.toml -o part.csv").exit_code, 0);
  }

  /// The result of the job with this line in its [correction].
  json run_with(const std::string& asked) {
    file("job.toml", simple_job(cylinder_reference, 600.0, 1000.0) + "[correction]\n" + asked);
    const CommandStreams done = command("run job.toml -o out");
    EXPECT_EQ(done.exit_code, 0) << done.out << done.err;
    return result("out/result.json");
  }
};

/// (x, y) of a fit's axis at z, mm.
std::array<double, 2> axis_at(const json& fit, double z_mm) {
  const auto of = [&](const char* name) {
    return fit.at("parameters").at(name).at("value").get<double>();
  };
  return {of("x0") + of("l") * z_mm, of("y0") + of("m") * z_mm};
}

std::array<double, 2> cut_at_start(const json& run) {
  const json& axis = run.at("target_axis");
  return {axis.at("x_at_start").at("value"), axis.at("y_at_start").at("value")};
}

constexpr double z_start_mm = 40.0;    // of simple_job
constexpr double direction_mm = 1e-5;  // l is a direction cosine, not a slope: z l³/2

TEST_F(AxisOfCut, AJobMayAskForTheIdealOrTheNamedOne) {
  const json stated = run_with(""), ideal = run_with("axis = \"ideal\"\n");
  const json diagnosis = result("out/diagnosis_1_cylinder.json");
  const json named = run_with("axis = \"named\"\n");
  for (const auto& [run, of] :
       {std::pair(&stated, "extended"), {&ideal, "baseline"}, {&named, "named"}}) {
    const auto cut = cut_at_start(*run), is = axis_at(diagnosis.at(of), z_start_mm);
    EXPECT_NEAR(cut[0], is[0], direction_mm) << of;
    EXPECT_NEAR(cut[1], is[1], direction_mm) << of;
  }
  // The final axis is where the part's axis is: a cut about another one is off it by as much.
  const auto about = cut_at_start(ideal), is = cut_at_start(stated);
  const double off_mm = std::hypot(about[0] - is[0], about[1] - is[1]);
  ASSERT_GT(off_mm, 1e-4);
  EXPECT_GE(ideal.at("verdict").at("coaxiality_after").at("value").get<double>(),
            2.0 * off_mm - 1e-6);
  const std::string line = ideal.at("verdict").at("line");
  EXPECT_EQ(ideal.at("verdict").at("decision"), "go_with_reservations") << line;
  EXPECT_TRUE(contains(line, "cuts the part about the ideal axis, not about the final axis"))
      << line;
}

TEST_F(AxisOfCut, CorrectTakesTheSameKey) {
  run_with("");
  std::filesystem::rename(folder_ / "out/table.csv", folder_ / "stated.csv");
  run_with("axis = \"ideal\"\n");
  const CommandStreams done =
      command("table out/diagnosis_1_cylinder.json --target job.toml -o table.csv");
  EXPECT_EQ(done.exit_code, 0) << done.out << done.err;
  EXPECT_TRUE(contains(done.out, "about the ideal axis")) << done.out;
  const auto rows = [&](const char* name) {
    const std::string table = read_text(folder_ / name);
    return table.substr(table.find("\nrev,"));
  };
  EXPECT_EQ(rows("table.csv"), rows("out/table.csv"));
  EXPECT_NE(rows("table.csv"), rows("stated.csv"));
}

// Of the shaft with three lobes U is three times that of the named model, because of what its one
// pass does not show; without its line the widening had no reason on page or terminal.
TEST_F(AxisOfCut, RunAndReportSayTheThreeAxesAndWhy) {
  const std::string job = places::source() + "/data/jobs/shaft_three_lobes.toml";
  const CommandStreams done = command("run " + job + " -o out --verbose");
  EXPECT_EQ(done.exit_code, 0) << done.err;
  for (const char* part : {"axis (x, y); ± U (k = 2)", "\n  stated   (", "\n  named    (",
                           "\n  ideal    (", " at Z 0 mm; "})
    EXPECT_TRUE(contains(done.out, part)) << part << '\n' << done.out;
  EXPECT_FALSE(contains(done.out, "Z -0")) << done.out;
  // The first reason is what widens U most.
  const json of = result("out/diagnosis_1_cone_seat.json").at("shares");
  const auto widens = [](const json& share) {
    const json& shift = share.at("axis_shift");
    return share.at("probability").get<double>() * (std::pow(shift.at("value").get<double>(), 2) +
                                                    std::pow(shift.at("u").get<double>(), 2));
  };
  const json most = *std::ranges::max_element(of, {}, widens);
  const std::string effect = most.at("effect");
  const std::size_t why = done.out.find("\n  why      ");
  ASSERT_NE(why, std::string::npos);
  const std::string first = done.out.substr(why, 120);
  EXPECT_TRUE(contains(first, effect)) << first;
  const std::size_t said = first.find("(probability ");
  ASSERT_NE(said, std::string::npos) << first;
  EXPECT_NEAR(std::stod(first.substr(said + 13)), most.at("probability").get<double>(), 0.005)
      << first;
  const std::string page = read_text(folder_ / "out/report.html");
  const std::size_t shares = page.find("\"shares\":[");
  ASSERT_NE(shares, std::string::npos);
  EXPECT_TRUE(contains(page.substr(shares, 400), effect));
}

// 1.8e-06 % is nothing, and a probe tilted by 1650 degrees no size.
TEST_F(AxisOfCut, WhatCannotBeSeenIsSaidInNumbersThatMeanSomething) {
  const CommandStreams done =
      command("diagnose " + places::source() +
              "/data/streams/shaft_three_lobes.csv --surface cone --verbose");
  EXPECT_EQ(done.exit_code, 0) << done.err;
  for (const char* never : {"e-0", "e+0", "Z -0"})
    EXPECT_FALSE(contains(done.out, never)) << never << '\n' << done.out;
  EXPECT_TRUE(contains(done.out, "less than 0.01 %")) << done.out;
}

}  // namespace
}  // namespace trueaxis::testing

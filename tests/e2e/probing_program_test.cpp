// SPDX-License-Identifier: Apache-2.0
// The program that measures a plan, as LinuxCNC's own interpreter reads it, and its log.
#include <gtest/gtest.h>

#include <cmath>

#include "support/command_fixture.hpp"
#include "support/rs274_calls.hpp"

namespace trueaxis::testing {
namespace {

constexpr double reach = 34.0, front = 5.0, ball = 1.0, clearance = 3.0, search = 1.5;

std::string limits(const std::string& probe) {
  return "[limits]\nx_mm = [-80, 120]\nz_mm = [-60, 80]\nspeed_rpm = 400\n"
         "[part]\nreach_mm = 34\nfront_mm = 5\n"
         "[probe]\nball_radius_mm = 1\nfeed_mm_per_min = 150\nclearance_mm = 3\n" +
         probe;
}
const std::string touch = "kind = \"touch\"\nsearch_mm = 1.5\n";
const std::string analogue = "kind = \"analogue\"\nrate_hz = 1000\nspin_up_s = 0.2\n";

/// A cone of 30 mm at Z 0, out at the front and back at the rear side.
const std::string both_sides =
    "[part]\nsurface = \"cone\"\nradius_mm = 30\nhalf_angle_deg = 3\n[noise]\nsigma_um = 1\n"
    "[[pass]]\nz_start_mm = -30\nz_end_mm = -10\nfeed_mm_per_rev = 10\n"
    "readings_per_revolution = 12\n"
    "[[pass]]\nz_start_mm = -10\nz_end_mm = -30\nfeed_mm_per_rev = 10\n"
    "readings_per_revolution = 12\nsetup = 2\n[[setup]]\nnumber = 2\nside = \"rear\"\n";
const std::string two_speeds =
    "[part]\nsurface = \"cylinder\"\nradius_mm = 30\n[noise]\nsigma_um = 1\n"
    "[[pass]]\nz_start_mm = -30\nz_end_mm = -10\nfeed_mm_per_rev = 1\n"
    "readings_per_revolution = 40.3\nspeed_rpm = 120\n"
    "[[pass]]\nz_start_mm = -10\nz_end_mm = -30\nfeed_mm_per_rev = 1\n"
    "readings_per_revolution = 40.3\nspeed_rpm = -302\n"
    "[[pass]]\nz_mm = -20\nspeed_rpm = 0\nduration_s = 5\nrate_hz = 200\n";

class ProbingProgram : public CommandTest {
 protected:
  CommandStreams plan(const std::string& scenario, const std::string& probe,
                      const std::string& options = "") {
    file("plan.toml", scenario);
    file("limits.toml", limits(probe));
    return command(
        "study plan plan.toml --goal-um 5 --repeats 100 --control linuxcnc "
        "--limits limits.toml -o p.ngc " +
        options);
  }

  /// The calls of the interpreter, from a place clear of the part.
  std::vector<Call> calls() { return interpreted(folder_, "p.ngc"); }

  /// Rapid moves keep their clearance, also on the way from the front to the rear side.
  static void expect_clear(const std::vector<Call>& all) {
    Call before{"", 100.0, 60.0};
    for (const Call& one : all) {
      if (one.name.starts_with("LOG")) continue;
      if (one.name == "STRAIGHT_TRAVERSE") {
        const bool beside =
            std::min(std::abs(one.x), std::abs(before.x)) >= reach + ball + clearance - 1e-3 &&
            one.x * before.x > 0.0;
        const bool before_part = std::min(one.z, before.z) >= front + ball + clearance - 1e-3;
        const bool back = one.z == before.z && std::abs(one.x) > std::abs(before.x) &&
                          one.x * before.x > 0.0;  // away from the part
        EXPECT_TRUE(beside || before_part || back)
            << before.x << ' ' << before.z << " to " << one.x << ' ' << one.z;
      }
      before = one;
    }
  }
};

TEST_F(ProbingProgram, TouchesEveryPointOfThePlanAtItsFeed) {
  if (!has_interpreter()) GTEST_SKIP() << "rs274 (linuxcnc) is not installed";
  const CommandStreams done = plan(both_sides, touch);
  ASSERT_EQ(done.exit_code, 0) << done.err;
  EXPECT_TRUE(contains(done.out, "p.ngc  (50 readings")) << done.out;
  const std::vector<Call> all = calls();
  expect_clear(all);
  EXPECT_EQ(count(all, "STRAIGHT_PROBE"), 50u);
  EXPECT_EQ(count(all, "STRAIGHT_FEED"), 0u);
  std::size_t k = 0;
  for (const Call& one : all) {
    if (one.name != "STRAIGHT_PROBE") continue;
    const bool rear = k >= 25;
    const double i = static_cast<double>(k % 25);
    const double z = rear ? -10.0 - i * 20.0 / 24.0 : -30.0 + i * 20.0 / 24.0;
    const double to = 30.0 + std::tan(3.0 * std::numbers::pi / 180.0) * z + ball - search;
    EXPECT_NEAR(one.z, z, 1e-4);                                // four digits are printed
    EXPECT_NEAR(one.c, 30.0 * i + (rear ? 720.0 : 0.0), 1e-4);  // from the turn in which C is
    EXPECT_NEAR(one.x, rear ? -to : to, 1.5e-4);
    EXPECT_EQ(one.feed, 150.0);
    ++k;
  }
  EXPECT_EQ(all.back().name, "LOG");
  EXPECT_EQ(all.back().words, "END");
}

// What the control logs is read without an option: unit, radius, ball and side are in its head.
TEST_F(ProbingProgram, ImportReadsItsLogWithoutAnOption) {
  if (!has_interpreter()) GTEST_SKIP() << "rs274 (linuxcnc) is not installed";
  ASSERT_EQ(plan(both_sides, touch).exit_code, 0);
  std::string log;
  for (const Call& one : calls())
    if (one.name == "LOG") log += one.words + '\n';
  file("p.log", log);
  const CommandStreams done = command("import p.log -o s.csv --json i.json");
  ASSERT_EQ(done.exit_code, 0) << done.err;
  const std::string stream = read_text(folder_ / "s.csv");
  for (const char* line : {"# x_convention: radius\n", "# ball_radius: 1 mm\n",
                           "# setup.2.side: rear\n", "X_M[mm],C[deg],Z[mm],pass,setup\n"})
    EXPECT_TRUE(contains(stream, line)) << stream;
  EXPECT_EQ(result("i.json")["readings"], 50);
  // A log that was cut off is not a measurement.
  file("cut.log", log.substr(0, log.size() - 60));
  expect_input_error("import cut.log -o cut.csv", "the log ends before its program did");
}

TEST_F(ProbingProgram, ScansWhileTheSpindleTurns) {
  if (!has_interpreter()) GTEST_SKIP() << "rs274 (linuxcnc) is not installed";
  const CommandStreams done = plan(two_speeds, analogue);
  ASSERT_EQ(done.exit_code, 0) << done.err;
  const std::vector<Call> all = calls();
  expect_clear(all);
  EXPECT_EQ(count(all, "STRAIGHT_PROBE"), 0u);
  // Approach and pass, twice, and the approach of the standing capture.
  std::vector<Call> feeds;
  for (const Call& one : all)
    if (one.name == "STRAIGHT_FEED") feeds.push_back(one);
  ASSERT_EQ(feeds.size(), 5u);
  for (const std::size_t approach : {0u, 2u, 4u}) {
    EXPECT_NEAR(feeds[approach].x, 30.0 + ball, 1e-4);
    EXPECT_EQ(feeds[approach].feed, 150.0);
  }
  const double rpm[] = {120.0, 302.0}, sign[] = {1.0, -1.0};
  for (std::size_t pass = 0; pass < 2; ++pass) {
    // 20 revolutions, and a run-in and run-out that last 0.2 s or one revolution.
    const Call &first = feeds[2 * pass], &last = feeds[2 * pass + 1];
    const double run_in = std::max(1.0, 0.2 * rpm[pass] / 60.0);
    EXPECT_NEAR(last.c - first.c, sign[pass] * (20.0 + 2.0 * run_in) * 360.0, 1e-3);
    EXPECT_NEAR(std::abs(last.z - first.z), 20.0 + 2.0 * run_in, 2e-4);
    // The interpreter makes mm/min along Z of the time of a block, at 1 mm per revolution.
    EXPECT_NEAR(last.feed, rpm[pass], 2e-4 * rpm[pass]);
  }
}

/// A pass out over a shaft, at 60 rpm.
const std::string one_pass =
    "seed = 4\n[part]\nsurface = \"cylinder\"\nradius_mm = 30\nx0_mm = 0.05\n[noise]\n"
    "sigma_um = 1\n[[pass]]\nz_start_mm = -30\nz_end_mm = -10\nfeed_mm_per_rev = 1\n"
    "readings_per_revolution = 30.3\nspeed_rpm = 60\n";

// The pass that was measured, and the one that is advised: back at another speed.
TEST_F(ProbingProgram, DrivesTheNextMeasurementOfADiagnosis) {
  if (!has_interpreter()) GTEST_SKIP() << "rs274 (linuxcnc) is not installed";
  file("part.toml", one_pass);
  file("limits.toml", limits(analogue));
  ASSERT_EQ(command("simulate part.toml -o part.csv").exit_code, 0);
  const CommandStreams done = command(
      "advise part.csv --surface cylinder --control linuxcnc --limits limits.toml -o p.ngc");
  ASSERT_EQ(done.exit_code, 0) << done.err;
  EXPECT_TRUE(contains(done.out, "2W  probe back at 151 rpm")) << done.out;
  EXPECT_TRUE(contains(done.out, "Program\n  p.ngc  (")) << done.out;
  const std::vector<Call> all = calls();
  expect_clear(all);
  std::vector<Call> feeds;
  for (const Call& one : all)
    if (one.name == "STRAIGHT_FEED") feeds.push_back(one);
  ASSERT_EQ(feeds.size(), 4u);  // approach and pass, twice
  const double rpm[] = {60.0, 151.0}, way[] = {1.0, -1.0};
  for (std::size_t pass = 0; pass < 2; ++pass) {
    const Call &first = feeds[2 * pass], &last = feeds[2 * pass + 1];
    EXPECT_NEAR(first.x, 30.0 + ball, 0.01);  // the radius that was identified
    // The last reading of 30.3 per revolution is a part of one before the end of 20.
    EXPECT_NEAR(way[pass] * (last.z - first.z), 22.0, 2.0 / 30.3);
    EXPECT_NEAR((last.c - first.c) / 360.0, 22.0, 2.0 / 30.3);
    EXPECT_NEAR(last.feed, rpm[pass], 1e-3 * rpm[pass]);
  }
}

TEST_F(ProbingProgram, AProbeThatCannotReadTheBestPlanDrivesTheNextBest) {
  file("part.toml", one_pass);
  file("limits.toml", limits(touch));
  ASSERT_EQ(command("simulate part.toml -o part.csv").exit_code, 0);
  const std::string advise = "advise part.csv --surface cylinder --control ";
  const CommandStreams done = command(advise + "fanuc --limits fanuc.toml -o p.nc");
  EXPECT_EQ(done.exit_code, 3) << done.out;  // no such file
  const CommandStreams touched = command(advise + "siemens --limits limits.toml -o p.mpf");
  ASSERT_EQ(touched.exit_code, 0) << touched.err;
  const std::string program = read_text(folder_ / "p.mpf");
  EXPECT_FALSE(contains(program, "probe back at 151 rpm")) << program;  // two speeds
  EXPECT_FALSE(contains(program, "spindle reversed")) << program;
  EXPECT_TRUE(contains(program, "from the rear side, from Z -10 to -30 mm and back")) << program;
  EXPECT_EQ(command(advise + "linuxcnc -o p.ngc").exit_code, 2);  // no limits
  EXPECT_EQ(command(advise + "linuxcnc --limits limits.toml").exit_code, 2);
  const CommandStreams unknown = command(advise + "part.nc --limits limits.toml -o p.ngc");
  EXPECT_EQ(unknown.exit_code, 2);
  EXPECT_TRUE(contains(unknown.err, "part.nc not in {linuxcnc")) << unknown.err;
  // A control and the NC program of a machine are two options.
  const CommandStreams nc = command("advise part.csv --surface cylinder --program linuxcnc");
  EXPECT_EQ(nc.exit_code, 2);
  EXPECT_TRUE(contains(nc.err, "--control has a probing program written")) << nc.err;
  const CommandStreams machine =
      command("advise --machine m.toml --control linuxcnc --limits limits.toml -o p.ngc");
  EXPECT_EQ(machine.exit_code, 2);
  EXPECT_TRUE(contains(machine.err, "--control: is for a stream")) << machine.err;
  EXPECT_FALSE(there("p.ngc"));
  const CommandStreams bore = command(
      "advise part.csv --surface cylinder --bore --control linuxcnc --limits limits.toml -o p.ngc");
  EXPECT_EQ(bore.exit_code, 3);
  EXPECT_TRUE(contains(bore.err, "a bore needs bore_radius_mm in [part]")) << bore.err;
  EXPECT_FALSE(there("p.ngc"));
}

TEST_F(ProbingProgram, AnAirRunTouchesNothing) {
  if (!has_interpreter()) GTEST_SKIP() << "rs274 (linuxcnc) is not installed";
  for (const auto& [scenario, probe] : {std::pair{both_sides, touch}, {two_speeds, analogue}}) {
    ASSERT_EQ(plan(scenario, probe, "--air-run --force").exit_code, 0);
    const std::vector<Call> all = calls();
    expect_clear(all);
    EXPECT_EQ(count(all, "STRAIGHT_PROBE") + count(all, "LOG"), 0u);
    EXPECT_GT(count(all, "STRAIGHT_FEED"), 2u);
    for (const Call& one : all)
      EXPECT_TRUE(std::abs(one.x) > reach + ball || one.z > front + ball) << one.x << ' ' << one.z;
  }
}

}  // namespace
}  // namespace trueaxis::testing

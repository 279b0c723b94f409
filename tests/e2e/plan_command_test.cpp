// SPDX-License-Identifier: Apache-2.0
// Planning a measurement, and what unmodelled effects cost, as a user asks for it.
#include <cmath>
#include <set>
#include <sstream>

#include "support/command_fixture.hpp"

namespace trueaxis::testing {
namespace {

using PlanCommand = CommandTest;
using AxisBiasCommand = CommandTest;

const char* const scenario =
    "name = \"seat\"\nseed = 1\n[part]\nkind = \"cylinder\"\nradius_mm = 30\nx0_mm = 0.05\n"
    "[noise]\nsigma_um = 3\n[[pass]]\nz_start_mm = 0\nz_end_mm = 40\nfeed_mm_per_rev = 1\n"
    "readings_per_revolution = 10.3\nspeed_rpm = 60\n";

/// Two axes in what the set-ups' metadata call one clamping.
const char* const moved =
    "[part]\nkind = \"cylinder\"\nradius_mm = 30\nx0_mm = 0.05\n[noise]\nsigma_um = 3\n"
    "[[setup]]\nnumber = 2\nx0_mm = -0.05\n"
    "[[pass]]\nz_start_mm = 0\nz_end_mm = 20\nreadings_per_revolution = 10.3\n"
    "[[pass]]\nz_start_mm = 0\nz_end_mm = 20\nreadings_per_revolution = 10.3\nsetup = 2\n";

// U = k σ √(8/N) of a cylinder (40 turns: 1/40); the goal 0.6 µm needs N = 8 (k σ/U)² = 800.
TEST_F(PlanCommand, AnswersAndConfirms) {
  file("seat.toml", scenario);
  const CommandStreams done = command(
      "study plan seat.toml --goal-um 0.6 --free readings_per_revolution=4:64 --free "
      "sigma_um=0.5:5 "
      "--repeats 200 --seed 7 --json plan.json");
  ASSERT_EQ(done.exit_code, 0) << done.err;
  const nlohmann::json plan = result("plan.json");
  EXPECT_EQ(plan.at("schema"), "trueaxis.plan/1");
  EXPECT_EQ(plan.at("status"), "reached");
  const double as_given = plan.at("as_given").at("U").at("value");
  const double readings = plan.at("as_given").at("readings");
  EXPECT_NEAR(as_given, 2.0 * 3e-3 * std::sqrt(8.0 / readings), as_given / 40.0);
  const nlohmann::json& alone = plan.at("alone").at(0);
  EXPECT_EQ(alone.at("choice"), "readings_per_revolution");
  EXPECT_NEAR(alone.at("plan").at("readings").get<double>(), 800.0, 2.0 * 800.0 / 40.0);
  EXPECT_EQ(plan.at("table").size(), 5U);  // over the noise
  for (const nlohmann::json& one : plan.at("recommended")) {
    EXPECT_LE(one.at("plan").at("U").at("value").get<double>(), 0.6e-3 * (1 + 1e-9));
    EXPECT_TRUE(one.at("confirmed").at("at_bound")) << one << " seed 7";
    EXPECT_EQ(one.at("confirmed").at("repeats"), 200);
  }
  EXPECT_TRUE(contains(done.out, "Recommended, and confirmed by simulation (seed 7)"));
}

// `run` gives no axis of four angles: a plan of four was "within the goal".
TEST_F(PlanCommand, RecommendsNoPlanOfTooFewAngles) {
  file("seat.toml", scenario);
  const CommandStreams done = command(
      "study plan seat.toml --goal-um 5 --free readings_per_revolution=4:64 --repeats 100 --json "
      "plan.json");
  ASSERT_EQ(done.exit_code, 0) << done.err;
  const nlohmann::json plan = result("plan.json");
  for (const nlohmann::json& one : plan.at("recommended"))
    EXPECT_GE(one.at("plan").at("readings_per_revolution").at("value").get<double>(), 7.0) << one;
  EXPECT_TRUE(contains(done.out, "with fewer, no axis is given")) << done.out;
}

TEST_F(PlanCommand, SameSeedSameBytesOnAnyThreads) {
  file("seat.toml", scenario);
  const std::string ask =
      "study plan seat.toml --goal-um 0.8 --free length_mm=20:80 --repeats 300 --seed 3 --json ";
  ASSERT_EQ(command(ask + "one.json --threads 1").exit_code, 0);
  ASSERT_EQ(command(ask + "two.json --threads 2").exit_code, 0);
  EXPECT_EQ(read_text(folder_ / "one.json"), read_text(folder_ / "two.json"));
}

// Every search at once: rows, choices alone, lengths, another probe, a limit of time, a long
// stream.
TEST_F(PlanCommand, SearchesOnAnyThreadsGiveTheSameBytes) {
  file("seat.toml", scenario);
  const std::string ask =
      "study plan seat.toml --goal-um 0.1 --free length_mm=20:80 --free sigma_um=0.5:5 "
      "--free feed_mm_per_rev=0.1:2 --free readings_per_revolution=4:60 --time-s 30 "
      "--repeats 100 --seed 3 --json ";
  ASSERT_EQ(command(ask + "one.json --threads 1").exit_code, 0);
  const std::string one = read_text(folder_ / "one.json");
  EXPECT_EQ(nlohmann::json::parse(one).at("table").size(), 27U);
  for (const char* threads : {"2", "3"}) {
    const CommandStreams done = command(ask + "more.json --threads " + threads);
    ASSERT_EQ(done.exit_code, 0);
    EXPECT_EQ(done.err, "");  // a progress line is for terminals
    EXPECT_EQ(read_text(folder_ / "more.json"), one) << threads;
  }
}

TEST_F(PlanCommand, SaysWhatForbidsAPlan) {
  file("seat.toml", scenario);
  const CommandStreams fast =
      command("study plan seat.toml --goal-um 5 --rate-hz 5 --json fast.json");
  EXPECT_EQ(fast.exit_code, 1) << fast.err;
  EXPECT_TRUE(contains(fast.out, "too fast for the probe")) << fast.out;
  EXPECT_TRUE(result("fast.json").at("recommended").empty());
  const CommandStreams late = command("study plan seat.toml --goal-um 5 --time-s 20");
  EXPECT_EQ(late.exit_code, 1) << late.err;
  EXPECT_TRUE(contains(late.out, "takes too long")) << late.out;
  const CommandStreams bare = command("study plan seat.toml --goal-um 0.1");
  EXPECT_EQ(bare.exit_code, 1) << bare.err;
  EXPECT_TRUE(contains(bare.out, "--free")) << bare.out;
}

// 5 % of outliers of 0.1 mm are 22 µm RMS compared with 3: the plain fit cannot meet what the bound
// does.
TEST_F(PlanCommand, AGoalThatTheFitMissesIsNotConfirmed) {
  std::string spoilt = scenario;
  spoilt.replace(spoilt.find("sigma_um = 3"), 12,
                 "sigma_um = 3\noutlier_fraction = 0.05\noutlier_size_um = 100");
  file("spoilt.toml", spoilt);
  const CommandStreams done =
      command("study plan spoilt.toml --goal-um 1 --repeats 200 --seed 5 --json spoilt.json");
  EXPECT_EQ(done.exit_code, 1) << done.err;
  const nlohmann::json plan = result("spoilt.json");
  EXPECT_EQ(plan.at("status"), "not_confirmed") << "seed 5";
  EXPECT_TRUE(plan.at("recommended").empty()) << "seed 5";
  EXPECT_TRUE(plan.at("not_confirmed").at(0).at("confirmed").at("misses")) << "seed 5";
  EXPECT_TRUE(contains(done.out, "Not confirmed")) << done.out;
}

// Student's t of 4 degrees of freedom: least squares has (v − 2)(v + 3)/(v (v + 1)) = 0.7 of the
// information, so the bound must be √0.7 = 0.837 of the goal; the simulated RMSE of 2000 repeats
// in one direction has a standard error of 1/√4000 = 1.6 %, five of them and 2 digits: 0.1.
TEST_F(PlanCommand, SaysWhichBoundAFitThatWastesNeeds) {
  std::string tails = scenario;
  tails.replace(tails.find("sigma_um = 3"), 12, "sigma_um = 3\nstudent_dof = 4");
  file("tails.toml", tails);
  // As it is 2 × 3 √(0.7 × 8/413) = 0.70 µm by the bound, 0.84 of least squares.
  const CommandStreams done =
      command("study plan tails.toml --goal-um 0.72 --repeats 2000 --seed 11");
  EXPECT_EQ(done.exit_code, 1) << done.err;
  const std::size_t at = done.out.find("ask for a bound of ");
  ASSERT_NE(at, std::string::npos) << done.out;
  EXPECT_NEAR(std::stod(done.out.substr(at + 19)), 0.72 * std::sqrt(0.7), 0.1 * 0.6) << "seed 11";
}

// Three lobes of 8 µm are 5.7 µm RMS compared with 3: σ as the fits see it is 2.1 times as large,
// the axis hardly moves. U as it is: 2 × 3 √(8/413) = 0.84 µm by the bound, 1.8 µm as the fits
// state.
TEST_F(PlanCommand, DoesNotRecommendWhereTheFitsStateMoreThanTheGoal) {
  const std::string lobes = "[[effect]]\nid = \"part.roundness\"\norder = 3\namplitude_um = 8\n";
  const std::string ask =
      "study plan seat.toml --goal-um 1 --repeats 200 --seed 5 --json plan.json";
  const std::string words = "the U that the fits state";
  file("seat.toml", scenario);
  EXPECT_FALSE(contains(command(ask).out, words));
  file("seat.toml", scenario + lobes);
  const CommandStreams done = command(ask);
  EXPECT_EQ(done.exit_code, 1) << done.err;
  EXPECT_TRUE(contains(done.out, "the U that the fits state does not: 1.79 µm")) << done.out;
  EXPECT_FALSE(contains(done.out, "\nRecommended")) << done.out;
  const nlohmann::json plan = result("plan.json");
  EXPECT_EQ(plan.at("status"), "not_confirmed");
  EXPECT_TRUE(plan.at("recommended").empty());
  const nlohmann::json& confirmed = plan.at("not_confirmed").at(0).at("confirmed");
  EXPECT_TRUE(confirmed.at("states_more"));
  EXPECT_FALSE(confirmed.at("misses"));
  // The plan that promises to reach it does: 1.79² = 3.2 times the turns, and a tenth for the
  // digits.
  const std::size_t at = done.out.find("(a feed of ");
  ASSERT_NE(at, std::string::npos) << done.out;
  const double feed_mm = std::stod(done.out.substr(at + 11)) / 1.1;
  EXPECT_NEAR(feed_mm * 1.1, 1.0 / 3.2, 0.02);
  std::string more = scenario + lobes;
  more.replace(more.find("per_rev = 1"), 11, "per_rev = " + std::to_string(feed_mm));
  file("seat.toml", more);
  EXPECT_EQ(command(ask).exit_code, 0) << feed_mm;
}

TEST_F(PlanCommand, CorrelatedNoiseIsSaidToBePerReading) {
  std::string slow = scenario;
  slow.replace(slow.find("sigma_um = 3"), 12, "sigma_um = 3\nrho = 0.5");
  file("slow.toml", slow);
  const std::string ask = "study plan slow.toml --goal-um 3 --repeats 100 --free ";
  EXPECT_TRUE(contains(command(ask + "readings_per_revolution=4:20").out, "persists in time"));
  EXPECT_FALSE(contains(command(ask + "length_mm=20:60").out, "persists in time"));
}

TEST_F(PlanCommand, RefusesAndSaysHowNearItComes) {
  const CommandStreams done = command(
      "study plan --surface cylinder --sigma-um 3 --goal-um 0.05 --free "
      "readings_per_revolution=4:20 "
      "--time-s 30 --json -");
  EXPECT_EQ(done.exit_code, 1) << done.err;
  const nlohmann::json plan = nlohmann::json::parse(done.out);
  EXPECT_EQ(plan.at("status"), "not_reached");
  EXPECT_GT(plan.at("nearest").at("U").at("value").get<double>(), 0.05e-3);
  EXPECT_TRUE(plan.at("recommended").empty());
}

TEST_F(PlanCommand, SaysWhatAPlanCannotShow) {
  file("dwell.toml",
       "[part]\nkind = \"cylinder\"\nradius_mm = 30\n[noise]\nsigma_um = 3\n[[pass]]\n"
       "z_start_mm = 0\nz_end_mm = 0\nrevolutions = 20\nreadings_per_revolution = 10\n");
  const CommandStreams dwell = command("study plan dwell.toml --free sigma_um=1:30");
  EXPECT_EQ(dwell.exit_code, 1) << dwell.err;
  EXPECT_TRUE(contains(dwell.out, "no plan of the ranges determines the axis")) << dwell.out;
  file("cone.toml",
       "[part]\nkind = \"cone\"\nk_mm = 102\nhalf_angle_deg = 25\n[noise]\nsigma_um = 3\n"
       "[[pass]]\nz_start_mm = 0\nz_end_mm = 60\nfeed_mm_per_rev = 1\n"
       "readings_per_revolution = 10\n");
  expect_input_error("study plan cone.toml --free length_mm=20:300", "at the longest length");
}

TEST_F(PlanCommand, WrongRangesAreUsageAndWrongPlansAreInput) {
  EXPECT_EQ(command("study plan --free colour=1:2").exit_code, 2);
  EXPECT_EQ(command("study plan --free sigma_um=1").exit_code, 2);
  const auto expect_usage = [&](const std::string& options, const std::string& why) {
    const CommandStreams done = command("study plan " + options);
    EXPECT_EQ(done.exit_code, 2) << options;
    EXPECT_TRUE(contains(done.err, why)) << options << '\n' << done.err;
    EXPECT_LT(done.err.size(), 300U) << done.err;
  };
  expect_usage("--goal-um 0", "must be more than 0");
  expect_usage("--time-s -1", "must be more than 0");
  expect_usage("--free length_mm=100:10", "length_mm=100:10: LOW is more than HIGH");
  expect_usage("--free length_mm=0:10", "LOW must be more than 0");
  expect_usage("--free length_mm=nan:20", "must be finite");
  expect_usage("--free length_mm=10:20 --free length_um=10:20", "has a range already");
  file("seat.toml", scenario);
  EXPECT_EQ(command("study plan seat.toml --surface cone").exit_code, 2);
  expect_usage("seat.toml --free sigma_um=5:0.5", "LOW is more than HIGH");
  expect_input_error("study plan missing.toml", "missing.toml");
}

TEST_F(AxisBiasCommand, WritesEveryEffectWithLatheAndPrediction) {
  file("seat.toml", scenario);
  const CommandStreams done = command("study axis-bias seat.toml -o axis_bias");
  ASSERT_EQ(done.exit_code, 0) << done.err;
  const nlohmann::json axis_bias = result("axis_bias/axis_bias.json");
  EXPECT_EQ(axis_bias.at("schema"), "trueaxis.axis_bias/2");
  std::set<std::string> ids;
  for (const nlohmann::json& one : axis_bias.at("effects")) {
    ids.insert(one.at("effect"));
    const nlohmann::json& alone = one.at("alone");
    EXPECT_TRUE(alone.at("agrees")) << one;
    const double predicted = alone.at("predicted").at("value");
    EXPECT_NEAR(alone.at("limit").at("value").get<double>(), predicted, 1e-3 * predicted + 1e-6)
        << one;
  }
  EXPECT_EQ(ids.size(), 32U);  // the catalogue without its checks
  std::istringstream csv(read_text(folder_ / "axis_bias" / "axis_bias.csv"));
  std::size_t lines = 0;
  for (std::string line; std::getline(csv, line);) ++lines;
  EXPECT_EQ(lines, axis_bias.at("effects").size() + 2);  // schema and header
  EXPECT_TRUE(there("axis_bias/axis_bias.md"));
}

TEST_F(AxisBiasCommand, OfAFaceItIsTheTilt) {
  file("face.toml",
       "[part]\nkind = \"face\"\nd_mm = 0\n[[pass]]\nx_start_mm = 20\nx_end_mm = 40\n"
       "feed_mm_per_rev = 1\nreadings_per_revolution = 10.3\n");
  const CommandStreams done = command("study axis-bias face.toml");
  EXPECT_EQ(done.exit_code, 0) << done.err;
  EXPECT_TRUE(contains(done.out, "part.face_saddle")) << done.out;
}

TEST_F(AxisBiasCommand, AnAxisThatMovesWithinAClampingIsRefusedAsByAPlan) {
  file("moved.toml", moved);
  const std::string why = "the axis moves between set-ups of one clamping: say in the set-up";
  expect_input_error("study plan moved.toml", why);
  expect_input_error("study axis-bias moved.toml", why);
}

}  // namespace
}  // namespace trueaxis::testing

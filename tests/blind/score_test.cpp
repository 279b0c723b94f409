// SPDX-License-Identifier: Apache-2.0
// How answers are scored, with answers written by hand.
#include "blind/score.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "blind/goals.hpp"
#include "blind/tally.hpp"

namespace trueaxis::blind {
namespace {

const Effect lobes{"part.roundness",
                   {{"order", 3}, {"amplitude_mm", 2e-3}, {"growth_mm", 0}, {"phase_rad", 0.7}}};
const Effect drift{"thermal.drift",
                   {{"rate_mm_per_s", 2e-4}, {"amplitude_mm", 0}, {"time_constant_s", 100}}};

BlindCase case_of(Kind kind, PlanId plan, std::vector<Effect> effects) {
  BlindCase made;
  made.wanted.kind = kind;
  made.wanted.plan = plan;
  made.bench = std::make_shared<const Bench>(plain_scenario(plan, SurfaceId::cone, 0));
  made.scenario = made.bench->scenario();
  made.scenario.effects = std::move(effects);
  made.scenario.noise.sigma_mm = 0.005;
  made.lambdas.assign(made.scenario.effects.size(), 100.0);
  return made;
}

Score scored(const BlindCase& made, const Answer& answer) {
  const Sealed truth{made.wanted.kind, made.scenario.effects, made.scenario.noise.sigma_mm};
  return score(made, truth, answer);
}

Answer saying(std::vector<std::vector<std::string>> classes,
              std::vector<std::string> unexplained = {}) {
  Answer answer;
  answer.exit_code = 0;
  answer.classes = std::move(classes);
  answer.unexplained = std::move(unexplained);
  return answer;
}

TEST(Score, OneCause) {
  const BlindCase made = case_of(Kind::one, PlanId::p3, {lobes});
  const auto outcome = [&](const Answer& answer) { return scored(made, answer).outcome; };
  EXPECT_EQ(outcome(saying({{"part.roundness"}})), Outcome::correct);
  EXPECT_EQ(outcome(saying({{"spindle.radial_synchronous", "part.roundness"}})), Outcome::correct);
  EXPECT_EQ(outcome(saying({{"part.roundness", "thermal.drift"}})), Outcome::too_wide);
  EXPECT_EQ(outcome(saying({{"spindle.radial_synchronous"}})), Outcome::wrong_name);
  EXPECT_EQ(outcome(saying({})), Outcome::missed);
  EXPECT_EQ(outcome(saying({{"part.roundness"}, {"part.bow"}})), Outcome::extra_finding);
  EXPECT_EQ(outcome(saying({{"part.roundness"}}, {"5 UPR"})), Outcome::extra_finding);
  EXPECT_EQ(outcome(saying({}, {"3 UPR"})), Outcome::wrong_name);
  EXPECT_EQ(outcome(Answer{}), Outcome::crash);
}

TEST(Score, TheSameClassIsTooWideOnceThePartWasReclamped) {
  const BlindCase made = case_of(Kind::one, PlanId::p6, {scaled(lobes, 2.0)});
  const Answer answer = saying({{"part.roundness", "spindle.radial_synchronous"}});
  EXPECT_EQ(scored(made, answer).outcome, Outcome::too_wide);
}

TEST(Score, TwoCausesInAnyOrder) {
  const BlindCase made = case_of(Kind::two, PlanId::p3, {lobes, drift});
  EXPECT_EQ(scored(made, saying({{"thermal.drift"}, {"part.roundness"}})).outcome,
            Outcome::correct);
  EXPECT_EQ(scored(made, saying({{"part.roundness"}})).outcome, Outcome::missed);
  EXPECT_EQ(scored(made, saying({{"part.roundness"}, {"part.roundness"}})).outcome,
            Outcome::wrong_name);
}

TEST(Score, APairIsFoundWhereOneFindingCouldHoldEither) {
  const std::vector<std::vector<std::string>> classes{{"part.roundness", "thermal.drift"},
                                                      {"part.roundness"}};
  EXPECT_EQ(pair_up({lobes, drift}, classes), (std::vector<int>{1, 0}));
}

TEST(Score, SilenceAbstentionUnknown) {
  const BlindCase null = case_of(Kind::null, PlanId::p1, {});
  EXPECT_EQ(scored(null, saying({})).outcome, Outcome::correct);
  EXPECT_EQ(scored(null, saying({}, {"2 UPR"})).outcome, Outcome::false_alarm);

  const BlindCase absorbed =
      case_of(Kind::absorbed, PlanId::p1, {{"encoder.offset", {{"angle_rad", 0.1}}}});
  EXPECT_EQ(scored(absorbed, saying({})).outcome, Outcome::not_abstained);
  Answer abstained = saying({});
  abstained.not_observable["encoder.offset"] = "MS";
  EXPECT_EQ(scored(absorbed, abstained).outcome, Outcome::correct);
  abstained.classes = {{"encoder.offset"}};
  EXPECT_EQ(scored(absorbed, abstained).outcome, Outcome::not_abstained);

  const BlindCase unknown = case_of(Kind::unknown, PlanId::p3, {});
  EXPECT_EQ(scored(unknown, saying({}, {"3 UPR"})).outcome, Outcome::correct);
  EXPECT_EQ(scored(unknown, saying({{"part.roundness"}})).outcome, Outcome::not_called_unknown);
  EXPECT_EQ(scored(unknown, saying({})).outcome, Outcome::not_called_unknown);
}

// 40 cases at 97 %: P(X <= 34) = 1.16e-3, P(X <= 33) = 1.7e-4.
TEST(Goals, LeastCountIsABinomialBound) {
  EXPECT_EQ(least_right(40, 0.97), 34u);
  EXPECT_EQ(least_right(10, 1.0 - 1e-9), 10u);  // P(X <= 9) = 1e-8
}

TEST(Goals, IntervalIsClopperAndPearsons) {
  // No failure in n: the lower end is 0.025^(1/n).
  EXPECT_NEAR(share(50, 50).low, std::pow(0.025, 1.0 / 50.0), 1e-9);
  EXPECT_NEAR(share(0, 50).high, 1.0 - std::pow(0.025, 1.0 / 50.0), 1e-9);
}

TEST(Answers, AClassBeginsWithItsName) {
  const auto json = nlohmann::json::parse(R"({"findings": [{"effect": "part.bow",
    "class": ["part.slip", "part.bow"]}], "unexplained": [], "not_observable": []})");
  EXPECT_THROW(read_answer(json), std::runtime_error);
}

}  // namespace
}  // namespace trueaxis::blind

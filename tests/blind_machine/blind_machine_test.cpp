// SPDX-License-Identifier: Apache-2.0
// The diagnosis of machines against sealed truths of the virtual machine. Each bound is binomial:
// it fails where the goal of blind_machine.md would give so few right ones with a probability
// below 1e-4.
#include <gtest/gtest.h>

#include <boost/math/distributions/binomial.hpp>
#include <iostream>

#include "blind_machine/study.hpp"
#include "support/places.hpp"

namespace trueaxis::blind_machine {
namespace {

constexpr std::uint64_t seed = 20261126;

std::size_t least_right(std::size_t cases, double goal_share) {
  const boost::math::binomial_distribution<> right(static_cast<double>(cases), goal_share);
  std::size_t least = 0;
  while (least < cases && cdf(right, static_cast<double>(least)) < 1e-4) ++least;
  return least;
}

StudyOptions options_of(const std::string& folder) {
  StudyOptions options;
  options.command = places::command();
  options.scratch = std::filesystem::path(places::scratch()) / "blind_machine" / folder;
  options.jobs = 1;
  options.progress = [](std::size_t, const Result& result) {
    if (result.outcome != Outcome::correct) std::cout << result.line() << '\n';
  };
  return options;
}

class BlindMachine : public ::testing::TestWithParam<Kind> {};

// 40 cases in all; of the advised ones some promise nothing and do not count.
TEST_P(BlindMachine, ReachesTheGoal) {
  const Kind kind = GetParam();
  const std::size_t cases = kind == Kind::advised ? 14 : kind == Kind::absorbed ? 5 : 7;
  std::cout << "seed " << seed << '\n';
  std::size_t counted = 0, right = 0, far = 0;
  for (const Result& result : run_study(select({kind}, cases, seed), options_of(to_string(kind)))) {
    counted += result.outcome != Outcome::no_advice ? 1 : 0;
    right += result.outcome == Outcome::correct ? 1 : 0;
    far += result.members.far;
  }
  EXPECT_GE(right, least_right(counted, goal(kind))) << counted << " cases";
  EXPECT_EQ(far, 0U) << "members of a class at d >= 6.6";
}

INSTANTIATE_TEST_SUITE_P(Kinds, BlindMachine, ::testing::ValuesIn(all_kinds()),
                         [](const auto& at) { return to_string(at.param); });

// The judge itself: what moves the readings alike has no distance, an effect has its own λ.
TEST(BlindMachineJudge, KnowsTwinsAndStrangers) {
  const Layout& layout = layouts().front();
  const Plan plan = plan_of("ball", layout, 3);
  const Judge judge(layout.machine, plan);
  const std::size_t of = judge.index("EXC.harmonic2");
  ASSERT_LT(of, judge.effects().size());
  const Eigen::VectorXd mu = judge.columns(of).col(0) * 0.005;
  EXPECT_NEAR(judge.distance(mu, "EXC.harmonic2"), 0.0, 1e-6);
  EXPECT_GT(judge.distance(mu, "EZC.harmonic2"), 6.6);
  // The height of C's plane and a ball's own height over it: one ball does not tell.
  const std::size_t twin = judge.index("EZC.harmonic1");
  EXPECT_LT((judge.columns(twin) * 0.01).norm(), 1.5);
}

// Finite differences against the exact chain: the virtual machine is linear in 5 µm to 1e-3.
TEST(BlindMachineJudge, ColumnsAreThoseOfTheMachine) {
  const Layout& layout = layouts()[4];
  const Plan plan = plan_of("bar", layout, 4);
  const Judge judge(layout.machine, plan);
  for (const std::size_t t : {std::size_t{0}, std::size_t{10}, std::size_t{40}}) {
    const Effect& effect = judge.effects()[t];
    const Eigen::VectorXd size =
        Eigen::VectorXd::Constant(judge.columns(t).cols(), effect.angle ? 5e-6 : 5e-3);
    const Eigen::VectorXd linear = judge.columns(t) * size;
    EXPECT_LE((judge.effect_of(with({}, effect, size)) - linear).norm(),
              1e-3 * linear.norm() + 1e-3)
        << effect.name;
  }
}

}  // namespace
}  // namespace trueaxis::blind_machine

// SPDX-License-Identifier: Apache-2.0
// What the form of finished parts tells of the spindle. The expected values follow from normal
// numbers that the test draws itself.
#include "job/machine_motion.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

LoopObservation seen(int order, double cos_mm, double sin_mm, double u_mm = 1e-5) {
  return {0.0, 0.0, 1.0, 1.0, 0.0, {{order, cos_mm, sin_mm, u_mm}}};
}

MachineLoop after_forms(std::initializer_list<LoopObservation> parts) {
  MachineLoop loop;
  for (const LoopObservation& one : parts) learn_motion(loop, {}, one);
  return loop;
}

// Parts with forms of their own, normal and independent, agree as a motion does in one of 100
// loops. This is 50 ± 35 of 5000 (five standard deviations) for any number of parts.
TEST(MachineMotion, FormsOfThePartsOwnAreNotFollowed) {
  std::printf("seed 5\n");
  std::mt19937_64 random(5);
  std::normal_distribution<double> form(0.0, 1e-3);
  for (const int parts : {2, 3, 8}) {
    int wrong = 0;
    for (int loops = 0; loops < 5000; ++loops) {
      MachineLoop loop;
      for (int k = 0; k < parts; ++k) learn_motion(loop, {}, seen(3, form(random), form(random)));
      wrong += !motion_response(loop).empty();
    }
    EXPECT_LE(wrong, 85) << parts;
    EXPECT_GE(wrong, 15) << parts;  // and the probability is that one
  }
}

TEST(MachineMotion, TwoPartsThatAgreeAreFollowedAndOneIsNot) {
  EXPECT_TRUE(motion_response(after_forms({seen(5, 1e-3, -2e-3)})).empty());
  const auto two = motion_response(after_forms({seen(5, 1e-3, -2e-3), seen(5, 1.01e-3, -2e-3)}));
  ASSERT_EQ(two.size(), 1u);
  EXPECT_EQ(two[0].order, 5);
  // Nearly their mean: the prior is of some micrometres.
  EXPECT_NEAR(two[0].cos_mm, 1.005e-3, 1e-6);
  EXPECT_NEAR(two[0].sin_mm, -2e-3, 1e-6);
}

// The form of a ring as a stream: the motion is less the form, and the tester's eccentricity does
// not count.
TEST(MachineMotion, IsLessTheFormOfTheCut) {
  ProbeStream stream;
  for (int i = 0; i < 400; ++i) {
    const double c = two_pi * i / 200.0;
    stream.c_rad.push_back(c);
    stream.reading_mm.push_back(20.0 + 1e-3 * std::cos(c) + 2e-3 * std::cos(4.0 * c) -
                                3e-4 * std::sin(7.0 * c));
  }
  const auto motion = motion_of_form(stream, {});
  ASSERT_EQ(motion.size(), 11u);
  for (const LearnedMotion& one : motion) {
    // e²/2R of the eccentricity is 25 pm.
    EXPECT_NEAR(one.cos_mm, one.order == 4 ? -2e-3 : 0.0, 1e-7) << one.order;
    EXPECT_NEAR(one.sin_mm, one.order == 7 ? 3e-4 : 0.0, 1e-7) << one.order;
  }
}

}  // namespace
}  // namespace trueaxis

// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "study/planning/files/planning_files.hpp"
#include "support/sweep_examples.hpp"

namespace trueaxis {
namespace {

using namespace study;

/// What is printed of a recommendation whose simulated U has this interval; the goal is 1.5 µm.
std::string printed(double low_mm, double high_mm, bool at_bound) {
  PlanningTask task;
  task.goal_mm = 1.5e-3;
  PlanningAnswer answer;
  answer.as_given.scenario = testing::probed_part(virtual_lathe::PartKind::cylinder);
  answer.nearest = answer.as_given;
  answer.reached = answer.confirmed = true;
  Recommendation one{"as it is", answer.as_given, {}};
  one.confirmed.repeats = 400;
  one.confirmed.u_expanded_mm = 0.5 * (low_mm + high_mm);
  one.confirmed.interval_95_mm = {low_mm, high_mm};
  one.confirmed.at_bound = at_bound;
  answer.recommended = {one};
  return planning_text(task, answer);
}

bool says(const std::string& text, const std::string& words) {
  return text.find(words) != std::string::npos;
}

TEST(PlanningText, IsAtTheGoalOnlyWhereTheIntervalHoldsIt) {
  EXPECT_TRUE(says(printed(1.2e-3, 1.4e-3, true), "within the goal, as the bound says"));
  EXPECT_TRUE(says(printed(1.4e-3, 1.6e-3, true), "at the goal, as the bound says"));
  const std::string above = printed(1.54e-3, 1.77e-3, true);
  EXPECT_FALSE(says(above, "at the goal")) << above;
  EXPECT_TRUE(
      says(above, "above the goal, but the difference from the bound is within random scatter"));
}

}  // namespace
}  // namespace trueaxis

// SPDX-License-Identifier: Apache-2.0
// Which readings of a turn lie outside those of other turns at the same angle.
#include <gtest/gtest.h>

#include "spindle/values.hpp"

namespace trueaxis {
namespace {

std::vector<double> outside(const std::vector<double>& value) {
  const std::vector<double> c_rad(value.size(), 1.0);
  return outside_usual(c_rad, value, 100.0);
}

TEST(SpindleOutliers, AChipIsOutsideAndWhatHalfOrAThirdOfTheTurnsHaveIsNot) {
  using Values = std::vector<double>;
  EXPECT_EQ(outside({0, 9, 0}), (Values{0, 9, 0}));
  EXPECT_EQ(outside({0, 0, 9, 0}), (Values{0, 0, 9, 0}));
  EXPECT_EQ(outside({0, -9, 0, 0, 0}), (Values{0, 9, 0, 0, 0}));
  EXPECT_EQ(outside({1, 5, 1, 5, 1}), Values(5, 0.0));
  EXPECT_EQ(outside({1, 5, 1, 5, 1, 5, 20, 5}), (Values{0, 0, 0, 0, 0, 0, 15, 0}));
  EXPECT_EQ(outside({1, 5, 9, 1, 5, 9, 1, 5, 9, 1, 5, 9}), Values(12, 0.0));
}

}  // namespace
}  // namespace trueaxis

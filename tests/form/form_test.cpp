// SPDX-License-Identifier: Apache-2.0
// A few cases of the study of docs/evidence/form_study.md, judged by the binomial interval.
#include <gtest/gtest.h>

#include "form/form_case.hpp"

namespace trueaxis::form_study {
namespace {

// If intervals hold the truth with 93 %, fewer than 31 of 40 do in 3 of 10⁴ seeds; with 70 %, at
// least 31 do in 20 %.
TEST(FormStudy, IntervalsHoldTheTruth) {
  constexpr int cases = 40, fewest = 31;
  int ront = 0, cylt = 0, bounds = 0;
  for (int k = 0; k < cases; ++k) {
    const Drawn one = draw(970'000 + static_cast<std::uint64_t>(k), 900);
    const FormResult result = assessed(one);
    ASSERT_TRUE(result.surface) << "seed " << 970'000 + k;
    const Judged round = judged(result, "RONt", "MZCI", one.ront_mm);
    ront += round.holds ? 1 : 0;
    cylt += judged(result, "CYLt", "MZCY", one.cylt_mm).holds ? 1 : 0;
    bounds += round.bound ? 1 : 0;
  }
  EXPECT_GE(ront, fewest);
  EXPECT_GE(cylt, fewest);
  // A quarter of the parts is round; the lobes of half of the others are above the noise.
  EXPECT_GT(bounds, cases / 10);
  EXPECT_LT(bounds, cases / 2 + cases / 10);
}

}  // namespace
}  // namespace trueaxis::form_study

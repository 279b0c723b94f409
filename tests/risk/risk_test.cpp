// SPDX-License-Identifier: Apache-2.0
// Of GOs at the edge of the tolerance 5 % are out (ISO 14253-1): a short run of the study of
// docs/evidence/go_risk.md, with the binomial interval of its size.
#include <gtest/gtest.h>

#include <boost/math/distributions/binomial.hpp>
#include <string>

#include "risk/risk_case.hpp"

namespace trueaxis::risk {
namespace {

using Binomial = boost::math::binomial_distribution<double>;

/// Where the part is is not known: a GO needs none of these streams.
bool is_to_be_withheld(Group group) {
  return group == Group::two_slips || group == Group::creeping_slip;
}

class RiskOfAGo : public testing::TestWithParam<Group> {};

TEST_P(RiskOfAGo, IsFivePercentAtTheEdgeAndNoneFarFromIt) {
  constexpr std::uint64_t first_seed = 7000;
  constexpr int jobs = 16;  // the study has hundreds
  int go = 0, out = 0, far_out = 0;
  for (int i = 0; i < jobs; ++i) {
    const Outcome o = judge(GetParam(), first_seed + static_cast<std::uint64_t>(i));
    if (!o.plain_go()) continue;
    ++go;
    out += o.coaxiality_mm > o.upper_mm;
    far_out += o.coaxiality_mm > 3.0 * o.upper_mm;
  }
  RecordProperty("seed", std::to_string(first_seed));
  RecordProperty("out", std::to_string(out) + " of " + std::to_string(go));
  EXPECT_EQ(far_out, 0);
  // A verdict that always refuses is useless: if slips are to be refused, the same parts held fast
  // are GO.
  constexpr int held = 8;
  if (is_to_be_withheld(GetParam())) {
    int fast = 0;
    for (int i = 0; i < held; ++i)
      fast += judge(GetParam(), first_seed + static_cast<std::uint64_t>(i), false).plain_go();
    EXPECT_GE(fast, held / 2);
    EXPECT_LE(go, jobs / 2);
  } else if (GetParam() != Group::slip_at_an_end) {  // some leave too few readings to be found
    ASSERT_GE(go, jobs / 2);
  }
  if (go == 0) return;
  // 1 in 1000 streams of tests at most fails although all is right. Of 16 GOs 4 may be out: a risk
  // of 40 % fails with 83 % in each group, one of 30 % with 55 %.
  const double most = boost::math::quantile(Binomial(go, nonconformity_risk), 1.0 - 1e-3);
  EXPECT_LE(out, most) << "of " << go << " GOs, seeds from " << first_seed;
}

struct Seen {
  Group group;
  std::uint64_t seed;
};
class WithheldGo : public testing::TestWithParam<Seen> {};

/// Streams that had a GO which was far out: a slip that four to eight readings follow, and two
/// slips of which only a turn that cannot be would have made one.
TEST_P(WithheldGo, IsNoGoAnyMore) {
  const Outcome o = judge(GetParam().group, GetParam().seed);
  EXPECT_EQ(judge(GetParam().group, GetParam().seed, false).decision, Decision::untoleranced)
      << "held fast it is a GO: the slip alone withholds it";
  EXPECT_NE(o.decision, Decision::untoleranced)
      << "found " << o.found << ", " << o.coaxiality_mm << " mm out, stated " << o.upper_mm;
}

INSTANTIATE_TEST_SUITE_P(Seen, WithheldGo,
                         testing::Values(Seen{Group::slip_at_an_end, 784},
                                         Seen{Group::two_slips, 7854},
                                         Seen{Group::two_slips, 7933}));

INSTANTIATE_TEST_SUITE_P(Groups, RiskOfAGo, testing::ValuesIn(groups), [](const auto& info) {
  std::string name(name_of(info.param));
  std::erase_if(name, [](char c) { return !std::isalnum(static_cast<unsigned char>(c)); });
  return name;
});

}  // namespace
}  // namespace trueaxis::risk

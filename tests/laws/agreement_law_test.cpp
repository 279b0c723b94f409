// SPDX-License-Identifier: Apache-2.0
// References held against each other: a mistake in a stream is named, honest ones are not accused.
#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "laws/agreement_bench.hpp"

namespace trueaxis::testing {
namespace {

constexpr unsigned seeds = 50;
constexpr Population coaxial{.apart_mm = 0.004, .apart_sd_rad = 2e-5};

struct Count {
  int named = 0, wrong = 0;
};

/// The column, unit or convention that a mistake is about.
std::string about(const std::vector<ReasonName>& names) {
  std::string all;
  for (const ReasonName& one : names) all += (all.empty() ? "" : " ") + one.value;
  return all;
}

/// Of 50 parts whose journal is read with the mistake that the one of this code mends.
Count count(ReasonCode what, std::string_view of, const Population& population) {
  Count out;
  for (unsigned seed = 1; seed <= seeds; ++seed) {
    AgreementBench bench(population, seed);
    for (const Mistake& mistake : mistakes()) {
      if (mistake.what != what || about(mistake.of) != of) continue;
      const double number = !mistake.open                         ? 0.0
                            : *mistake.open == OpenNumber::c_zero ? bench.uniform(0.35, 2.7)
                                                                  : bench.uniform(50.0, 200.0);
      bench.spoil(mistake, number);
      const std::optional<Reason> reason = bench.agreement().reason;
      const bool right =
          reason && std::ranges::any_of(reason->parts, [&](const Reason& one) {
            return one.code == what && one.references.front() == 1 && about(one.names) == of;
          });
      out.named += right ? 1 : 0;
      out.wrong += !right && reason ? 1 : 0;
    }
  }
  return out;
}

// A law of at most 1 % shows 3 or more of 50 in 1 of 70 tests, 4 or more in 1 of 500.
constexpr int most_of_50_at_1_percent = 3;

TEST(AgreementLaw, HonestSeats30UmApartAreNotAccused) {
  for (const double tilt : {0.0, 1e-4, 3e-4}) {
    int accused = 0, apart = 0;
    for (unsigned seed = 1; seed <= seeds; ++seed) {
      const Agreement agreement =
          AgreementBench({.apart_mm = 0.03, .apart_sd_rad = tilt}, seed).agreement();
      accused += agreement.reason ? 1 : 0;
      apart += agreement.disagreements.empty() ? 0 : 1;
    }
    EXPECT_LE(accused, most_of_50_at_1_percent) << "tilt " << tilt << ", seeds 1 to 50";
    EXPECT_EQ(apart, static_cast<int>(seeds)) << "30 µm are beyond U, and said";
  }
}

// The journal was turned in this clamping and runs true, the seat does not.
TEST(AgreementLaw, AJournalThatRunsTrueIsNotAccused) {
  int accused = 0;
  for (unsigned seed = 1; seed <= seeds; ++seed) {
    const Population true_journal{.eccentricity_low_mm = 0.01,
                                  .eccentricity_high_mm = 0.2,
                                  .tilt_low_rad = 0.0,
                                  .tilt_high_rad = 5e-4,
                                  .journal_true = true};
    accused += AgreementBench(true_journal, seed).agreement().reason ? 1 : 0;
  }
  EXPECT_LE(accused, most_of_50_at_1_percent) << "seeds 1 to 50";
}

TEST(AgreementLaw, AxesWithinTheirUAreNotSaidToBeApart) {
  int apart = 0;
  for (unsigned seed = 1; seed <= seeds; ++seed)
    apart += AgreementBench({}, seed).agreement().disagreements.empty() ? 0 : 1;
  EXPECT_LE(apart, 1) << "p < 1e-3 in 50: 2 or more in 1 of 800; seeds 1 to 50";
}

struct Named {
  ReasonCode what;
  const char* of;
  int least;  ///< of 50
};
class AgreementNames : public ::testing::TestWithParam<Named> {};

TEST_P(AgreementNames, TheMistake) {
  const Count found = count(GetParam().what, GetParam().of, coaxial);
  EXPECT_GE(found.named, GetParam().least) << to_string(GetParam().what) << ", seeds 1 to 50";
  EXPECT_LE(found.wrong, most_of_50_at_1_percent)
      << to_string(GetParam().what) << ", seeds 1 to 50";
}

// Seen of 200: 196, 197, 197, 200, 200, 123 (where a small eccentricity is not a mistake), 200 and
// 179. The limits are three standard deviations of 50 below.
INSTANTIATE_TEST_SUITE_P(Law, AgreementNames,
                         ::testing::Values(Named{ReasonCode::column_reversed, "C", 45},
                                           Named{ReasonCode::x_convention_wrong, "diameter", 45},
                                           Named{ReasonCode::x_convention_wrong, "radius", 45},
                                           Named{ReasonCode::probed_from_behind, "", 48},
                                           Named{ReasonCode::column_reversed, "Z", 48},
                                           Named{ReasonCode::stream_in_unit, "inch", 20},
                                           Named{ReasonCode::column_in_unit, "mm X", 48},
                                           Named{ReasonCode::c_zero_differs, "", 37}),
                         [](const auto& named) { return "N" + std::to_string(named.index); });

}  // namespace
}  // namespace trueaxis::testing

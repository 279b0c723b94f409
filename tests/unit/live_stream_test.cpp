// SPDX-License-Identifier: Apache-2.0
#include "live/live_stream.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

/// Readings first to last − 1: X is the number, C a tenth of a turn each, wrapped.
ProbeStream part_of(int first, int last) {
  ProbeStream stream;
  for (int i = first; i < last; ++i) {
    stream.reading_mm.push_back(i);
    stream.c_rad.push_back(two_pi * (i % 10) / 10.0 + (i / 10 - first / 10) * two_pi);
    stream.position_mm.push_back(0.5 * i);
  }
  return stream;
}

TEST(LiveStream, KeepsAllInPiecesOfAnySizeAndCGoesOn) {
  LiveStream live(1000);
  for (int first = 0, size = 1; first < 500; first += size, size = 1 + first % 37)
    live.add(part_of(first, std::min(500, first + size)));
  ASSERT_EQ(live.kept().size(), 500u);
  EXPECT_EQ(live.stride(), 1u);
  for (int i = 0; i < 500; ++i) {
    const auto row = static_cast<std::size_t>(i);
    EXPECT_EQ(live.kept().reading_mm[row], i);
    EXPECT_EQ(live.kept().position_mm[row], 0.5 * i);
    EXPECT_NEAR(live.kept().c_rad[row], two_pi * i / 10.0, 1e-9);
  }
}

// Whatever the pieces: every stride-th reading from the first, and never more than allowed.
TEST(LiveStream, ThinsEvenlyAndItsMemoryStays) {
  for (const std::size_t most : {64u, 65u, 100u}) {
    LiveStream live(most);
    for (int first = 0; first < 10000; first += 7) {
      live.add(part_of(first, std::min(10000, first + 7)));
      EXPECT_LE(live.kept().size(), most);
    }
    EXPECT_EQ(live.readings(), 10000u);
    const auto stride = static_cast<double>(live.stride());
    for (std::size_t i = 0; i < live.kept().size(); ++i)
      EXPECT_EQ(live.kept().reading_mm[i], stride * static_cast<double>(i)) << most;
    EXPECT_EQ(live.kept().size(), (10000 + live.stride() - 1) / live.stride());
    EXPECT_GT(2 * live.kept().size(), most - 1);
  }
}

TEST(LiveStream, ASampleIsSpreadOverAllReadings) {
  LiveStream live(10000);
  live.add(part_of(0, 5000));
  EXPECT_EQ(live.sample(6000).size(), 5000u);
  const ProbeStream sample = live.sample(500);
  ASSERT_EQ(sample.size(), 500u);
  for (std::size_t i = 0; i < 500; ++i) {  // one of each ten
    EXPECT_GE(sample.reading_mm[i], 10.0 * static_cast<double>(i));
    EXPECT_LT(sample.reading_mm[i], 10.0 * static_cast<double>(i + 1));
  }
}

}  // namespace
}  // namespace trueaxis

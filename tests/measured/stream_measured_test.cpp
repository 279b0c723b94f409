// SPDX-License-Identifier: Apache-2.0
// The reader and the passes on measured streams (skipped where they are not present).
#include <gtest/gtest.h>

#include <filesystem>

#include "measure/files/stream_csv.hpp"
#include "measure/passes.hpp"
#include "support/places.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

std::string measured(const char* name) {
  return (std::filesystem::path(places::measured_data()) / name).string();
}

TEST(MeasuredStream, TubeHasFiveSectionsOfTwelveAngles) {
  const std::string path = measured("tube_6in.csv");
  if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not here";
  const ProbeStream stream = read_stream_csv(path);
  ASSERT_EQ(stream.size(), 60u);
  EXPECT_EQ(stream.reading_mm.front(), 75.905360);  // the first row as it is in the file
  const auto passes = find_passes(stream);
  ASSERT_EQ(passes.size(), 5u);
  for (std::size_t k = 0; k < 5; ++k) {
    EXPECT_EQ(passes[k].begin, 12 * k);
    EXPECT_EQ(passes[k].end, 12 * (k + 1));
    EXPECT_EQ(passes[k].c_sign, 1);
    EXPECT_EQ(passes[k].feed_sign, 0);
    // The angles are 29.988 degrees apart in the file.
    EXPECT_NEAR(passes[k].readings_per_revolution, 12.0, 0.01);
    // The wrapped column runs on by a turn a section.
    EXPECT_NEAR(stream.c_rad[12 * k], two_pi * static_cast<double>(k), 1e-9);
  }
}

TEST(MeasuredStream, RoundnessTraceIsOneTurn) {
  const std::string path = measured("talyrond_trace.csv");
  if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not here";
  const ProbeStream stream = read_stream_csv(path);
  EXPECT_EQ(stream.size(), 3600u);
  EXPECT_FALSE(stream.has_position());
  const auto passes = find_passes(stream);
  ASSERT_EQ(passes.size(), 1u);
  EXPECT_NEAR(passes[0].readings_per_revolution, 3600.0, 1e-2);  // C has nine decimals
}

}  // namespace
}  // namespace trueaxis

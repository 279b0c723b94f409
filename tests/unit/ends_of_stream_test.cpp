// SPDX-License-Identifier: Apache-2.0
// A part that moved in the last readings leaves too few of them for a finding; what nothing
// explains may move the axis. Neither is a GO.
#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "job/doubts.hpp"
#include "job/files/job_words.hpp"
#include "support/diagnosis_example.hpp"

namespace trueaxis {
namespace {

constexpr std::size_t readings = 400;
constexpr double sigma_mm = 1e-3;

void draw_noise(unsigned seed, std::vector<double>& left_mm) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> noise(0.0, sigma_mm);
  left_mm.resize(readings);
  for (double& r : left_mm) r = noise(random);
}

/// Noise alone is left.
JobResult with_noise(unsigned seed) {
  JobResult result = example::diagnosed_job(readings);
  draw_noise(seed, result.diagnoses.front()->residual_after_mm);
  return result;
}

bool far_off(const JobResult& result) {
  return far_off_at_the_end({}, *result.diagnoses.front()).has_value();
}

std::vector<double>& left_of(JobResult& result) {
  return result.diagnoses.front()->residual_after_mm;
}

TEST(EndsOfStream, NoiseIsTakenForAMovedPartOnceInAThousandStreams) {
  constexpr unsigned seed = 1, streams = 2000;
  unsigned alarms = 0;
  JobResult result = with_noise(seed);
  for (unsigned i = 0; i < streams; ++i) {
    draw_noise(seed + i, left_of(result));
    alarms += far_off(result);
  }
  // Binomial: of 2000 at 10⁻³ more than 8 once in 10 000 times.
  EXPECT_LE(alarms, 8U) << "seeds from " << seed;
}

TEST(EndsOfStream, AStepInTheLastReadingsIsSaid) {
  JobResult result = with_noise(7);
  for (std::size_t i = readings - 4; i < readings; ++i) left_of(result)[i] += 8.0 * sigma_mm;
  const Reasons found = axis_known(result);
  ASSERT_EQ(found.size(), 1u);
  const std::string said = words_of(found.front(), result);
  EXPECT_TRUE(said.starts_with("taper seat: 4 of the last 8 readings")) << said;
  EXPECT_NE(said.find("the part may have slipped there"), std::string::npos);
}

TEST(EndsOfStream, ReadingsThatWereLeftOutAreOffToo) {
  JobResult result = with_noise(7);
  for (std::size_t i = readings - 3; i < readings; ++i)
    left_of(result)[i] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(far_off(result));
}

TEST(EndsOfStream, OutliersThatComeInSuchNumbersElsewhereAreNoStep) {
  JobResult result = with_noise(7);
  for (const std::size_t end : {readings, readings / 2})
    for (std::size_t i = end - 4; i < end; ++i) left_of(result)[i] += 8.0 * sigma_mm;
  EXPECT_FALSE(far_off(result));
}

TEST(EndsOfStream, OneOutlierIsNoStep) {
  JobResult result = with_noise(7);
  left_of(result).back() = 50.0 * sigma_mm;
  EXPECT_FALSE(far_off(result));
}

TEST(LeftUnexplained, MoreThanHalfAgainTheNoiseIsNoNoise) {
  JobResult result = with_noise(7);
  Diagnosis& diagnosis = *result.diagnoses.front();
  diagnosis.noise.source = NoiseSource::revolution_differences;
  diagnosis.noise.sigma_mm = sigma_mm, diagnosis.noise.u_sigma_mm = 0.05 * sigma_mm;
  diagnosis.gain.rms_after_mm = 1.6 * sigma_mm;  // 1.5 (1 + 2 · 0.05) = 1.65
  EXPECT_FALSE(left_unexplained({}, diagnosis));
  diagnosis.gain.rms_after_mm = 1.7 * sigma_mm;
  const auto found = left_unexplained({}, diagnosis);
  ASSERT_TRUE(found);
  EXPECT_TRUE(words_of(*found).starts_with("the causes found leave a residual of 1.7 µm"))
      << words_of(*found);
}

// Of 400 readings of noise no two neighbours differ by 8 σ of the difference, 11.3 σ of a reading:
// p = 400 · 1e-15.
TEST(JumpLeft, NoNoiseGoesSoFarToTheNextReading) {
  JobResult result = with_noise(7);
  Diagnosis& diagnosis = *result.diagnoses.front();
  EXPECT_FALSE(jump_left({}, diagnosis));
  for (std::size_t i = 100; i < 110; ++i) left_of(result)[i] += 20.0 * sigma_mm;
  const auto found = jump_left({}, diagnosis);
  ASSERT_TRUE(found);
  const std::string words = words_of(*found);
  EXPECT_TRUE(words.starts_with("at data row 101 the residual jumps") ||
              words.starts_with("at data row 111 the residual jumps"))
      << words;
  for (std::size_t i = 100; i < 110; ++i) diagnosis.noise.masked.push_back({i + 1, ""});
  EXPECT_FALSE(jump_left({}, diagnosis));
  left_of(result)[200] += 20.0 * sigma_mm;
  EXPECT_FALSE(jump_left({}, diagnosis)) << "a spike";
}

}  // namespace
}  // namespace trueaxis

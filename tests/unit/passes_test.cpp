// SPDX-License-Identifier: Apache-2.0
#include "measure/passes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>

#include "trueaxis/error.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

/// A stream built move by move: what the plan says is what the passes must say.
class Plan {
 public:
  explicit Plan(bool with_time = true) : with_time_(with_time) {}

  /// `count` readings from where the axes are; each turns by `turns` and feeds by `feed_mm` in
  /// `dt_s`.
  Plan& move(std::size_t count, double turns, double feed_mm, double dt_s = 0.01) {
    for (std::size_t i = 0; i < count; ++i) {
      stream.reading_mm.push_back(40.0);
      stream.c_rad.push_back(c_);
      stream.position_mm.push_back(z_);
      if (with_time_) stream.time_s.push_back(t_);
      c_ += two_pi * turns;
      z_ += feed_mm;
      t_ += dt_s;
    }
    return *this;
  }
  /// Between readings: nothing is recorded.
  Plan& jump(double turns, double feed_mm, double dt_s = 0.5) {
    c_ += two_pi * turns;
    z_ += feed_mm;
    t_ += dt_s;
    return *this;
  }
  Plan& noise(unsigned seed, double c_rad, double z_mm, double t_s = 0.0) {
    std::mt19937 random(seed);
    std::normal_distribution<double> normal;
    for (double& c : stream.c_rad) c += c_rad * normal(random);
    for (double& z : stream.position_mm) z += z_mm * normal(random);
    for (double& t : stream.time_s) t += t_s * std::abs(normal(random));
    return *this;
  }
  ProbeStream stream;

 private:
  bool with_time_;
  double c_ = 0.0, z_ = 0.0, t_ = 0.0;
};

const char* sense(int sign) { return sign > 0 ? "+" : sign < 0 ? "-" : "0"; }

/// "begin-end senses" of every pass.
std::string shape(const std::vector<Pass>& passes) {
  std::string text;
  for (const Pass& pass : passes) {
    text += std::to_string(pass.begin) + "-" + std::to_string(pass.end) + " C" +
            sense(pass.c_sign) + " Z" + sense(pass.feed_sign) + "\n";
  }
  return text;
}

/// The senses alone.
std::string senses(const std::vector<Pass>& passes) {
  std::string text;
  for (const Pass& pass : passes) {
    text += std::string("C") + sense(pass.c_sign) + "Z" + sense(pass.feed_sign) + " ";
  }
  return text;
}

void expect_cover(const ProbeStream& stream, const std::vector<Pass>& passes) {
  ASSERT_FALSE(passes.empty());
  EXPECT_EQ(passes.front().begin, 0u);
  EXPECT_EQ(passes.back().end, stream.size());
  for (std::size_t k = 1; k < passes.size(); ++k) EXPECT_EQ(passes[k].begin, passes[k - 1].end);
}

TEST(Passes, AHelixIsOnePass) {
  const Plan plan = Plan().move(720, 1.0 / 36, 0.2 / 36, 1.0 / 36);
  const auto passes = find_passes(plan.stream);
  ASSERT_EQ(shape(passes), "0-720 C+ Z+\n");
  // Exact but for rounding in sums of 720 terms.
  EXPECT_NEAR(passes[0].feed_mm_per_rev, 0.2, 1e-12);
  EXPECT_NEAR(passes[0].readings_per_revolution, 36.0, 1e-10);
  EXPECT_NEAR(passes[0].speed_rad_per_s, two_pi, 1e-11);
}

TEST(Passes, SpeedAndFeedAreSigned) {
  const auto passes = find_passes(Plan().move(360, -1.0 / 36, -0.2 / 36, 1.0 / 36).stream);
  ASSERT_EQ(shape(passes), "0-360 C- Z-\n");
  EXPECT_NEAR(passes[0].speed_rad_per_s, -two_pi, 1e-11);
  EXPECT_NEAR(passes[0].feed_mm_per_rev, -0.2, 1e-12);
}

// The reading that ends a positioning move belongs to the pass before it, and a pause within a pass
// is not turned through: neither makes the spindle slower. Exact but for rounding in sums.
TEST(Passes, AWaitIsNoSpeed) {
  for (const double wait_s : {0.5, 2.0, 60.0}) {
    const Plan plan = Plan()
                          .move(480, 1.0 / 24, 30.0 / 480, 0.25 / 24)
                          .jump(0.2, 0.0, wait_s)
                          .move(480, 1.0 / 24, -30.0 / 480, 0.1 / 24);
    const auto passes = find_passes(plan.stream);
    ASSERT_EQ(passes.size(), 2U);
    EXPECT_NEAR(passes[0].speed_rad_per_s, two_pi / 0.25, 1e-9) << wait_s;
    EXPECT_NEAR(passes[1].speed_rad_per_s, two_pi / 0.1, 1e-9) << wait_s;
    const auto paused = find_passes(Plan()
                                        .move(240, 1.0 / 24, 15.0 / 480, 0.25 / 24)
                                        .jump(0.2, 0.0, wait_s)
                                        .move(240, 1.0 / 24, 15.0 / 480, 0.25 / 24)
                                        .stream);
    for (const Pass& pass : paused)
      EXPECT_NEAR(pass.speed_rad_per_s, two_pi / 0.25, 1e-9) << wait_s;
  }
}

// Times of a clock that is coarser than an eighth of a revolution: the mean speed, to its tick.
TEST(Passes, CoarseTimes) {
  Plan plan = Plan().move(480, 1.0 / 24, 30.0 / 480, 0.1 / 24);
  for (double& t : plan.stream.time_s) t = std::floor(t / 0.05) * 0.05;
  const auto passes = find_passes(plan.stream);
  ASSERT_EQ(passes.size(), 1U);
  EXPECT_NEAR(passes[0].speed_rad_per_s, two_pi / 0.1, two_pi / 0.1 * 0.05 / 1.95);
}

TEST(Passes, SectionsBetweenPositioningMoves) {
  Plan plan(false);
  for (int section = 0; section < 5; ++section) plan.move(12, 1.0 / 12, 0.0).jump(0, 34.0);
  EXPECT_EQ(shape(find_passes(plan.stream)),
            "0-12 C+ Z0\n12-24 C+ Z0\n24-36 C+ Z0\n36-48 C+ Z0\n48-60 C+ Z0\n");
}

TEST(Passes, SectionsOfThreeReadingsAndBackwards) {
  Plan plan(false);
  for (int section = 0; section < 3; ++section) plan.move(3, 1.0 / 3, 0.0).jump(0, -10.0);
  EXPECT_EQ(shape(find_passes(plan.stream)), "0-3 C+ Z0\n3-6 C+ Z0\n6-9 C+ Z0\n");
}

TEST(Passes, SectionsProbedToAndFro) {
  Plan plan(false);
  plan.move(11, 1.0 / 12, 0).move(1, 0, 20).move(11, -1.0 / 12, 0).move(1, 0, 20);
  plan.move(12, 1.0 / 12, 0);
  EXPECT_EQ(shape(find_passes(plan.stream)), "0-12 C+ Z0\n12-24 C- Z0\n24-36 C+ Z0\n");
}

TEST(Passes, UnwoundBetweenSections) {
  Plan plan(false);
  for (int section = 0; section < 3; ++section) plan.move(12, 1.0 / 12, 0).jump(-1.0, 20);
  EXPECT_EQ(shape(find_passes(plan.stream)), "0-12 C+ Z0\n12-24 C+ Z0\n24-36 C+ Z0\n");
}

TEST(Passes, OutDwellBack) {
  const Plan plan =
      Plan().move(360, 1.0 / 36, 0.2 / 36).move(180, 1.0 / 36, 0).move(361, 1.0 / 36, -0.2 / 36);
  const auto passes = find_passes(plan.stream);
  ASSERT_EQ(senses(passes), "C+Z+ C+Z0 C+Z- ");
  // A rest may reach one least step into the feed.
  EXPECT_NEAR(static_cast<double>(passes[0].end), 361.0, 1.0);
  EXPECT_NEAR(static_cast<double>(passes[1].end), 541.0, 1.0);
  EXPECT_EQ(passes[1].feed_mm_per_rev, 0.0);
}

TEST(Passes, OutAndBackOnReversedSpindle) {
  const Plan plan = Plan().move(360, 1.0 / 36, 0.2 / 36).move(361, -1.0 / 36, -0.2 / 36);
  EXPECT_EQ(shape(find_passes(plan.stream)), "0-361 C+ Z+\n361-721 C- Z-\n");
}

TEST(Passes, ReversedAfterAPauseAtOnePlace) {
  // The last reading of a pass and the first of the next are at one C and Z, half a second apart.
  for (const bool with_time : {true, false}) {
    const Plan plan = Plan(with_time)
                          .move(360, 1.0 / 36, 0.2 / 36)
                          .jump(-1.0 / 36, -0.2 / 36)
                          .move(360, -1.0 / 36, -0.2 / 36);
    const auto passes = find_passes(plan.stream);
    EXPECT_EQ(shape(passes), "0-360 C+ Z+\n360-720 C- Z-\n");
    if (!with_time) continue;
    for (const Pass& pass : passes)  // rounding of 360 steps
      EXPECT_NEAR(std::abs(pass.speed_rad_per_s), two_pi / 36 / 0.01, 1e-9);
  }
}

// The probe waited while the spindle changed its speed and turned on. The first reading back may be
// at the Z of the last one, or a step further on: it belongs to the second speed, which a delay of
// X is corrected with.
TEST(Passes, TheFirstReadingAfterAWaitBeginsTheNext) {
  for (const double turns : {0.3, 5.6})
    for (const double back_mm : {0.0, -0.04}) {
      const Plan plan = Plan()
                            .move(400, 1.0 / 50, 0.04, 0.01)
                            .jump(turns, back_mm, 3.0)
                            .move(400, 1.0 / 50, -0.04, 0.004);
      EXPECT_EQ(shape(find_passes(plan.stream)), "0-400 C+ Z+\n400-800 C+ Z-\n")
          << turns << " " << back_mm;
    }
}

TEST(Passes, StationaryCaptureIsAPassOfItsOwn) {
  const Plan plan = Plan().move(360, 1.0 / 36, 0.2 / 36).move(500, 0, 0);
  const auto passes = find_passes(plan.stream);
  ASSERT_EQ(shape(passes), "0-361 C+ Z+\n361-860 C0 Z0\n");
  EXPECT_EQ(passes[1].readings_per_revolution, 0.0);
  EXPECT_EQ(passes[1].speed_rad_per_s, 0.0);
}

TEST(Passes, GeneratricesOneAtATime) {
  Plan plan(false);
  for (int line = 0; line < 4; ++line) plan.move(10, 0, 5.0).jump(0.25, -50.0);
  EXPECT_EQ(shape(find_passes(plan.stream)), "0-10 C0 Z+\n10-20 C0 Z+\n20-30 C0 Z+\n30-40 C0 Z+\n");
}

TEST(Passes, NoiseInRecordedAxesDoesNotFragment) {
  for (const unsigned seed : {1u, 2u, 3u, 4u, 5u}) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    // 2 µm noise on steps of 0.5 µm; C noise a fifth of the step; time jitter a third of a step.
    Plan plan = Plan().move(20000, 1.0 / 400, 0.2 / 400, 0.01).move(4000, 1.0 / 400, 0, 0.01);
    plan.move(20000, 1.0 / 400, -0.2 / 400, 0.01).move(3000, 0, 0, 0.01);
    plan.noise(seed, 0.2 * two_pi / 400, 2e-3, 3e-3);
    const auto passes = find_passes(plan.stream);
    expect_cover(plan.stream, passes);
    ASSERT_EQ(passes.size(), 4u) << shape(passes);
    const int c[] = {1, 1, 1, 0}, z[] = {1, 0, -1, 0};
    const std::size_t ends[] = {20000, 24000, 44000, 47000};
    for (std::size_t k = 0; k < 4; ++k) {
      EXPECT_EQ(passes[k].c_sign, c[k]) << k;
      EXPECT_EQ(passes[k].feed_sign, z[k]) << k;
      // 10 sigma (20 µm) of a feed of 0.5 µm a reading: 40 readings.
      EXPECT_NEAR(static_cast<double>(passes[k].end), static_cast<double>(ends[k]), 45.0) << k;
    }
    // Slope of 20000 readings, u = 2 µm sqrt(12 / 20000) / 50 rev = 1e-6; cut 45 readings off:
    // less.
    EXPECT_NEAR(passes[0].feed_mm_per_rev, 0.2, 1e-4);
  }
}

TEST(Passes, CoarseResolutionDoesNotFragment) {
  Plan plan = Plan(false).move(3600, 1.0 / 360, 0.03 / 360).move(720, 1.0 / 360, 0);
  for (double& z : plan.stream.position_mm) z = 0.01 * std::round(z / 0.01);
  const auto passes = find_passes(plan.stream);
  ASSERT_EQ(passes.size(), 2u) << shape(passes);
  EXPECT_EQ(passes[0].feed_sign, 1);
  EXPECT_EQ(passes[1].feed_sign, 0);
}

TEST(Passes, AGapInTheReadingsIsNoNewPass) {
  const Plan plan = Plan()
                        .move(360, 1.0 / 36, 0.2 / 36, 1.0 / 36)
                        .jump(5, 1.0, 5.0)
                        .move(360, 1.0 / 36, 0.2 / 36, 1.0 / 36);
  EXPECT_EQ(shape(find_passes(plan.stream)), "0-720 C+ Z+\n");
}

TEST(Passes, ASecondSpeedIsASecondPass) {
  // 60 rpm, then 151 rpm in mid-revolution, sampled at 100 Hz.
  const Plan plan = Plan().move(1050, 0.01, 0.002, 0.01).move(1000, 0.01 * 151 / 60, 0.002, 0.01);
  const auto passes = find_passes(plan.stream);
  ASSERT_EQ(senses(passes), "C+Z+ C+Z+ ");
  // Reading 1050 lies where the two lines meet: it may be in either pass.
  EXPECT_NEAR(static_cast<double>(passes[0].end), 1050.5, 0.5);
  EXPECT_NEAR(passes[0].speed_rad_per_s, two_pi, 1e-9);
  EXPECT_NEAR(passes[1].speed_rad_per_s, two_pi * 151 / 60, 1e-9);
}

TEST(Passes, OnePerCentDecidesOnSpeed) {
  const auto count = [](double ratio) {
    return find_passes(
               Plan().move(1000, 0.01, 0.002, 0.01).move(1000, 0.01 * ratio, 0.002, 0.01).stream)
        .size();
  };
  EXPECT_EQ(count(1.008), 1u);
  EXPECT_EQ(count(1.012), 2u);
  EXPECT_EQ(count(0.988), 2u);
}

TEST(Passes, TimeJitterAndStopAndGoAreNoSpeedChange) {
  Plan jitter = Plan().move(3000, 0.02, 0.004, 0.01).noise(7, 0, 0, 9e-3);
  EXPECT_EQ(find_passes(jitter.stream).size(), 1u);
  // A touch probe: times from point to point vary by half, so revolutions by far more than 1 %.
  Plan touch = Plan().move(120, 1.0 / 12, 0.02, 2.0);
  std::mt19937 random(11);
  std::uniform_real_distribution<double> part(0.5, 1.0);
  double t = 0.0;
  for (double& time : touch.stream.time_s) time = (t += 2.0 * part(random));
  EXPECT_EQ(find_passes(touch.stream).size(), 1u);
}

TEST(Passes, SetupsAndPassColumnCut) {
  Plan plan(false);
  plan.move(72, 1.0 / 36, 0.2 / 36);
  plan.stream.setup.assign(72, 1);
  for (std::size_t i = 40; i < 72; ++i) plan.stream.setup[i] = 2;
  auto passes = find_passes(plan.stream);
  ASSERT_EQ(shape(passes), "0-40 C+ Z+\n40-72 C+ Z+\n");
  EXPECT_EQ(passes[1].setup, 2);
  plan.stream.pass.assign(72, 7);
  for (std::size_t i = 60; i < 72; ++i) plan.stream.pass[i] = 3;
  passes = find_passes(plan.stream);
  EXPECT_EQ(shape(passes), "0-40 C+ Z+\n40-60 C+ Z+\n60-72 C+ Z+\n");
}

TEST(Passes, SmallStreams) {
  EXPECT_TRUE(find_passes({}).empty());
  EXPECT_EQ(shape(find_passes(Plan(false).move(1, 0.1, 0).stream)), "0-1 C0 Z0\n");
  EXPECT_EQ(shape(find_passes(Plan(false).move(2, 0.1, 1).stream)), "0-2 C+ Z+\n");
  ProbeStream section = Plan(false).move(100, 0.01, 0).stream;
  section.position_mm.clear();
  EXPECT_EQ(shape(find_passes(section)), "0-100 C+ Z0\n");
  section.c_rad.pop_back();
  EXPECT_THROW(find_passes(section), ContractViolation);
}

TEST(Passes, RandomPlansAreCoveredAndReproduced) {
  const unsigned seed = 20240;
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937 random(seed);
  const auto pick = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  for (int trial = 0; trial < 200; ++trial) {
    Plan plan(false);
    const double per_rev = std::floor(pick(5, 100));
    std::string wanted;
    int c = 1, z = 1, previous = 99;
    const int moves = 1 + trial % 5;
    for (int move = 0; move < moves; ++move) {
      do {
        c = pick(0, 1) < 0.5 ? -1 : 1;
        z = static_cast<int>(std::floor(pick(0, 3))) - 1;
      } while (10 * c + z == previous);
      previous = 10 * c + z;
      const auto count = static_cast<std::size_t>(per_rev * pick(2.5, 6)) + 40;
      plan.move(count, c / per_rev, z * pick(0.1, 2.0) / per_rev);
      wanted += std::string("C") + sense(c) + "Z" + sense(z) + " ";
    }
    // Every other one with 1 µm in Z and 5 % of a step in C.
    if (trial % 2 == 1) plan.noise(static_cast<unsigned>(trial), 0.05 * two_pi / per_rev, 1e-3);
    const auto passes = find_passes(plan.stream);
    expect_cover(plan.stream, passes);
    EXPECT_EQ(senses(passes), wanted) << "trial " << trial;
  }
}

}  // namespace
}  // namespace trueaxis

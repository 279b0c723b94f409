// SPDX-License-Identifier: Apache-2.0
#include "live/live_stream.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "fit/moved.hpp"
#include "live/live_state.hpp"
#include "trueaxis/fit.hpp"
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

/// Out and back along a shaft that turns askew, with three lobes and noise of 1 µm; in pieces.
class LongStream {
 public:
  explicit LongStream(double lobes_mm = 0.0) : lobes_mm_(lobes_mm) {}

  static constexpr double sigma_mm = 1e-3, x_mm = 0.05, y_mm = -0.03, dx_dz = 1e-4, dy_dz = -2e-4;

  ProbeStream next(std::size_t count, double slipped_mm = 0.0) {
    ProbeStream stream;
    for (std::size_t end = at_ + count; at_ < end; ++at_) {
      const double turns = static_cast<double>(at_) / 97.3, c = two_pi * turns;
      const double z = 20.0 * (1.0 - std::abs(std::fmod(turns / 60.0, 2.0) - 1.0));
      stream.c_rad.push_back(c);
      stream.position_mm.push_back(z);
      const double x = x_mm + slipped_mm + dx_dz * z, y = y_mm + dy_dz * z;
      stream.reading_mm.push_back(
          x * std::cos(c) + y * std::sin(c) +
          std::sqrt(900.0 - std::pow(y * std::cos(c) - x * std::sin(c), 2)) +
          lobes_mm_ * std::cos(3.0 * c) + noise_(random_));
    }
    return stream;
  }

 private:
  double lobes_mm_;
  std::size_t at_ = 0;
  std::mt19937_64 random_{20261128};
  std::normal_distribution<double> noise_{0.0, sigma_mm};
};

FitOptions of_a_cylinder() {
  FitOptions options;
  options.surface = SurfaceKind::cylinder;
  return options;
}

double off_mm(const FitResult& fit, double z_mm) {
  using S = LongStream;
  const auto [x, y] = fit.axis.axis.at(z_mm);
  return std::hypot(x - S::x_mm - S::dx_dz * z_mm, y - S::y_mm - S::dy_dz * z_mm);
}

constexpr std::size_t most = 20000, all = 4000000;
/// U (k = 2) of the axis at an end by all readings: with Z evenly over the length its variance is
/// four times that in the middle, 2σ²/N (Cramér-Rao).
const double bound_mm = 2.0 * LongStream::sigma_mm * std::sqrt(8.0 / static_cast<double>(all));

FitResult of_means(double lobes_mm) {
  LongStream part(lobes_mm);
  LiveStream live(most);
  for (std::size_t done = 0; done < all; done += 10000) {
    live.add(part.next(10000));
    if (live.stride() == 1)
      live.average_about(ideal_reading(fit(live.sample(10000), of_a_cylinder())));
    EXPECT_LE(live.size() + live.open(), 2 * most);
  }
  EXPECT_TRUE(live.averages());
  EXPECT_GE(live.stride(), 256u);
  return fit(live.kept(), of_a_cylinder());
}

// Four million readings in the memory of 20 000, a stride of 256 or more. Leaving them out makes U
// sixteen times the bound. A tenth may be lost: the readings of no mean yet are fewer than a
// cell's.
TEST(LiveStream, MeansOfNeighboursHoldTheInformationOfAll) {
  const FitResult found = of_means(0.0);
  ASSERT_TRUE(found.axis_known());
  EXPECT_LE(U_of_axis_mm(found), 1.1 * bound_mm);
  for (const double z : {0.0, 20.0}) EXPECT_LE(off_mm(found, z), 2.0 * bound_mm);  // four sigma
}

// Form varies within a cell. 20000/14 cells in 14 sectors for each band make 141 sectors. There 2
// µm of three lobes move by 6 µm/rad · 2π/141 / √12 = 0.08 µm: more noise to a mean than its 1/16
// µm.
TEST(LiveStream, MeansOfAFormAreOfTheSameAxis) {
  const FitResult found = of_means(2e-3);
  ASSERT_TRUE(found.axis_known());
  const double wider = std::hypot(1.0, 6e-3 * two_pi / 141.0 / std::sqrt(12.0) * 16.0 / 1e-3);
  for (const double z : {0.0, 20.0})
    EXPECT_LE(off_mm(found, z), 2.0 * wider * bound_mm);  // four sigma
}

// In means of hours a slip is seen late and a dead probe never: the latest readings show both.
TEST(LiveStream, AlarmsAreAtOnceHoweverMuchIsThinned) {
  LongStream part;
  LiveStream live(20000);
  live.add(part.next(10000));
  live.average_about(ideal_reading(fit(live.kept(), of_a_cylinder())));
  for (int k = 0; k < 100; ++k) live.add(part.next(10000));
  ASSERT_GE(live.stride(), 64u);
  const LiveState before = live_state(live, of_a_cylinder(), {});
  EXPECT_FALSE(before.moved);
  EXPECT_FALSE(before.deaf);
  live.add(part.next(973, 0.02));  // ten revolutions
  const LiveState slipped = live_state(live, of_a_cylinder(), before.fit);
  ASSERT_TRUE(slipped.moved);
  ProbeStream deaf = part.next(97);
  for (double& x : deaf.reading_mm) x = deaf.reading_mm.front();
  live.add(deaf);
  EXPECT_TRUE(live_state(live, of_a_cylinder(), before.fit).deaf);
}

}  // namespace
}  // namespace trueaxis

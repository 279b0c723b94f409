// SPDX-License-Identifier: Apache-2.0
// Residuals that no part and probe leave, at the numbers from which each is refused (theory.md,
// Eqs. 306 to 308). The residuals are given; no surface is fitted.
#include "fit/plausible.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <random>

#include "trueaxis/units.hpp"

namespace trueaxis::plausible_test {
namespace {

constexpr double root2 = 1.4142135623730951;

/// A round part of 20 mm off the axis, in steps of `step_deg`, along 40 mm; read from a file.
ProbeStream part(std::size_t count = 720, double step_deg = 9.73) {
  ProbeStream stream;
  stream.x_convention = XConvention{.said_by = SaidBy::stream};
  stream.source = "part.csv";
  for (std::size_t i = 0; i < count; ++i) {
    const double c = step_deg * rad_per_deg * static_cast<double>(i);
    stream.c_rad.push_back(c);
    stream.position_mm.push_back(40.0 * static_cast<double>(i) / static_cast<double>(count));
    stream.reading_mm.push_back(intersect({{0.3, 0.1, 0.0, 0.0, 0.0}, 19.7, 0.0}, c, 0.0).x_mm);
  }
  return stream;
}

/// A fit of which these residuals are left.
FitResult leaving(const std::vector<double>& residual_mm) {
  FitResult fit;
  fit.status = FitStatus::converged;
  fit.surface = SurfaceKind::cylinder;
  fit.points = residual_mm.size();
  fit.residual_mm = residual_mm;
  double squares = 0.0;
  for (const double r : residual_mm) squares += r * r;
  fit.rms_mm = std::sqrt(squares / static_cast<double>(residual_mm.size()));
  return fit;
}

/// Why the fit is refused, if another surface or way to read the stream leaves `other_mm`.
std::string why(const ProbeStream& stream, const FitResult& fit, double other_mm = 1e9) {
  return implausible(stream, fit, [&](const ProbeStream& right, SurfaceKind surface) {
    FitResult again;
    again.surface = surface;
    again.status =
        right.reading_mm == stream.reading_mm && right.c_rad == stream.c_rad && other_mm < 1e9
            ? FitStatus::converged
            : FitStatus::max_iterations;
    again.points = right.size(), again.rms_mm = other_mm;
    again.parameters = {{"radius", {25.0, 0.01, "mm", ""}}};
    return again;
  });
}

std::vector<double> made(std::size_t count, const std::function<double(std::size_t)>& of) {
  std::vector<double> out;
  for (std::size_t i = 0; i < count; ++i) out.push_back(of(i));
  return out;
}

/// Two slow waves along the stream with this RMS, and noise with that.
std::vector<double> slow_and_noise(double slow_mm, double noise_mm, std::size_t count = 720) {
  std::mt19937_64 random(47);
  std::normal_distribution<double> normal;
  return made(count, [&](std::size_t i) {
    return root2 * slow_mm * std::cos(0.02 * static_cast<double>(i)) + noise_mm * normal(random);
  });
}

bool says(const std::string& text, const char* part) {
  return text.find(part) != std::string::npos;
}

// 0.5 mm and a thousandth of the radius, which of a face is its largest X and of a gauge nominal;
// three times the noise that is stated. 2 % of either side.
TEST(FitPlausible, ResidualsBeyondAnyFormAreNotThoseOfAPart) {
  const auto refused = [](const ProbeStream& stream, double limit_mm) {
    const std::string less = why(stream, leaving(slow_and_noise(0.98 * limit_mm, 0.0)));
    const std::string more = why(stream, leaving(slow_and_noise(1.02 * limit_mm, 0.0)));
    return less.empty() && says(more, "No turned part and probe leave more than");
  };
  ProbeStream stream = part();
  EXPECT_TRUE(refused(stream, 0.52));
  stream.sensor_noise_mm = 0.3;
  EXPECT_TRUE(refused(stream, 0.9));
  stream.sensor_noise_mm.reset();
  stream.indication = Indication::relative;
  stream.nominal_radius_mm = 150.0;
  EXPECT_TRUE(refused(stream, 0.65));
  stream = part();
  stream.kind = StreamKind::face;
  EXPECT_TRUE(refused(stream, 0.54));
  // A keyway leaves much, and little of most readings.
  FitResult keyway = leaving(made(720, [](std::size_t i) { return i % 40 < 3 ? -3.0 : 1e-3; }));
  ASSERT_GT(keyway.rms_mm, 0.6);
  EXPECT_EQ(why(part(), keyway), "");
}

TEST(FitPlausible, AConeThatLeavesAThirdIsWhatItIs) {
  const FitResult fit = leaving(slow_and_noise(0.6, 0.0));
  EXPECT_TRUE(says(why(part(), fit, 0.195), "A cone leaves 195 µm: use --surface cone"));
  EXPECT_TRUE(says(why(part(), fit, 0.205), "Check that columns, units and surface are right"));
}

// 0.1 mm from reading to reading, within 10°, or three times what is stated, and 0.7 of all that is
// left. The scatter of 720 readings is known to 3 %.
TEST(FitPlausible, ReadingsThatScatterAreNotThoseOfAProbe) {
  const auto scatters = [](double slow_mm, double noise_mm, double step_deg = 9.73,
                           double stated_mm = 0.0) {
    ProbeStream stream = part(720, step_deg);
    if (stated_mm > 0.0) stream.sensor_noise_mm = stated_mm;
    return says(why(stream, leaving(slow_and_noise(slow_mm, noise_mm))), "single readings scatter");
  };
  EXPECT_TRUE(scatters(0.0, 0.11));
  EXPECT_FALSE(scatters(0.05, 0.09));
  EXPECT_TRUE(scatters(0.0, 0.16, 9.73, 0.05));
  EXPECT_FALSE(scatters(0.0, 0.14, 9.73, 0.05));
  EXPECT_TRUE(scatters(0.15, 0.2)) << "0.8";
  EXPECT_FALSE(scatters(0.25, 0.2)) << "0.62";
  EXPECT_FALSE(scatters(0.0, 0.3, 10.27)) << "neighbours do not meet the same form";
  // The second of three rows has both its neighbours near; of two in a place none has.
  for (const std::size_t in_place : {2U, 3U}) {
    ProbeStream stream = part();
    for (std::size_t i = 0; i < stream.size(); ++i)
      stream.c_rad[i] += 37.0 * rad_per_deg * static_cast<double>(i / in_place);
    EXPECT_EQ(says(why(stream, leaving(slow_and_noise(0.0, 0.11))), "single readings scatter"),
              in_place == 3U);
  }
}

// Every second reading off: a fifth of the squares of the residuals, six standard deviations, 5 µm.
TEST(FitPlausible, RowsThatAlternateAreOfTwoStreams) {
  const auto alternates = [](std::size_t count, double share, double rms_mm,
                             double step_deg = 9.73) {
    const double half_mm = rms_mm * std::sqrt(share), rest_mm = rms_mm * std::sqrt(1.0 - share);
    std::vector<double> left = slow_and_noise(rest_mm, 0.0, count);
    for (std::size_t i = 0; i < count; ++i) left[i] += i % 2 == 0 ? half_mm : -half_mm;
    const std::string found = why(part(count, step_deg), leaving(left));
    double differ_um = 0.0;
    if (std::sscanf(found.c_str(), "odd and even rows of part.csv differ by %lf", &differ_um) != 1)
      return false;
    EXPECT_NEAR(differ_um, 2e3 * half_mm, 0.02 * 2e3 * half_mm);
    return true;
  };
  EXPECT_TRUE(alternates(720, 0.22, 0.02));
  EXPECT_FALSE(alternates(720, 0.18, 0.02));
  EXPECT_TRUE(alternates(720, 0.5, 0.0055));
  EXPECT_FALSE(alternates(720, 0.5, 0.0045));
  EXPECT_TRUE(alternates(60, 0.7, 0.02)) << "42 of 36";
  EXPECT_FALSE(alternates(60, 0.5, 0.02)) << "30 of 36";
  EXPECT_FALSE(alternates(34, 1.0, 0.02)) << "34 of 36";
  EXPECT_FALSE(alternates(720, 0.5, 0.02, 7.5)) << "24 lobes, two readings each";
  EXPECT_TRUE(alternates(720, 0.5, 0.02, 360.0 / 47.0)) << "23.5 lobes";
}

// A sphere that leaves a tenth of more than 10 µm; not of a gauge, nor of several set-ups.
TEST(FitPlausible, ABallHasNoAxis) {
  double cone_mm = 0.2;
  const auto is_ball = [&](double left_mm, double sphere_mm, auto change) {
    ProbeStream stream = part();
    FitResult fit = leaving(slow_and_noise(left_mm, 0.0));
    change(stream, fit);
    const auto refit = [&](const ProbeStream&, SurfaceKind surface) {
      FitResult again;
      again.surface = surface, again.status = FitStatus::converged;
      again.rms_mm = surface == SurfaceKind::sphere ? sphere_mm : cone_mm;
      again.parameters = {{"radius", {25.0, 0.01, "mm", ""}}};
      return again;
    };
    return says(implausible(stream, fit, refit),
                "the readings are those of a sphere of radius 25 mm");
  };
  const auto as_it_is = [](ProbeStream&, FitResult&) {};
  EXPECT_TRUE(is_ball(0.011, 0.00105, as_it_is));
  EXPECT_FALSE(is_ball(0.011, 0.00115, as_it_is));
  // Two sections are as well on a cone as on a sphere.
  cone_mm = 0.001;
  EXPECT_FALSE(is_ball(0.1, 0.001, as_it_is));
  cone_mm = 0.2;
  EXPECT_FALSE(is_ball(0.009, 1e-5, as_it_is));
  EXPECT_TRUE(
      is_ball(0.1, 0.001, [](ProbeStream&, FitResult& fit) { fit.surface = SurfaceKind::cone; }));
  EXPECT_FALSE(
      is_ball(0.1, 0.001, [](ProbeStream&, FitResult& fit) { fit.surface = SurfaceKind::torus; }));
  EXPECT_FALSE(is_ball(0.1, 0.001, [](ProbeStream& stream, FitResult&) {
    stream.indication = Indication::relative;
  }));
  EXPECT_FALSE(is_ball(0.1, 0.001, [](ProbeStream& stream, FitResult&) {
    stream.setup.assign(stream.size(), 1), stream.setup.back() = 2;
    stream.setups.push_back({.number = 2});
  }));
}

// The kurtosis of a sine is 1.5, that of a uniform distribution 1.8 and that of noise 3.
TEST(FitPlausible, AShuffledWaveIsNoNoise) {
  const auto unlike = [](std::vector<double> left, bool shuffled) {
    std::mt19937_64 random(48);
    if (shuffled) std::ranges::shuffle(left, random);
    return says(why(part(left.size()), leaving(left)), "have the distribution of a sine");
  };
  const auto wave = [](std::size_t count) {
    return made(count,
                [](std::size_t i) { return 0.02 * std::cos(0.37 * static_cast<double>(i)); });
  };
  EXPECT_TRUE(unlike(wave(720), true));
  EXPECT_FALSE(unlike(wave(720), false)) << "it is ordered in time";
  // Neighbours correlate by cos 0.37 of the part that is ordered, to 1/√720; the limit is 4/√720.
  const auto partly = [&](std::ptrdiff_t ordered) {
    std::vector<double> left = wave(720);
    std::mt19937_64 random(49);
    std::shuffle(left.begin() + ordered, left.end(), random);
    return unlike(left, false);
  };
  EXPECT_TRUE(partly(30)) << "1/√720";
  EXPECT_FALSE(partly(173)) << "6/√720";
  const auto steps = [](std::size_t count) {
    return made(count, [&](std::size_t i) { return 2 * i < count ? 0.02 : -0.02; });
  };
  EXPECT_TRUE(unlike(steps(104), true));
  EXPECT_FALSE(unlike(steps(96), true)) << "too few to tell";
  EXPECT_FALSE(
      unlike(made(720, [](std::size_t i) { return 1e-5 * static_cast<double>(i); }), true));
  EXPECT_FALSE(unlike(slow_and_noise(0.0, 0.02), true));
  // Ordered in angle: lobes.
  std::vector<double> lobes;
  for (const double c : part().c_rad) lobes.push_back(0.02 * std::cos(2.0 * c));
  EXPECT_FALSE(unlike(lobes, false));
}

}  // namespace
}  // namespace trueaxis::plausible_test

// SPDX-License-Identifier: Apache-2.0
// Law: the vectorised sine and cosine keep their bound on every instruction set.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include "laws/targets.hpp"
#include "math/sincos.hpp"

namespace trueaxis::laws {
namespace {

constexpr double ulp_of_one = std::numeric_limits<double>::epsilon();

struct Worst {
  double error = 0.0, angle = 0.0;
};

/// Largest error against long double (64 bits of mantissa), in units of `ulp_of_one`.
Worst worst_of(const std::vector<double>& angle) {
  std::vector<double> sine(angle.size()), cosine(angle.size());
  sincos(angle, sine, cosine);
  Worst worst;
  for (std::size_t i = 0; i < angle.size(); ++i) {
    const long double x = angle[i];
    const double error =
        static_cast<double>(std::max(std::abs(static_cast<long double>(sine[i]) - std::sin(x)),
                                     std::abs(static_cast<long double>(cosine[i]) - std::cos(x))) /
                            ulp_of_one);
    if (!(error <= worst.error)) worst = {error, angle[i]};
  }
  return worst;
}

TEST(SincosLaw, WithinOneUlpOfOneBelowAMillionRadians) {
  constexpr unsigned seed = 31;
  std::mt19937_64 random(seed);
  for_every_target([&](const char* target) {
    for (const double reach : {1e-9, 1e-3, 1.0, 7.0, 1e3, 1e5, 1e6}) {
      std::uniform_real_distribution<double> uniform(-reach, reach);
      std::vector<double> angle(20000);
      for (double& a : angle) a = uniform(random);
      const Worst worst = worst_of(angle);
      EXPECT_LE(worst.error, 1.0) << target << " seed " << seed << " angle " << worst.angle;
    }
  });
}

TEST(SincosLaw, NextToMultiplesOfAQuarterTurn) {
  std::vector<double> angle;
  for (const double n : {0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 355.0, 710.0, 1e4, 123457.0, 636619.0}) {
    for (const double part : {0.5, 1.0}) {  // of a quarter turn: where the reduction changes over
      const double middle = n * part * std::numbers::pi / 2.0;
      for (const double x : {middle, std::nextafter(middle, 1e9), std::nextafter(middle, -1e9)}) {
        angle.push_back(x);
        angle.push_back(-x);
      }
    }
  }
  for_every_target([&](const char* target) {
    const Worst worst = worst_of(angle);
    EXPECT_LE(worst.error, 1.0) << target << " angle " << worst.angle;
  });
}

TEST(SincosLaw, BeyondAMillionTheErrorIsThatOfTheAnglesLastBit) {
  constexpr unsigned seed = 32;
  std::mt19937_64 random(seed);
  for_every_target([&](const char* target) {
    for (const double reach : {1e7, 1e9, 1e11}) {
      std::uniform_real_distribution<double> uniform(-reach, reach);
      std::vector<double> angle(5000);
      for (double& a : angle) a = uniform(random);
      const Worst worst = worst_of(angle);
      EXPECT_LE(worst.error, 1.0 + reach) << target << " seed " << seed << " angle " << worst.angle;
    }
  });
}

TEST(SincosLaw, ExactAtZeroAndOddAndEven) {
  for_every_target([](const char* target) {
    std::vector<double> angle{0.0, -0.0}, sine(2), cosine(2);
    sincos(angle, sine, cosine);
    EXPECT_EQ(sine, (std::vector<double>{0.0, 0.0})) << target;
    EXPECT_EQ(cosine, (std::vector<double>{1.0, 1.0})) << target;
    std::vector<double> plus, minus;
    for (int i = 1; i < 1000; ++i) plus.push_back(0.37 * i), minus.push_back(-0.37 * i);
    std::vector<double> s(plus.size()), c(plus.size()), s2(plus.size()), c2(plus.size());
    sincos(plus, s, c);
    sincos(minus, s2, c2);
    for (std::size_t i = 0; i < s.size(); ++i) {
      EXPECT_EQ(s[i], -s2[i]) << target;
      EXPECT_EQ(c[i], c2[i]) << target;
    }
  });
}

TEST(SincosLaw, EveryLengthOfColumnGivesTheSameBits) {
  for_every_target([](const char* target) {
    for (std::size_t n = 0; n < 40; ++n) {
      std::vector<double> angle(n), sine(n), cosine(n);
      for (std::size_t i = 0; i < n; ++i) angle[i] = 0.7 * static_cast<double>(i) - 9.0;
      sincos(angle, sine, cosine);
      for (std::size_t i = 0; i < n; ++i) {
        double s = 0.0, c = 0.0;
        sincos({&angle[i], 1}, {&s, 1}, {&c, 1});
        EXPECT_EQ(sine[i], s) << target << ' ' << n << ' ' << i;
        EXPECT_EQ(cosine[i], c) << target << ' ' << n << ' ' << i;
      }
    }
  });
}

}  // namespace
}  // namespace trueaxis::laws

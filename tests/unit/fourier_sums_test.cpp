// SPDX-License-Identifier: Apache-2.0
// Fast Fourier sums against the sums as they are written, in extended precision.
#include "math/fourier_sums.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "laws/targets.hpp"
#include "trueaxis/error.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

constexpr double stated_error = 1e-9;  // of Σ|w|, as the header says

struct Problem {
  std::vector<double> t, w;
  double w0 = 0.0, dw = 1.0;
  std::size_t orders = 1;
};

std::complex<double> direct(const Problem& of, std::size_t k) {
  long double real = 0.0L, imaginary = 0.0L;
  const long double frequency = of.w0 + static_cast<long double>(k) * of.dw;
  for (std::size_t i = 0; i < of.t.size(); ++i) {
    const long double angle = frequency * of.t[i];
    real += of.w[i] * std::cos(angle), imaginary -= of.w[i] * std::sin(angle);
  }
  return {static_cast<double>(real), static_cast<double>(imaginary)};
}

/// Largest error over the orders, every `stride`-th of them and the last, in units of Σ|w|.
double worst_error(const Problem& of, std::size_t stride = 1) {
  const auto sums = FourierSums(of.t, of.w0, of.dw, of.orders).of(of.w);
  EXPECT_EQ(sums.size(), of.orders);
  double size = 0.0, worst = 0.0;
  for (const double w : of.w) size += std::abs(w);
  const auto look = [&](std::size_t k) {
    const double error = std::abs(sums[k] - direct(of, k));
    worst = error <= worst ? worst : error;  // keeps a NaN
  };
  for (std::size_t k = 0; k < of.orders; k += stride) look(k);
  look(of.orders - 1);
  return worst / size;
}

Problem random_problem(std::size_t readings, std::size_t orders, unsigned seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  std::normal_distribution<double> normal;
  Problem of;
  of.orders = orders;
  of.w0 = 3.0 * uniform(random);
  of.dw = 0.05 * uniform(random);
  for (std::size_t i = 0; i < readings; ++i) {
    of.t.push_back(100.0 * uniform(random));
    of.w.push_back(normal(random));
  }
  return of;
}

TEST(FourierSums, RandomAbscissaeOfManySizes) {
  laws::for_every_target([](const char* target) {
    unsigned seed = 51;
    for (const std::size_t readings : {1u, 2u, 9u, 300u}) {
      for (const std::size_t orders : {1u, 2u, 3u, 12u, 13u, 499u, 1000u}) {
        const Problem of = random_problem(readings, orders, ++seed);
        EXPECT_LE(worst_error(of), stated_error)
            << target << ": " << readings << " readings, " << orders << " orders, seed " << seed;
      }
    }
  });
}

// The equal signs of the values are the worst case: nothing cancels at a line.
TEST(FourierSums, EveryPlaceBetweenTwoGridPoints) {
  Problem of;
  of.orders = 200;
  of.dw = two_pi / 100.0;
  of.w = {1.0};
  for (int step = 0; step <= 1000; ++step) {
    of.t = {-50.0 + 0.1 * step};
    EXPECT_LE(worst_error(of, 7), stated_error) << "t " << of.t[0];
  }
}

TEST(FourierSums, FarFromTheOriginOfT) {
  constexpr unsigned seed = 81;
  for (const double offset : {-1e5, 1e3, 1e5}) {
    Problem of = random_problem(400, 400, seed);
    for (double& t : of.t) t += offset;
    of.w0 = 900.0;  // phases up to 1e8 rad
    EXPECT_LE(worst_error(of), stated_error) << "offset " << offset << ", seed " << seed;
  }
}

TEST(FourierSums, UniformAbscissaeAreADiscreteTransform) {
  Problem of;
  of.orders = 64;
  of.dw = two_pi / 64.0;
  for (int i = 0; i < 64; ++i) {
    of.t.push_back(i);
    of.w.push_back(std::cos(of.dw * 5.0 * i));
  }
  const auto sums = FourierSums(of.t, of.w0, of.dw, of.orders).of(of.w);
  for (std::size_t k = 0; k < of.orders; ++k) {
    const double expected = k == 5 || k == 59 ? 32.0 : 0.0;
    EXPECT_LE(std::abs(sums[k] - expected), stated_error * 64.0) << k;
  }
}

TEST(FourierSums, ManyOrdersAndReadings) {
  constexpr unsigned seed = 91;
  Problem of = random_problem(20000, 60000, seed);
  of.dw = 6e-4;
  EXPECT_LE(worst_error(of, 1999), stated_error) << "seed " << seed;
  std::sort(of.t.begin(), of.t.end());
  of.dw = 0.4;  // many turns of the grid
  EXPECT_LE(worst_error(of, 1999), stated_error) << "seed " << seed;
}

TEST(FourierSums, NoReadingsAndNoStep) {
  const auto nothing = FourierSums({}, 1.0, 1.0, 5).of(std::span<const double>());
  EXPECT_EQ(nothing, std::vector<std::complex<double>>(5));
  Problem of = random_problem(20, 6, 92);
  of.dw = 0.0;
  EXPECT_LE(worst_error(of), stated_error);
}

TEST(FourierSums, APlanServesThreadsAndRepeatsItsBits) {
  const Problem of = random_problem(500, 300, 93);
  const FourierSums sums(of.t, of.w0, of.dw, of.orders);
  const auto once = sums.of(of.w);
  std::vector<std::complex<double>> other;
  std::thread thread([&] { other = sums.of(of.w); });
  const auto again = sums.of(of.w);
  thread.join();
  EXPECT_EQ(once, again);
  EXPECT_EQ(once, other);
}

TEST(FourierSums, ColumnsTogetherHaveTheBitsTheyHaveAlone) {
  for (const std::size_t orders : {40u, 9000u}) {  // several at a time, and one
    const Problem of = random_problem(70, orders, 94);
    const FourierSums sums(of.t, of.w0, of.dw, of.orders);
    std::vector<std::vector<double>> values(5, of.w);
    std::vector<std::span<const double>> columns;
    for (std::size_t c = 0; c < values.size(); ++c) {
      for (double& w : values[c]) w += static_cast<double>(c);
      columns.emplace_back(values[c]);
    }
    const auto together = sums.of(columns);
    ASSERT_EQ(together.size(), columns.size());
    for (std::size_t c = 0; c < columns.size(); ++c) {
      EXPECT_EQ(together[c], sums.of(columns[c])) << orders << ' ' << c;
    }
  }
}

TEST(FourierSums, BrokenContracts) {
  const std::vector<double> t{0.0, 1.0}, w{1.0};
  EXPECT_THROW(FourierSums(t, 0.0, 1.0, 0), ContractViolation);
  EXPECT_THROW(FourierSums(t, std::nan(""), 1.0, 1), ContractViolation);
  EXPECT_THROW(FourierSums(t, 0.0, 1.0, 1).of(w), ContractViolation);
}

}  // namespace
}  // namespace trueaxis

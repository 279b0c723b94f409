// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>

#include "diagnose/search/scan.hpp"
#include "support/diagnose_bench.hpp"

namespace trueaxis {
namespace {

using namespace diagnose_detail;
using Eigen::Index;

constexpr double sigma_mm = 0.01;
constexpr std::uint64_t seed = 4;

struct LineCase {
  const char* id;  ///< nullptr: a pattern
  Pattern pattern;
  double frequency;   ///< cycles per rad of C, s, mm
  PointColumn along;  ///< what it is periodic in
};

void PrintTo(const LineCase& c, std::ostream* out) { *out << (c.id ? c.id : "pattern"); }

/// A cone. In two passes, at 60 and 151 rpm, C, Z and t are three variables.
struct Bench {
  LinearisationPoint point;
  ObservationMask mask;
  Resolution resolution;

  explicit Bench(const testing::HelixPlan& plan)
      : point(testing::bench_point(plan, 0.1)),
        mask(make_observation_mask(point)),
        resolution(resolution_of(point, mask)) {}
  Problem problem(const std::vector<double>& y) const { return {point, mask, resolution, y}; }
};
const testing::HelixPlan out_and_back{.readings = 900, .passes = 2};

Hypothesis hypothesis_of(const LineCase& c, double frequency) {
  Hypothesis h;
  if (c.id) h = of_effect(c.id, {});
  h.pattern = c.pattern;
  return at_frequency(h, frequency);
}

/// Decrease of the whitened sum of squares by the two columns, by QR on the explicit matrix.
double exact_gain(const Bench& b, const Hypothesis& h, const std::vector<double>& y,
                  const std::vector<double>& phi) {
  const Eigen::MatrixXd all = testing::explicit_columns(b.point, std::vector<Hypothesis>{h});
  const Eigen::MatrixXd raw = all.rightCols(2);
  const Eigen::VectorXd readings = testing::as_vector(y);
  Eigen::MatrixXd x = raw;
  Eigen::VectorXd left = readings;
  for (Index i = 0; i < raw.rows(); ++i) {
    const bool counts = i >= static_cast<Index>(phi.size()) &&
                        b.mask.run[static_cast<std::size_t>(i)] >= phi.size();
    for (std::size_t j = 0; j < phi.size() && counts; ++j) {
      x.row(i) -= phi[j] * raw.row(i - static_cast<Index>(j) - 1);
      left(i) -= phi[j] * readings(i - static_cast<Index>(j) - 1);
    }
    if (!counts) x.row(i).setZero(), left(i) = 0.0;
  }
  return left.squaredNorm() - testing::explicit_rss(x, left);
}

class ScannedLine : public ::testing::TestWithParam<std::tuple<LineCase, double>> {};

// A line of 20 σ²-units per reading's worth: λ = N/2 (0.5)² ≈ 225, the tallest of its own scan.
// - peak: within half a cell 1/T of the truth, of which a quarter is the bins' and the rest of what
//   noise moves it (√6/(π √λ) basis, 0.05);
// - gain: the two sums of a scan forget what cos and sin share, of order 1/(cycles), and the ends
// of
//   whitening: within 5 % of QR at the same frequency;
// - a bin of 0.4 basis misses at most 1 − sinc²(0.2) = 12.5 % of the best gain.
TEST_P(ScannedLine, IsFoundWithItsGain) {
  const auto& [c, rho] = GetParam();
  std::cout << "seed " << seed << '\n';
  const Bench b(out_and_back);
  const std::vector<double> phi = rho == 0.0 ? std::vector<double>{} : std::vector<double>{rho};
  std::vector<double> y = testing::correlated_noise(b.point.size(), sigma_mm, rho, seed);
  const Hypothesis truth = hypothesis_of(c, c.frequency);
  const Eigen::MatrixXd columns =
      testing::explicit_columns(b.point, std::vector<Hypothesis>{truth}).rightCols(2);
  const double size =
      0.5 * sigma_mm * std::sqrt(0.5 * static_cast<double>(b.point.size())) / columns.col(0).norm();
  for (std::size_t i = 0; i < y.size(); ++i)
    y[i] +=
        size * (0.8 * columns(static_cast<Index>(i), 0) - 0.6 * columns(static_cast<Index>(i), 1));
  const NormalEquations equations(b.point, b.mask, y, phi, 1);
  const Problem problem = b.problem(y);
  const Scans scans = LineScanner(problem)(equations, y);
  const Peak* best = nullptr;
  for (const Peak& p : c.id ? scans.causes : scans.patterns) {
    const bool same = c.id ? p.hypothesis.id() == c.id
                           : p.hypothesis.pattern.order == c.pattern.order &&
                                 p.hypothesis.pattern.in_time == c.pattern.in_time &&
                                 std::signbit(p.hypothesis.pattern.frequency) ==
                                     std::signbit(c.pattern.frequency);
    if (same && (!best || p.gain > best->gain)) best = &p;
  }
  ASSERT_NE(best, nullptr);
  const auto [low, high] = b.point.range(c.along);
  const double cell = 1.0 / (high - low);
  EXPECT_NEAR(frequency_of(best->hypothesis), c.frequency, 0.5 * cell);
  EXPECT_NEAR(best->frequency, frequency_of(best->hypothesis), 1e-12);
  EXPECT_NEAR(best->gain / exact_gain(b, best->hypothesis, y, phi), 1.0, 0.05);
  double largest = 0.0;
  for (double at = -0.5; at <= 0.5; at += 0.05)
    largest = std::max(largest, exact_gain(b, hypothesis_of(c, c.frequency + at * cell), y, phi));
  EXPECT_GT(best->gain / largest, 0.875 * 0.95);
}

INSTANTIATE_TEST_SUITE_P(
    Lines, ScannedLine,
    ::testing::Combine(
        ::testing::Values(LineCase{"spindle.asynchronous", {}, 0.42 / two_pi, &PointPart::c},
                          LineCase{"environment.vibration", {}, 7.31, &PointPart::time},
                          LineCase{"part.waviness", {}, 1.0 / 7.3, &PointPart::s},
                          LineCase{"slide.leadscrew_periodic", {}, 1.0 / 8.1, &PointPart::z},
                          LineCase{"probe.cyclic", {}, 20.0, &PointPart::sensed},
                          LineCase{"part.feed_marks", {}, 1.0 / 0.87, &PointPart::s},
                          LineCase{nullptr,
                                   {.kind = Pattern::Kind::line, .order = 4.0, .frequency = 0.057},
                                   0.057,
                                   &PointPart::s},
                          LineCase{nullptr,
                                   {.kind = Pattern::Kind::line, .order = 2.0, .frequency = -0.083},
                                   0.083,
                                   &PointPart::s}),
        ::testing::Values(0.0, 0.5)));

// Σ W over the scans that count, W = Δf √(4π var x): in one pass C, Z and t are one variable and
// the scans along them the same lines, counted once.
TEST(ScanLines, CountTheSameLinesOnce) {
  const Bench two(out_and_back), one({.readings = 1800});
  const std::vector<double> y = testing::white_noise(1800, sigma_mm, seed);
  const auto bandwidth = [&](const Bench& b) {
    const Problem problem = b.problem(y);
    return LineScanner(problem).bandwidth();
  };
  // Orders 0.3 to half of 23.7 over 1800/23.7 turns, and the probe's scale over its swing.
  const double turns = 1800.0 / 23.7;
  const double orders = (0.5 * 23.7 - 0.3) * turns * std::sqrt(2.0 * two_pi / 12.0);
  EXPECT_GT(bandwidth(one), 0.99 * orders);
  EXPECT_GT(bandwidth(two), 2.0 * orders);
}

}  // namespace
}  // namespace trueaxis

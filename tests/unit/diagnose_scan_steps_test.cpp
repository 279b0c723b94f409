// SPDX-License-Identifier: Apache-2.0
// The date of a slip from running sums against QR on the explicit matrix of every date.
#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>

#include "diagnose/search/propose.hpp"
#include "diagnose/search/scan_steps.hpp"
#include "support/diagnose_bench.hpp"

namespace trueaxis {
namespace {

using namespace diagnose_detail;
using Eigen::Index;
using Eigen::MatrixXd;

constexpr double sigma_mm = 1e-3;
constexpr std::uint64_t seed = 11;

/// Rows of a matrix less what the noise model predicts of them; those it does not hold for are 0.
MatrixXd whitened(const MatrixXd& raw, const ObservationMask& mask, double phi) {
  MatrixXd out = raw;
  for (Index i = 0; i < raw.rows(); ++i) {
    if (mask.run[static_cast<std::size_t>(i)] > 0)
      out.row(i) -= phi * raw.row(i - 1);
    else if (phi != 0.0)
      out.row(i).setZero();
  }
  return out;
}

/// What a hypothesis explains after base and terms.
double exact_gain(const LinearisationPoint& point, const ObservationMask& mask, double phi,
                  std::vector<Hypothesis> terms, const Hypothesis& step,
                  const std::vector<double>& y) {
  const MatrixXd left = whitened(testing::as_vector(y), mask, phi);
  const auto rss = [&] {
    return testing::explicit_rss(whitened(testing::explicit_columns(point, terms), mask, phi),
                                 left.col(0));
  };
  const double without = rss();
  terms.push_back(step);
  return without - rss();
}

class ScannedStep : public ::testing::TestWithParam<double> {};

// Two passes of 60 readings, a slip of 30 σ among lobes: the date is that of the step exactly, as
// no other leaves less than the readings between (30 σ each, twice). And none takes off more than
// 12 σ² beyond it: among those the plausible size decides.
TEST_P(ScannedStep, IsDatedToTheReading) {
  const double phi = GetParam();
  std::cout << "seed " << seed << '\n';
  const testing::HelixPlan plan{.readings = 60, .per_turn = 13.7, .passes = 2};
  const LinearisationPoint point = testing::bench_point(plan, 0.1);
  const ObservationMask mask = make_observation_mask(point);
  const Resolution resolution = resolution_of(point, mask);
  TermShape order;
  order.order = 3.0;
  const std::vector<Hypothesis> lobes{of_effect("part.roundness", order)};
  for (const std::size_t reading : {9U, 31U, 60U, 88U, 112U}) {
    std::vector<double> y = testing::correlated_noise(point.size(), sigma_mm, phi, seed + reading);
    TermShape shape;
    shape.onset_s = 0.5 * (point.time[reading - 1] + point.time[reading]);
    const std::vector<Hypothesis> truth{of_effect("part.slip", shape, {0, 1})};
    const std::vector<double> slipped =
        contribution(point, truth, std::vector<double>{30.0 * sigma_mm, -24.0 * sigma_mm});
    for (std::size_t i = 0; i < y.size(); ++i) y[i] += slipped[i];
    const Problem problem{point, mask, resolution, y};
    double tests = 0.0;
    const std::vector<Hypothesis> found = scan_steps(
        problem, phi == 0.0 ? std::vector<double>{} : std::vector<double>{phi}, lobes, tests);
    const auto radial = std::ranges::find_if(found, [](const Hypothesis& h) {
      return h.free == std::vector<std::size_t>{0, 1};
    });
    ASSERT_NE(radial, found.end());
    EXPECT_EQ(radial->shape.onset_s, shape.onset_s) << "reading " << reading;
    const double gain = exact_gain(point, mask, phi, lobes, *radial, y);
    double most = 0.0;
    for (std::size_t k = 4; k + 4 <= point.size(); ++k) {
      Hypothesis other = *radial;
      other.shape.onset_s = 0.5 * (point.time[k - 1] + point.time[k]);
      most = std::max(most, exact_gain(point, mask, phi, lobes, other, y));
    }
    EXPECT_GE(gain, most - 12.0 * sigma_mm * sigma_mm) << "reading " << reading;
    EXPECT_GT(tests, 0.0);
  }
}
INSTANTIATE_TEST_SUITE_P(Noise, ScannedStep, ::testing::Values(0.0, 0.6));

// A slip of 30 σ that lasts a sixth of the stream: refined from what is proposed, it
// explains as much as the true dates but for what two of them fitted by steps may miss, 4 σ².
TEST(ScannedCreep, IsFoundWithItsDuration) {
  std::cout << "seed " << seed << '\n';
  const testing::HelixPlan plan{.readings = 120, .per_turn = 13.7};
  const LinearisationPoint point = testing::bench_point(plan, 0.1);
  const ObservationMask mask = make_observation_mask(point);
  const Resolution resolution = resolution_of(point, mask);
  const double all_s = point.time.back() - point.time.front();
  for (const double from : {0.2, 0.45, 0.7}) {
    TermShape shape;
    shape.onset_s = point.time.front() + from * all_s;
    shape.duration_s = all_s / 6.0;
    const Hypothesis truth = of_effect("part.slip", shape, {0, 1});
    std::vector<double> y = testing::correlated_noise(point.size(), sigma_mm, 0.0, seed);
    const std::vector<double> crept =
        contribution(point, std::vector{truth}, std::vector{30.0 * sigma_mm, -24.0 * sigma_mm});
    for (std::size_t i = 0; i < y.size(); ++i) y[i] += crept[i];
    const Problem problem{point, mask, resolution, y};
    double tests = 0.0, most = 0.0;
    Hypothesis best;
    for (const Hypothesis& proposed : scan_steps(problem, {}, {}, tests)) {
      if (proposed.free != truth.free || proposed.shape.duration_s == 0.0) continue;
      const Hypothesis refined = refine(problem, {}, {}, proposed, step_start);
      const double gain = exact_gain(point, mask, 0.0, {}, refined, y);
      if (gain > most) most = gain, best = refined;
    }
    EXPECT_GE(most, exact_gain(point, mask, 0.0, {}, truth, y) - 4.0 * sigma_mm * sigma_mm);
    // A date moved by d leaves d/duration of 34 σ over the readings of the slip, 20 of them, half
    // of it within sizes that follow.
    EXPECT_NEAR(best.shape.duration_s, shape.duration_s, 0.2 * shape.duration_s) << from;
    EXPECT_NEAR(best.shape.onset_s, shape.onset_s, 0.1 * shape.duration_s) << from;
  }
}

}  // namespace
}  // namespace trueaxis

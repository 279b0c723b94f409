// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <iostream>

#include "support/ball_bench.hpp"
#include "support/dense.hpp"

namespace trueaxis::testing {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Derivatives of all deviations by every drawn error and the balls' centres, by the test's own
/// matrices.
struct OwnJacobian {
  const Machine& machine;
  const ErrorModel& errors;
  std::vector<Vector3> balls;

  VectorXd deviations(const MachineMeasurement& at, const ErrorModel& with,
                      const std::vector<Vector3>& centres) const {
    const BallBench bench{machine, with};
    VectorXd out(static_cast<Index>(3 * at.rows()));
    for (std::size_t i = 0; i < at.rows(); ++i) {
      const Vector3 d = bench.deviation(
          at.axes[i], centres[static_cast<std::size_t>(at.ball[i] - 1)], at.tool_length_mm[i]);
      for (std::size_t k = 0; k < 3; ++k) out[static_cast<Index>(3 * i + k)] = d[k];
    }
    return out;
  }

  /// A column is times the plausible size of its error, 0.1 mm or 0.2 mrad; of a centre 0.1 mm.
  MatrixXd of(const MachineMeasurement& at) const {
    MatrixXd out(static_cast<Index>(3 * at.rows()),
                 static_cast<Index>(errors.terms.size() + 3 * balls.size()));
    Index column = 0;
    for (std::size_t j = 0; j < errors.terms.size(); ++j) {
      const double size = errors.terms[j].name.angular() ? 0.2e-3 : 0.1;
      ErrorModel up = errors, down = errors;
      std::get<ConstantError>(up.terms[j].function).value += 0.5 * size;
      std::get<ConstantError>(down.terms[j].function).value -= 0.5 * size;
      out.col(column++) = deviations(at, up, balls) - deviations(at, down, balls);
    }
    for (std::size_t b = 0; b < balls.size(); ++b)
      for (std::size_t k = 0; k < 3; ++k) {
        auto up = balls, down = balls;
        up[b][k] += 0.05;
        down[b][k] -= 0.05;
        out.col(column++) = deviations(at, errors, up) - deviations(at, errors, down);
      }
    return out;
  }
};

/// Predictions of the calibrated machine elsewhere, of the balls where it places them, against the
/// truth, over their Cramér-Rao bound.
/// @returns the mean square of error over bound
double score(std::uint64_t seed, double sigma_mm) {
  Draw draw(seed);
  const Machine machine = trunnion();
  const ErrorModel truth = drawn_location_errors(machine, draw);
  const BallBench bench{machine, truth};
  BallPlan plan;
  const MachineMeasurement data = measure_balls(bench, plan, sigma_mm, draw);
  const Calibration found = calibrate(machine, std::span(&data, 1));
  EXPECT_TRUE(found.converged) << found.message;
  BallPlan other;
  other.a_deg = {-75, -45, -10, 15};
  other.c_deg = {20, 110, 200, 290};
  other.tool_lengths_mm = {150.0};
  const MachineMeasurement elsewhere = measure_balls(bench, other, 0.0, draw);

  const OwnJacobian own{machine, truth, plan.balls};
  const MatrixXd J = own.of(data) / sigma_mm, K = own.of(elsewhere);
  // The prior of the plausible sizes bounds what no position shows.
  const MatrixXd information = J.transpose() * J + 1e-3 * MatrixXd::Identity(J.cols(), J.cols());
  const MatrixXd covariance = dense::inverse(information);
  std::vector<Vector3> placed;
  for (const PlacedBall& ball : found.balls) placed.push_back(ball.centre_mm);
  const VectorXd error = own.deviations(elsewhere, found.errors, placed) -
                         own.deviations(elsewhere, truth, plan.balls);
  double sum = 0.0;
  for (Index i = 0; i < error.size(); ++i) {
    const double bound = std::sqrt(K.row(i) * covariance * K.row(i).transpose());
    sum += error[i] * error[i] / (bound * bound);
  }
  return sum / static_cast<double>(error.size());
}
// The mean square of error over bound is 1 when the estimate is efficient; of 40 measurements it
// has at least 40 degrees of freedom: 3 standard deviations are 3 √(2/40) = 0.67 at most.
TEST(CalibrateLaw, PredictsElsewhereAtTheCramerRaoBound) {
  constexpr std::uint64_t seeds = 40;
  double sum = 0.0;
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    const double one = score(seed, 1e-3);
    EXPECT_LT(std::sqrt(one), 3.0) << "seed " << seed;
    sum += one / seeds;
  }
  std::cout << "mean square of error over bound " << sum << '\n';
  EXPECT_GT(sum, 1.0 - 0.67);
  EXPECT_LT(sum, 1.0 + 0.67);
}

TEST(CalibrateLaw, SaysWhatIsNotTold) {
  Draw draw(3);
  const Machine machine = trunnion();
  const ErrorModel truth = drawn_location_errors(machine, draw);
  const BallBench bench{machine, truth};
  const MachineMeasurement data = measure_balls(bench, {}, 1e-3, draw);
  const Calibration found = calibrate(machine, std::span(&data, 1));
  const auto about = [&](const std::string& name) -> const NotDetermined* {
    for (const NotDetermined& one : found.not_determined)
      if (one.members.front() == name) return &one;
    return nullptr;
  };
  // What moves the tip alone moves it against every ball alike: the lines of the axes, seen from
  // the tip, and the ball are elsewhere.
  for (const auto& [name, line] : {std::pair{"X0S", "X0C"}, {"Y0S", "Y0C"}, {"Z0S", "Z0A"}}) {
    const NotDetermined* one = about(name);
    ASSERT_NE(one, nullptr) << name;
    EXPECT_NE(std::ranges::find(one->members, line), one->members.end()) << one->why;
    EXPECT_NE(std::ranges::find(one->members, "ball"), one->members.end()) << one->why;
  }
  for (const char* along : {"Z0C", "X0A"}) {  // an axis' line moved along itself
    ASSERT_NE(about(along), nullptr);
    EXPECT_EQ(about(along)->members.size(), 1U);
  }
  EXPECT_EQ(about("X0C"), nullptr);
  EXPECT_EQ(found.parameters.size() + found.not_determined.size(), truth.terms.size());
}

}  // namespace
}  // namespace trueaxis::testing

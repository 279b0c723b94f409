// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <random>

#include "trueaxis/correction.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis {
namespace {

using Matrix4 = Eigen::Matrix<double, 4, 4, Eigen::RowMajor>;

// Σ w ∫ |Δ|² dZ by Simpson's rule, exact for a square of a line; planes as the contract says.
double objective(const Axis& target, const std::vector<Reference>& references, double z0,
                 double z1) {
  double sum = 0.0;
  for (const Reference& reference : references) {
    const Axis& axis = reference.axis.axis;
    const auto squared = [&](double z) {
      const auto [x, y] = target.at(z);
      const auto [xr, yr] = axis.at(z);
      return (x - xr) * (x - xr) + (y - yr) * (y - yr);
    };
    const double length = std::abs(z1 - z0);
    const double tilt = std::hypot(target.slope_x - axis.slope_x, target.slope_y - axis.slope_y);
    sum += reference.weight *
           (reference.face_radius_mm > 0.0
                ? std::pow(reference.face_radius_mm * tilt, 2) * length
                : length / 6.0 * (squared(z0) + 4.0 * squared(0.5 * (z0 + z1)) + squared(z1)));
  }
  return sum;
}

std::vector<Reference> three_references() {
  return {{"bearing seat", {{0.10, -0.05, 1e-3, 5e-4, 10.0}, {}}, 2.0, 0.0},
          {"journal", {{0.13, 0.02, -4e-4, 2e-4, 90.0}, {}}, 1.0, 0.0},
          {"shoulder", {{0.0, 0.0, 6e-4, -3e-4, 0.0}, {}}, 1.5, 40.0}};
}

TEST(TargetAxis, OneReferenceIsItsOwnTarget) {
  Reference reference{"bore", {{0.2, -0.1, 1e-3, 2e-3, 30.0}, {}}, 1.0, 0.0};
  for (int i = 0; i < 4; ++i)
    reference.axis.covariance.by_rows[static_cast<std::size_t>(5 * i)] = 1e-6;
  const TargetAxis target = solve_target_axis(std::vector{reference}, 0.0, 50.0);
  for (const double z : {0.0, 25.0, 50.0}) {
    EXPECT_NEAR(target.axis.axis.at(z)[0], reference.axis.axis.at(z)[0], 1e-15);
    EXPECT_NEAR(target.axis.axis.at(z)[1], reference.axis.axis.at(z)[1], 1e-15);
    EXPECT_NEAR(target.axis.u_at(z), reference.axis.u_at(z), 1e-12);
  }
  EXPECT_NEAR(target.remainders[0].coaxiality_mm, 0.0, 1e-15);
  // The residual is known no better than the reference itself: as a diameter, at the worse end.
  EXPECT_NEAR(target.remainders[0].u_coaxiality_mm, 2.0 * reference.axis.u_at(0.0), 1e-15);
}

TEST(TargetAxis, IsAMinimumOfTheIntegral) {
  const auto references = three_references();
  const TargetAxis target = solve_target_axis(references, 5.0, 65.0);
  const double least = objective(target.axis.axis, references, 5.0, 65.0);
  // A quadratic: along each parameter the two sides rise by the same amount.
  for (double Axis::*parameter : {&Axis::x_mm, &Axis::y_mm, &Axis::slope_x, &Axis::slope_y}) {
    const double step = parameter == &Axis::x_mm || parameter == &Axis::y_mm ? 1e-2 : 1e-4;
    Axis up = target.axis.axis, down = up;
    up.*parameter += step, down.*parameter -= step;
    const double rise_up = objective(up, references, 5.0, 65.0) - least;
    const double rise_down = objective(down, references, 5.0, 65.0) - least;
    EXPECT_GT(rise_up, 0.0);
    EXPECT_NEAR(rise_up, rise_down, 1e-9 * rise_up);
  }
}

TEST(TargetAxis, CovarianceIsThatOfAMonteCarlo) {
  const unsigned seed = 77;
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  auto references = three_references();
  std::vector<Matrix4> roots;
  for (Reference& reference : references) {
    Matrix4 root = Matrix4::NullaryExpr([&] { return normal(random); });
    root.bottomRows<2>() *= 0.02;
    root *= 1e-3;
    Eigen::Map<Matrix4>(reference.axis.covariance.data()) = root * root.transpose();
    roots.push_back(root);
  }
  const TargetAxis target = solve_target_axis(references, 0.0, 80.0);
  const int draws = 20000;
  Matrix4 sample = Matrix4::Zero();
  for (int i = 0; i < draws; ++i) {
    auto drawn = references;
    for (std::size_t k = 0; k < drawn.size(); ++k) {
      const Eigen::Vector4d d =
          roots[k] * Eigen::Vector4d::NullaryExpr([&] { return normal(random); });
      Axis& axis = drawn[k].axis.axis;
      axis.x_mm += d[0], axis.y_mm += d[1], axis.slope_x += d[2], axis.slope_y += d[3];
    }
    const Axis a = solve_target_axis(drawn, 0.0, 80.0).axis.axis;
    const Axis& mean = target.axis.axis;
    const Eigen::Vector4d d(a.x_mm - mean.x_mm, a.y_mm - mean.y_mm, a.slope_x - mean.slope_x,
                            a.slope_y - mean.slope_y);
    sample += d * d.transpose() / draws;
  }
  const Eigen::Map<const Matrix4> stated(target.axis.covariance.data());
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 4; ++j) {
      // Standard error of a sampled covariance is at most sqrt(2/N) of the variances: 5 of them.
      const double bound = 5.0 * std::sqrt(2.0 / draws * stated(i, i) * stated(j, j));
      EXPECT_NEAR(sample(i, j), stated(i, j), bound) << "seed " << seed << ' ' << i << ' ' << j;
    }
  }
}

TEST(TargetAxis, RemaindersAreDistancesFromEachReference) {
  const std::vector<Reference> references = {{"a", {{0.0, 0.0, 0, 0, 0}, {}}, 1.0, 0.0},
                                             {"b", {{0.06, 0.08, 0, 0, 0}, {}}, 3.0, 0.0},
                                             {"face", {{0, 0, 2e-3, 0, 0}, {}}, 0.0, 25.0}};
  const TargetAxis target = solve_target_axis(references, 0.0, 10.0);
  // Parallel axes 0.1 mm apart, weights 1 : 3: the target lies 75 µm from a and 25 µm from b.
  EXPECT_NEAR(target.remainders[0].offset_start_mm, 0.075, 1e-15);
  EXPECT_NEAR(target.remainders[0].coaxiality_mm, 0.150, 1e-15);
  EXPECT_NEAR(target.remainders[1].offset_end_mm, 0.025, 1e-15);
  EXPECT_NEAR(target.remainders[1].coaxiality_mm, 0.050, 1e-15);
  // A face tilted by atan 0.002 runs out by 2 R tan.
  EXPECT_NEAR(target.remainders[2].tilt_rad, std::atan(2e-3), 1e-15);
  EXPECT_NEAR(target.remainders[2].coaxiality_mm, 2.0 * 25.0 * 2e-3, 1e-12);
}

TEST(TargetAxis, APlaneTurnsTheAxisAboutTheMiddleOfTheCut) {
  // Equal parts: L²/12 = R² gives the mean of both directions, the point at mid length stays.
  const double length = 60.0, radius = length / std::sqrt(12.0);
  const std::vector<Reference> references = {{"seat", {{0.3, 0, 0, 0, 30.0}, {}}, 1.0, 0.0},
                                             {"face", {{0, 0, 2e-3, 0, 0}, {}}, 1.0, radius}};
  const Axis axis = solve_target_axis(references, 0.0, length).axis.axis;
  EXPECT_NEAR(axis.at(30.0)[0], 0.3, 1e-15);
  EXPECT_NEAR(axis.slope_x, 1e-3, 1e-15);
}

TEST(TargetAxis, PlanesAloneAreRefusedForWantOfAPosition) {
  const std::vector<Reference> planes = {{"face", {{0, 0, 1e-3, 0, 0}, {}}, 1.0, 40.0}};
  try {
    solve_target_axis(planes, 0.0, 10.0);
    FAIL() << "not refused";
  } catch (const Refusal& refusal) {
    EXPECT_NE(std::string(refusal.what()).find("do not fix the position"), std::string::npos);
  }
  EXPECT_THROW(solve_target_axis({}, 0.0, 10.0), Refusal);
}

TEST(Coaxiality, IsTwiceTheLargestPerpendicularDistance) {
  const Axis datum{0, 0, 0, 0, 0};
  EXPECT_NEAR(coaxiality_mm({0.05, 0, 0, 0, 0}, datum, 0, 100), 0.1, 1e-15);
  // Crossing in the middle: the ends are the worst, at either one.
  EXPECT_NEAR(coaxiality_mm({0, 0, 1e-3, 0, 50}, datum, 0, 100), 0.1, 1e-15);
  EXPECT_NEAR(coaxiality_mm({0, 0, 1e-3, 0, 20}, datum, 0, 100), 0.16, 1e-15);
  EXPECT_NEAR(coaxiality_mm({0, 0, 1e-3, 0, 20}, datum, 100, 0), 0.16, 1e-15);
  // A tilted datum: the distance is perpendicular to it, smaller than along X by cos(tilt).
  const double slope = 0.5;
  EXPECT_NEAR(coaxiality_mm({1.0, 0, slope, 0, 0}, {0, 0, slope, 0, 0}, 0, 100),
              2.0 / std::sqrt(1.0 + slope * slope), 1e-13);
}

}  // namespace
}  // namespace trueaxis

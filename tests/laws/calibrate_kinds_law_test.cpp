// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <iostream>

#include "support/ball_bench.hpp"

namespace trueaxis::testing {
namespace {

double found(const Calibration& calibration, const std::string& name) {
  for (const CalibratedParameter& one : calibration.parameters)
    if (one.name == name) return one.estimate.value;
  return std::nan("");
}

double u_of(const Calibration& calibration, const std::string& name) {
  for (const CalibratedParameter& one : calibration.parameters)
    if (one.name == name) return one.estimate.u;
  return std::nan("");
}

/// A bar of balls every 50 mm along X, a little askew, met by the tip of the actual machine.
MachineMeasurement measure_array(const BallBench& bench, double sigma_mm, Draw& draw) {
  MachineMeasurement out;
  out.source = "array.csv";
  out.kind = MeasurementKind::array;
  out.axis = AxisName::X;
  out.noise_mm = sigma_mm;
  std::normal_distribution<double> normal(0.0, sigma_mm);
  const Vector3 e{std::sqrt(1.0 - 5e-6), 2e-3, -1e-3};
  for (int i = 0; i <= 14; ++i) {
    const double s = 50.0 * i;
    const Vector3 ball{-350.0 + s * e[0], 20.0 + s * e[1], 60.0 + s * e[2]};
    AxisPositions q{};
    bench.follow(q, ball, 120.0);
    for (std::size_t k = 0; k < 3; ++k) q[k] += normal(draw.engine);
    out.setup.push_back(1);
    out.ball.push_back(i + 1);
    out.along_mm.push_back(s);
    out.axes.push_back(q);
  }
  return out;
}

// Talyan et al. subtract the mean of an axis' error from the program; here the error as a function
// of the position is subtracted. Of 15 balls the mean square that three polynomials leave at the
// balls is 3 σ²/15 at least (Cramér-Rao), and at 3 standard deviations (1 + 3 √(2/3)) times that.
TEST(CalibrateKinds, ArrayGivesTheErrorOfItsAxis) {
  constexpr double sigma_mm = 1e-3;
  const Machine machine = trunnion();
  ErrorModel truth;
  const auto exx = [](double s) { return 0.02 * s + 0.008 * (1.5 * s * s - 0.5); };
  truth.terms = {
      {*parse_error_name("EXX"), PolynomialError{{-0.004, 0.02, 0.012}, 0.0, 350.0}, 0.0},
      {*parse_error_name("EYX"), PolynomialError{{0.0, 0.0, 0.006}, 0.0, 350.0}, 0.0}};
  double before = 0.0, average = 0.0, full = 0.0;
  constexpr int seeds = 20;
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    Draw draw(seed);
    const BallBench bench{machine, truth};
    const MachineMeasurement data = measure_array(bench, sigma_mm, draw);
    const Calibration calibration = calibrate(machine, std::span(&data, 1));
    ASSERT_TRUE(calibration.converged);
    // The mean of what the read-outs show, which is counted from the first ball.
    double mean = 0.0;
    for (std::size_t i = 0; i < data.rows(); ++i)
      mean -= (data.axes[i][0] - data.axes[0][0] - data.along_mm[i]) / 15.0;
    double offset = 0.0;  // the zero of X is not told from the bar's place
    const auto left = [&](std::size_t i) {
      const double x = data.axes[i][0];
      return exx(x / 350.0) - calibration.errors.value(*parse_error_name("EXX"), data.axes[i]);
    };
    for (std::size_t i = 0; i < data.rows(); ++i) offset += left(i) / 15.0;
    for (std::size_t i = 0; i < data.rows(); ++i) {
      const double error = exx(data.axes[i][0] / 350.0) - exx(data.axes[0][0] / 350.0);
      before += error * error / (15.0 * seeds);
      average += std::pow(error - mean, 2) / (15.0 * seeds);
      full += std::pow(left(i) - offset, 2) / (15.0 * seeds);
    }
  }
  std::cout << "EXX, RMS um: " << 1e3 * std::sqrt(before) << " before, " << 1e3 * std::sqrt(average)
            << " with its mean taken off, " << 1e3 * std::sqrt(full) << " with the function\n";
  EXPECT_LT(full, 3.0 * sigma_mm * sigma_mm / 15.0 * (1.0 + 3.0 * std::sqrt(2.0 / 3.0 / seeds)));
  EXPECT_LT(average, before);
  EXPECT_GT(average, 25.0 * full);
}

// A bar of 100 mm between a ball on the table and the tip, at every C and tilt of the bar.
TEST(CalibrateKinds, BarLengthsGiveTheLineOfTheTable) {
  const Machine machine = trunnion();
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    Draw draw(seed);
    ErrorModel truth;
    truth.terms = {{*parse_error_name("X0C"), ConstantError{0.03}, 0.0},
                   {*parse_error_name("Y0C"), ConstantError{-0.02}, 0.0},
                   {*parse_error_name("A0C"), ConstantError{80e-6}, 0.0}};
    const BallBench bench{machine, truth};
    const ErrorModel none;
    const BallBench nominal{machine, none};
    std::normal_distribution<double> normal(0.0, 0.5e-3);
    MachineMeasurement data;
    data.source = "bar.csv";
    data.kind = MeasurementKind::bar;
    data.noise_mm = 0.5e-3;
    for (int b = 0; b < 2; ++b) {
      const Vector3 ball = b == 0 ? Vector3{110.0, 20.0, 40.0} : Vector3{40.0, -80.0, 95.0};
      for (int i = 0; i < 120; ++i) {
        AxisPositions q{};
        q[5] = 30.0 * i * rad_per_deg;
        q[3] = -15.0 * (i % 5) * rad_per_deg;
        nominal.follow(q, ball, 120.0);
        const double along = draw.between(0.2, 1.4), around = draw.between(0.0, two_pi);
        q[0] += 100.0 * std::cos(along) * std::cos(around);
        q[1] += 100.0 * std::cos(along) * std::sin(around);
        q[2] += 100.0 * std::sin(along);
        const Vector3 d = bench.deviation(q, ball, 120.0);
        data.setup.push_back(1);
        data.ball.push_back(b + 1);
        data.axes.push_back(q);
        data.length_mm.push_back(std::hypot(d[0], d[1], d[2]) + normal(draw.engine));
      }
    }
    const Calibration calibration = calibrate(machine, std::span(&data, 1));
    ASSERT_TRUE(calibration.converged) << "seed " << seed;
    // 4 u of a Gaussian estimate: 6 in 100 000.
    for (const auto& [name, value] : {std::pair{"X0C", 0.03}, {"Y0C", -0.02}, {"A0C", 80e-6}}) {
      EXPECT_NEAR(found(calibration, name), value, 4.0 * u_of(calibration, name))
          << name << " seed " << seed;
    }
    EXPECT_LT(u_of(calibration, "X0C"), 2e-3);
    EXPECT_NEAR(calibration.rms_after_mm, 0.5e-3, 0.5e-3 * 4.0 / std::sqrt(2.0 * 200.0));
  }
}

// Without a stated σ that of the residuals takes its place, and u with it.
TEST(CalibrateKinds, NoiseThatIsNotStatedIsEstimated) {
  const Machine machine = trunnion();
  Draw draw(5);
  const ErrorModel truth = drawn_location_errors(machine, draw);
  const BallBench bench{machine, truth};
  MachineMeasurement data = measure_balls(bench, {}, 3e-3, draw);
  data.noise_mm.reset();
  const Calibration calibration = calibrate(machine, std::span(&data, 1));
  EXPECT_EQ(calibration.noise_basis, NoiseBasis::residuals);
  // 480 numbers: σ is known to 1/√960 = 3.2 %, four times that.
  EXPECT_NEAR(calibration.noise_mm, 3e-3, 3e-3 * 4.0 / std::sqrt(2.0 * 450.0));
}

}  // namespace
}  // namespace trueaxis::testing

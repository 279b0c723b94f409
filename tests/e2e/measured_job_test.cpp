// SPDX-License-Identifier: Apache-2.0
// The measured job of the repository, judged by sums of this test's own: a trimmed least-squares
// circle through points, and plain Fourier sums.
#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <complex>
#include <fstream>
#include <numbers>

#include "support/command_fixture.hpp"
#include "support/places.hpp"

namespace trueaxis::testing {
namespace {

constexpr double radius_mm = 14.5;

struct Trace {
  std::vector<double> x_mm, c_rad;
};

Trace read_trace() {
  std::ifstream file(places::source() + "/data/measured/roundness_trace.csv");
  Trace trace;
  double x = 0.0, c = 0.0;
  for (std::string line; std::getline(file, line);)
    if (std::sscanf(line.c_str(), "%lf,%lf", &x, &c) == 2)
      trace.x_mm.push_back(x), trace.c_rad.push_back(c);
  return trace;
}

/// The circle of the kept points by Kåsa's linear equations, and every point's distance from it.
struct Circle {
  Eigen::Vector2d centre_mm;
  std::vector<double> off_mm;
};
Circle circle_of(const Trace& trace, const std::vector<bool>& kept) {
  const auto n = static_cast<Eigen::Index>(trace.x_mm.size());
  Eigen::MatrixXd points(n, 2);
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto at = static_cast<std::size_t>(i);
    const double r = radius_mm + trace.x_mm[at];
    points.row(i) << r * std::cos(trace.c_rad[at]), r * std::sin(trace.c_rad[at]);
  }
  Eigen::Matrix3d a = Eigen::Matrix3d::Zero();
  Eigen::Vector3d b = Eigen::Vector3d::Zero();
  for (Eigen::Index i = 0; i < n; ++i) {
    if (!kept[static_cast<std::size_t>(i)]) continue;
    const Eigen::Vector3d row(2.0 * points(i, 0), 2.0 * points(i, 1), 1.0);
    a += row * row.transpose();
    b += row * points.row(i).squaredNorm();
  }
  const Eigen::Vector3d solved = a.ldlt().solve(b);
  Circle circle{solved.head<2>(), {}};
  const double r = std::sqrt(solved(2) + circle.centre_mm.squaredNorm());
  for (Eigen::Index i = 0; i < n; ++i)
    circle.off_mm.push_back((points.row(i).transpose() - circle.centre_mm).norm() - r);
  return circle;
}

double rms(const std::vector<double>& off_mm, const std::vector<bool>& kept) {
  double sum = 0.0, count = 0.0;
  for (std::size_t i = 0; i < off_mm.size(); ++i)
    if (kept[i]) sum += off_mm[i] * off_mm[i], count += 1.0;
  return std::sqrt(sum / count);
}

/// Beyond 3.5 robust σ (1.4826 times the median of the sizes) a point is excluded, until no more
/// is.
std::vector<bool> trimmed(const Trace& trace) {
  std::vector<bool> kept(trace.x_mm.size(), true);
  for (int round = 0; round < 20; ++round) {
    std::vector<double> off = circle_of(trace, kept).off_mm, sizes;
    for (const double one : off) sizes.push_back(std::abs(one));
    std::ranges::nth_element(sizes, sizes.begin() + static_cast<long>(sizes.size() / 2));
    const double limit = 3.5 * 1.4826 * sizes[sizes.size() / 2];
    for (std::size_t i = 0; i < off.size(); ++i) kept[i] = std::abs(off[i]) < limit;
  }
  return kept;
}

std::complex<double> order_of(const Trace& trace, int order) {
  std::complex<double> sum = 0.0;
  for (std::size_t i = 0; i < trace.x_mm.size(); ++i)
    sum += trace.x_mm[i] * std::polar(1.0, order * trace.c_rad[i]);
  return 2.0 * sum / static_cast<double>(trace.x_mm.size());
}

class MeasuredJob : public CommandTest {
 protected:
  void SetUp() override {
    CommandTest::SetUp();
    const CommandStreams done =
        command("run " + places::source() + "/data/jobs/measured.toml -o out");
    ASSERT_EQ(done.exit_code, 0) << done.out << done.err;
    fit_ = result("out/result.json").at("references").at(0).at("fit");
    ASSERT_EQ(trace_.x_mm.size(), 3600u);
  }
  double axis(const char* which) const { return fit_.at("axis").at(which).at("value"); }
  nlohmann::json fit_;
  const Trace trace_ = read_trace();
};

// The two centres are of different losses and points: both err by noise, u of the fit. The plain
// circle is off by more than that, because the scratches are in it.
TEST_F(MeasuredJob, CentreIsThatOfTheTrimmedCircle) {
  const Eigen::Vector2d found(axis("x"), axis("y"));
  const std::vector<bool> all(trace_.x_mm.size(), true), kept = trimmed(trace_);
  const double u = fit_.at("parameters").at("x0").at("u");
  EXPECT_LT((circle_of(trace_, kept).centre_mm - found).norm(), 2.0 * std::sqrt(2.0) * u);
  EXPECT_GT((circle_of(trace_, all).centre_mm - found).norm(), 4.0 * u);
}

// The RMS stated is that of the readings it kept. Its circle and this one, of the same readings but
// all of one weight, differ by less than 5 % of the variance: Tukey's weights favour small
// residuals.
TEST_F(MeasuredJob, TheScratchesAreMostOfWhatAPlainCircleLeaves) {
  const std::vector<bool> all(trace_.x_mm.size(), true);
  std::vector<bool> kept = all;
  for (const auto& row : fit_.at("rejected")) kept[row.at("row").get<std::size_t>() - 1] = false;
  const double plain = rms(circle_of(trace_, all).off_mm, all),
               left = rms(circle_of(trace_, kept).off_mm, kept), job = fit_.at("rms").at("value");
  std::cout << 1e3 * plain << " and " << 1e3 * left << " um, job " << 1e3 * job << '\n';
  EXPECT_NEAR(job, left, 0.025 * left);
  EXPECT_GT(plain, 2.0 * job);
}

// An off-centre circle has a second harmonic of e²/4R, twice the angle of the first: no ovality.
TEST_F(MeasuredJob, SecondHarmonicIsTheOffCentreCircle) {
  const std::complex<double> first = order_of(trace_, 1), second = order_of(trace_, 2);
  EXPECT_NEAR(std::abs(first), std::hypot(axis("x"), axis("y")), 1e-3);
  const std::complex<double> circle = -first * first / (4.0 * radius_mm);
  std::cout << "H2 " << 1e3 * std::abs(second) << " um, less the circle's "
            << 1e3 * std::min(std::abs(second - circle), std::abs(second + circle)) << '\n';
  EXPECT_LT(std::min(std::abs(second - circle), std::abs(second + circle)), 0.5 * std::abs(second));
  for (const auto& finding : result("out/diagnosis_1_specimen.json").at("findings"))
    EXPECT_FALSE(finding.at("parameters").contains("order")) << finding;
}

// Lobes of 3 and 4 undulations are larger than the texture, whose amplitude of each order from 5 to
// 50 is about that of noise of one level. λ = 2 (a/RMS)² is χ² of two degrees of freedom, and √λ
// has a standard deviation of 1 about its mean: against the threshold of so many hypotheses one
// revolution names neither with a probability of 95 %, four name both with one of 99.8 %.
TEST_F(MeasuredJob, LobesAreAtTheLimitOfOneRevolution) {
  const std::vector<bool> kept = trimmed(trace_);
  Trace left = trace_;
  left.x_mm = circle_of(trace_, kept).off_mm;
  for (std::size_t i = 0; i < kept.size(); ++i)
    if (!kept[i]) left.x_mm[i] = 0.0;
  double square = 0.0;
  for (int order = 5; order <= 50; ++order) square += std::norm(order_of(left, order));
  const auto diagnosis = result("out/diagnosis_1_specimen.json");
  const double texture2 = square / 46.0, threshold = diagnosis.at("threshold");
  for (const int order : {3, 4}) {
    const double lambda = 2.0 * std::norm(order_of(left, order)) / texture2;
    std::cout << order << " undulations: " << 1e3 * std::abs(order_of(left, order))
              << " um, texture " << 1e3 * std::sqrt(texture2) << " um, lambda " << lambda << " of "
              << threshold << '\n';
    EXPECT_LT(std::sqrt(lambda), std::sqrt(threshold) + 1.64);
    EXPECT_GT(2.0 * std::sqrt(lambda), std::sqrt(threshold) + 2.88);
  }
}

// The edges of scratches were six slips with the plain loss, and the axis was withheld. The two
// losses weigh the same readings otherwise: their centres differ by noise.
TEST_F(MeasuredJob, ScratchesAreNoSlipWithThePlainLossEither) {
  const CommandStreams done = command(
      "diagnose " + places::source() +
      "/data/measured/roundness_trace.csv --surface section --radius --nominal-radius-mm 14.5 "
      "--json plain.json");
  ASSERT_EQ(done.exit_code, 0) << done.out << done.err;
  const auto plain = result("plain.json");
  EXPECT_TRUE(plain.at("findings").empty());
  const auto& stated = plain.at("extended").at("axis");
  const double u = fit_.at("parameters").at("x0").at("u");
  EXPECT_NEAR(stated.at("x").at("value").get<double>(), axis("x"), 4.0 * u);
  EXPECT_NEAR(stated.at("y").at("value").get<double>(), axis("y"), 4.0 * u);
}

// Nothing found: there is no cross-validated gain, and none is claimed.
TEST_F(MeasuredJob, ClaimsNoGain) {
  const auto diagnosis = result("out/diagnosis_1_specimen.json");
  ASSERT_TRUE(diagnosis.at("findings").empty());
  EXPECT_EQ(diagnosis.at("gain").at("held_out_ratio").at("value"), 1.0);
  EXPECT_GT(diagnosis.at("noise").at("masked").size(), 50u);
}

}  // namespace
}  // namespace trueaxis::testing

// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <boost/math/distributions/binomial.hpp>
#include <boost/math/distributions/chi_squared.hpp>
#include <cmath>
#include <iostream>

#include "simulate/clean_stream.hpp"
#include "study/bound/quantities.hpp"
#include "support/dense.hpp"
#include "support/sweep_examples.hpp"
#include "trueaxis/units.hpp"

/// The bound of what can be known, and that fits reach it.
namespace trueaxis::study {
namespace {

using namespace virtual_lathe;
using testing::over;
using testing::probed_part;
using testing::run_all;
using testing::sweep_of;

constexpr std::uint64_t seed = 20261121;
constexpr double level =
    0.01;  // probability that an efficient engine fails a test, over all its cells

/// RMSE over the bound within χ², coverage of U (k = 2) within the binomial of 95.45 %; each cell
/// at level / tests.
void expect_efficient(const Sweep& sweep, double tests) {
  const Summary summary = summarise(sweep, run_all(sweep, 0));
  const bool gauge = sweep.base.probe.relative_zero_mm.has_value();
  const double tail = 0.5 * level / tests, n = static_cast<double>(sweep.repeats);
  const boost::math::chi_squared square(n);
  const double lowest = std::sqrt(quantile(square, tail) / n);
  const double highest = std::sqrt(quantile(complement(square, tail)) / n);
  for (const Row& row : summary.rows) {
    const std::string where = std::string(to_string(fitted_surface(sweep))) +
                              (" cell " + std::to_string(row.cell)) + " " + row.quantity;
    if (gauge && (row.quantity.starts_with("radius") || row.quantity == "k")) {  // not shown
      EXPECT_TRUE(std::isnan(row.bound)) << where;
      EXPECT_EQ(row.estimates, 0U) << where;
      continue;
    }
    ASSERT_EQ(row.estimates, sweep.repeats) << where;
    ASSERT_TRUE(std::isfinite(row.ratio)) << where;
    EXPECT_GE(row.ratio, lowest) << where;
    EXPECT_LE(row.ratio, highest) << where;
    const boost::math::binomial hits(n, std::erf(std::sqrt(2.0)));
    EXPECT_GE(row.coverage.value * n, quantile(hits, tail) - 1.0) << where;
    EXPECT_LE(row.coverage.value * n, quantile(complement(hits, tail)) + 1.0) << where;
  }
}

TEST(Bound, FitsReachTheBoundAndTheirUCovers) {
  std::cout << "seed " << seed << '\n';
  const std::vector<GridAxis> axes{over("pass.length_mm", {15.0, 30.0}),
                                   over("noise.sigma_mm", {0.001, 0.01}),
                                   over("part.x0_mm", {0.0, 0.4})};
  const double cells = 8.0, tests = 2.0 * cells * (11.0 + 9.0 + 3.0);
  expect_efficient(sweep_of(probed_part(PartKind::cone), axes, 1500, seed), tests);
  expect_efficient(sweep_of(probed_part(PartKind::cylinder), axes, 1500, seed), tests);
  std::vector<GridAxis> of_face = axes;
  of_face.pop_back();
  expect_efficient(sweep_of(probed_part(PartKind::face), of_face, 1500, seed), tests);
}

/// Clamped again, turned by 70° and shifted along Z, with another axis.
Scenario clamped_twice(PartKind kind) {
  Scenario scenario = probed_part(kind);
  Chucking again;
  again.number = 2, again.reindex_rad = 70.0 * rad_per_deg, again.z_shift_mm = -3.0;
  again.x0_mm = -0.12, again.y0_mm = 0.03, again.l = 9e-4, again.m = 2e-4;
  scenario.plan.setups = {again};
  scenario.plan.passes.push_back(scenario.plan.passes.front());
  scenario.plan.passes.back().setup = 2;
  return scenario;
}

/// A gauge that does not know the radius but has it stated, in the middle of what is probed.
Scenario with_gauge(Scenario scenario) {
  const Part& part = scenario.part;
  scenario.probe.relative_zero_mm = 28.7;
  scenario.probe.nominal_radius_mm = part.radius_mm;
  if (part.kind != PartKind::cone) return scenario;
  const CleanStream clean = simulate_clean(scenario);
  double low = 1e9, high = -1e9;
  for (std::size_t i = 0; i < clean.stream.size(); ++i) {
    const double at = clean.stream.position_mm[i] - set_up_of(clean.stream, i).z_shift_mm;
    low = std::min(low, at), high = std::max(high, at);
  }
  scenario.probe.nominal_radius_mm =
      (0.5 * (low + high) - *part.apex_mm) * std::tan(part.half_angle_rad);
  return scenario;
}

Scenario from_both_sides(Scenario scenario) {
  Chucking rear;
  rear.number = 2, rear.rear = true;
  scenario.plan.setups = {rear};
  scenario.plan.passes.push_back(scenario.plan.passes.front());
  scenario.plan.passes.back().setup = 2;
  return scenario;
}

TEST(Bound, IsReachedWithSeveralClampingsAndWithAGauge) {
  std::cout << "seed " << seed << '\n';
  constexpr std::size_t repeats = 1500;
  const std::vector<Scenario> cases{clamped_twice(PartKind::cone),
                                    clamped_twice(PartKind::cylinder),
                                    clamped_twice(PartKind::face),
                                    with_gauge(probed_part(PartKind::cone)),
                                    with_gauge(probed_part(PartKind::cylinder)),
                                    with_gauge(from_both_sides(probed_part(PartKind::cone))),
                                    with_gauge(clamped_twice(PartKind::cone)),
                                    with_gauge(clamped_twice(PartKind::cylinder))};
  const double tests = 2.0 * 11.0 * static_cast<double>(cases.size());
  for (std::size_t i = 0; i < cases.size(); ++i) {
    SCOPED_TRACE(i);
    expect_efficient(sweep_of(cases[i], {}, repeats, seed + i), tests);
  }
}

TEST(Bound, IsReachedByASection) {
  for (const PartKind kind : {PartKind::cylinder, PartKind::cone}) {
    Scenario scenario = probed_part(kind);
    scenario.plan.passes[0].end_mm = scenario.plan.passes[0].start_mm;
    scenario.plan.passes[0].revolutions = 20.0;
    Scenario twice = clamped_twice(kind);
    twice.plan.setups[0].z_shift_mm = 0.0;  // else a cone has two radii there
    for (PlannedPass& pass : twice.plan.passes)
      pass.end_mm = pass.start_mm, pass.revolutions = 20.0;
    // The centre of a tilted cone's section lies R slope tan off the axis.
    if (kind == PartKind::cone) {
      scenario.part.l = scenario.part.m = twice.part.l = twice.part.m = 0.0;
      twice.plan.setups[0].l = twice.plan.setups[0].m = 0.0;
    }
    for (const Scenario& one : {scenario, with_gauge(scenario), twice, with_gauge(twice)}) {
      Sweep sweep = sweep_of(one, {}, 1500, seed);
      sweep.surface = "section";
      expect_efficient(sweep, 2.0 * 8.0 * 3.0);
    }
  }
}

// Set-ups that the metadata call one clamping, with two axes: no surface of the model is that.
TEST(Bound, IsNotThereWhereTheAxisMovedUnsaid) {
  Scenario scenario = clamped_twice(PartKind::cylinder);
  scenario.plan.setups[0].reindex_rad = scenario.plan.setups[0].z_shift_mm = 0.0;
  const Bound bound = bound_of(scenario, SurfaceKind::cylinder);
  for (const double sd : bound.sd) EXPECT_TRUE(std::isnan(sd));
  EXPECT_EQ(bound.missing, Bound::Missing::axis_moves);
}

TEST(Bound, IsNotThereWithoutNoise) {
  Scenario scenario = probed_part(PartKind::cylinder);
  EXPECT_EQ(bound_of(scenario, SurfaceKind::cylinder).missing, Bound::Missing::nothing);
  scenario.noise = {};
  const Bound bound = bound_of(scenario, SurfaceKind::cylinder);
  EXPECT_TRUE(std::isnan(bound.sd.front()));
  EXPECT_EQ(bound.missing, Bound::Missing::no_noise);
  scenario.noise.quantisation_mm = 1e-3;  // rounding is noise
  EXPECT_EQ(bound_of(scenario, SurfaceKind::cylinder).missing, Bound::Missing::nothing);
}

TEST(Bound, KnowsTheKindOfNoise) {
  const auto sd = [](auto change) {
    Scenario scenario = probed_part(PartKind::cone);
    change(scenario.noise);
    return bound_of(scenario, surface_of(scenario.part.kind)).sd;
  };
  const std::vector<double> white = sd([](Noise&) {});
  const auto ratio = [&](const std::vector<double>& of, std::size_t i) { return of[i] / white[i]; };
  const std::vector<double> twice = sd([](Noise& noise) { noise.sigma_mm *= 2.0; });
  const std::vector<double> student = sd([](Noise& noise) { noise.student_dof = 3.0; });
  const std::vector<double> uniform = sd([](Noise& noise) {
    noise.uniform_mm = std::sqrt(3.0) * noise.sigma_mm;
    noise.sigma_mm = 0.0;
  });
  const std::vector<double> both =
      sd([](Noise& noise) { noise.uniform_mm = std::sqrt(3.0) * noise.sigma_mm; });
  for (std::size_t i = 0; i < white.size(); ++i) {
    EXPECT_NEAR(ratio(twice, i), 2.0, 1e-9) << i;
    // Fisher information of t with ν: (ν + 1)/(ν + 3) over scale²; scale² = σ² (ν − 2)/ν.
    EXPECT_NEAR(ratio(student, i), std::sqrt((1.0 / 3.0) * (6.0 / 4.0)), 1e-9) << i;
    EXPECT_NEAR(ratio(uniform, i), 1.0, 1e-9) << i;  // the same variance, Gauss-Markov
    EXPECT_NEAR(ratio(both, i), std::sqrt(2.0), 1e-9) << i;
  }
}

/// Standard deviations with noise of these correlations and a uniform part, by the covariance
/// matrix written out and inverted.
Eigen::VectorXd sd_written_out(const Scenario& scenario, const std::vector<double>& correlation) {
  const CleanStream clean = simulate_clean(scenario);
  const auto n = static_cast<Eigen::Index>(clean.value_mm.size());
  Eigen::MatrixXd jacobian(n, 3), covariance(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {  // z = d − l x − m y to first order
    const double x = clean.stream.position_mm[static_cast<std::size_t>(i)];
    const double c = clean.stream.c_rad[static_cast<std::size_t>(i)];
    jacobian.row(i) << -x * std::cos(c), -x * std::sin(c), 1.0;
    for (Eigen::Index j = 0; j < n; ++j)
      covariance(i, j) = std::pow(scenario.noise.sigma_mm, 2) *
                         correlation[static_cast<std::size_t>(std::abs(i - j))];
    covariance(i, i) += std::pow(scenario.noise.uniform_mm, 2) / 3.0;
  }
  const Eigen::MatrixXd white = dense::solve_lower(dense::cholesky(covariance), jacobian);
  return dense::inverse(white.transpose() * white).diagonal().cwiseSqrt();
}

TEST(Bound, WhitensAsTheInverseCovarianceDoes) {
  Scenario scenario = probed_part(PartKind::face);
  scenario.part.l = scenario.part.m = 0.0;
  scenario.plan.passes[0].end_mm = 20.0;
  const std::size_t n = simulate_clean(scenario).value_mm.size();
  struct Case {
    std::vector<double> phi;
    double uniform_mm;
  };
  for (const Case& one :
       {Case{{0.7}, 0.004}, {{0.7}, 0.0}, {{1.2, -0.5}, 0.0}, {{1.2, -0.5}, 0.004}}) {
    scenario.noise.autoregression = one.phi, scenario.noise.uniform_mm = one.uniform_mm;
    // Yule and Walker: c_k = Σ φ_j c_{|k − j|}, c_0 = 1.
    const double second = one.phi.size() > 1 ? one.phi[1] : 0.0;
    std::vector<double> correlation{1.0, one.phi[0] / (1.0 - second)};
    while (correlation.size() < n) {
      const std::size_t k = correlation.size();
      correlation.push_back(one.phi[0] * correlation[k - 1] + second * correlation[k - 2]);
    }
    const Eigen::VectorXd expected = sd_written_out(scenario, correlation);
    const Bound bound = bound_of(scenario, SurfaceKind::plane);
    EXPECT_EQ(bound.kind,
              one.uniform_mm > 0.0 ? Bound::Kind::gauss_markov : Bound::Kind::cramer_rao);
    for (std::size_t i = 0; i < 3; ++i)
      EXPECT_NEAR(bound.sd[i] / expected(static_cast<Eigen::Index>(i)), 1.0, 1e-7) << i;
  }
  scenario.noise.autoregression = {}, scenario.noise.rho = 0.7;
  const std::vector<double> by_rho = bound_of(scenario, SurfaceKind::plane).sd;
  scenario.noise.autoregression = {0.7}, scenario.noise.rho = 0.0;
  EXPECT_EQ(by_rho, bound_of(scenario, SurfaceKind::plane).sd);
  scenario.noise.autoregression = {1.2, -0.1};
  EXPECT_EQ(bound_of(scenario, SurfaceKind::plane).missing, Bound::Missing::not_stationary);
  for (const double sd : bound_of(scenario, SurfaceKind::plane).sd) EXPECT_TRUE(std::isnan(sd));
}

// A tilted cylinder at one Z: x0 and l are one but for what the tilt makes of the section's shape,
// so that readings of 50 µm place the axis to some mm.
TEST(Bound, IsNotThereWhereItIsBeyondWhatDerivativesSay) {
  Scenario scenario = probed_part(PartKind::cylinder);
  scenario.plan.passes[0].end_mm = scenario.plan.passes[0].start_mm;
  scenario.plan.passes[0].revolutions = 20.0;
  scenario.noise.sigma_mm = 0.05;
  const Bound bound = bound_of(scenario, SurfaceKind::cylinder);
  ASSERT_FALSE(bound.sd.empty());
  for (const double sd : bound.sd) EXPECT_TRUE(std::isnan(sd));
}

TEST(Bound, IsNotThereWhereTheReadingsDoNotDetermineTheParameters) {
  Scenario scenario = probed_part(PartKind::cylinder);
  scenario.part.l = scenario.part.m = 0.0;
  scenario.plan.passes[0].end_mm = scenario.plan.passes[0].start_mm;  // one section: no tilt
  scenario.plan.passes[0].revolutions = 20.0;
  const Bound bound = bound_of(scenario, surface_of(scenario.part.kind));
  ASSERT_FALSE(bound.sd.empty());
  for (const double sd : bound.sd) EXPECT_TRUE(std::isnan(sd));
  EXPECT_EQ(bound.missing, Bound::Missing::not_determined);
}

}  // namespace
}  // namespace trueaxis::study

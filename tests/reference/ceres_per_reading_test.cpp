// SPDX-License-Identifier: Apache-2.0
#include <ceres/ceres.h>
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <iostream>
#include <ostream>
#include <string>
#include <vector>

#include "bench/peers_ceres.hpp"
#include "reference/lateral_stream.hpp"
#include "trueaxis/fit.hpp"
#include "trueaxis/units.hpp"

/// The engine gives Ceres one small block made of the normal matrix; here Ceres gets every reading
/// as a residual of its own, with AutoDiff and a model that shares no code with the engine.
namespace trueaxis::reference {
namespace {

// The project's number. A cost in double is flat to 1e-16 within σ·√(2e-16) = 1.4e-10 mm (σ = 10
// µm) of its minimum in a well-determined length, so it can be reached.
constexpr double same_minimum_mm = 1e-9;

struct Case {
  const char* surface;
  std::vector<double> part, nominal;  // the parameters of peers_ceres.hpp
  ProbeStream (*simulate)(const std::vector<double>&, const Helix&, std::uint64_t);
  void (*add)(ceres::Problem&, const ProbeStream&, double*, ceres::LossFunction*);
  bool position = true;
};

template <typename Residual>
Case make_case(const char* surface, std::vector<double> part, std::vector<double> nominal) {
  return {surface, std::move(part), std::move(nominal), simulate<Residual>,
          peer::add_readings<Residual>};
}

std::vector<Case> cases() {
  // Constantin et al.'s Table 1, once with the apex above the data and once, opening the other way,
  // below them; a cylinder; a circle that is far off-centre.
  const double half = 15.5 * rad_per_deg;
  std::vector<Case> all = {
      make_case<peer::ConeResidual>("cone", {0.05, 0.1, 2e-4, 9e-4, 402.0, half},
                                    {0.0, 0.0, 0.0, 0.0, 400.0, 15.0 * rad_per_deg}),
      make_case<peer::ConeResidual>("cone", {0.05, 0.1, 2e-4, 9e-4, -150.0, half},
                                    {0.0, 0.0, 0.0, 0.0, -149.0, 15.0 * rad_per_deg}),
      make_case<peer::CylinderResidual>("cylinder", {-0.3, 0.2, 1e-3, -2e-3, 40.0},
                                        {0.0, 0.0, 0.0, 0.0, 39.0}),
      make_case<peer::SectionResidual>("section", {2.0, -3.0, 25.0}, {0.0, 0.0, 24.0})};
  all.back().position = false;
  return all;
}

void PrintTo(const Case& c, std::ostream* out) { *out << c.surface << " of " << c.part.back(); }

/// Well-determined lengths, mm: k and the half angle as the radius at mid length and a slope.
std::vector<double> lengths_mm(std::vector<double> p, double length_mm) {
  if (p.size() < 5) return p;
  const double n = std::sqrt(1.0 - p[2] * p[2] - p[3] * p[3]);
  p[2] *= length_mm;
  p[3] *= length_mm;
  if (p.size() == 6) {
    p[4] = (p[4] - 0.5 * length_mm / n) * std::tan(p[5]);
    p[5] *= length_mm;
  }
  return p;
}

std::vector<double> engine_parameters(const FitResult& result) {
  std::vector<double> p;
  for (const FitParameter& parameter : result.parameters) {
    p.push_back(parameter.estimate.value);
  }
  return p;
}

/// Ceres goes by the cost, which is flat to rounding within some 1e-9 mm of a robust minimum; its
/// own gradient is not: Gauss-Newton steps on the robustified Jacobian from there, until they
/// vanish.
void follow_gradient(ceres::Problem& problem, std::vector<double>& p) {
  const auto n = static_cast<Eigen::Index>(p.size());
  for (int step = 0; step < 40; ++step) {
    std::vector<double> gradient;
    ceres::CRSMatrix sparse;
    problem.Evaluate({}, nullptr, nullptr, &gradient, &sparse);
    const Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>
        jacobian(sparse.values.data(), sparse.num_rows, n);
    const Eigen::VectorXd scale = jacobian.colwise().norm().cwiseInverse();
    const Eigen::MatrixXd scaled = jacobian * scale.asDiagonal();
    const Eigen::VectorXd g =
        scale.asDiagonal() * Eigen::Map<const Eigen::VectorXd>(gradient.data(), n);
    const Eigen::VectorXd change =
        scale.asDiagonal() * (scaled.transpose() * scaled).ldlt().solve(g);
    for (Eigen::Index i = 0; i < n; ++i) p[static_cast<std::size_t>(i)] -= change(i);
  }
}

std::vector<double> solve_per_reading(const Case& c, const ProbeStream& stream,
                                      std::vector<double> p, ceres::LossFunction* loss) {
  ceres::Problem::Options keep;
  keep.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  ceres::Problem problem(keep);
  c.add(problem, stream, p.data(), loss);
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.initial_trust_region_radius = 1e16;
  options.max_num_iterations = 500;
  options.function_tolerance = 0.0;
  options.gradient_tolerance = 0.0;
  options.parameter_tolerance = 1e-15;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  EXPECT_TRUE(summary.IsSolutionUsable()) << summary.BriefReport();
  follow_gradient(problem, p);
  return p;
}

class CeresPerReading : public testing::TestWithParam<Case> {
 protected:
  ProbeStream simulate(double outlier_share) const {
    Helix helix;
    helix.outlier_share = outlier_share;
    helix.position = GetParam().position;
    constexpr std::uint64_t seed = 12;
    std::cout << "seed " << seed << '\n';
    return GetParam().simulate(GetParam().part, helix, seed);
  }

  FitOptions options_for(Loss loss) const {
    FitOptions options;
    options.surface = surface_from_id(GetParam().surface);
    options.loss = loss;
    return options;
  }

  void expect_same(const FitResult& result, const std::vector<double>& p) const {
    ASSERT_EQ(result.status, FitStatus::converged) << result.message;
    const std::vector<double> engine = lengths_mm(engine_parameters(result), Helix{}.length_mm);
    const std::vector<double> ceres = lengths_mm(p, Helix{}.length_mm);
    ASSERT_EQ(engine.size(), ceres.size());
    for (std::size_t i = 0; i < engine.size(); ++i) {
      EXPECT_NEAR(engine[i], ceres[i], same_minimum_mm) << result.parameters[i].name;
    }
  }

  /// Ceres with `RobustLoss` at the engine's scale, from the minimum of least squares.
  template <typename RobustLoss>
  void expect_same_robust(Loss loss, double threshold_sigma) const {
    const ProbeStream stream = simulate(0.02);
    const FitResult result = fit(stream, options_for(loss));
    ASSERT_GT(result.sigma_mm, 0.0);
    RobustLoss robust(threshold_sigma * result.sigma_mm);
    std::vector<double> p = solve_per_reading(GetParam(), stream, GetParam().nominal, nullptr);
    p = solve_per_reading(GetParam(), stream, std::move(p), &robust);
    expect_same(result, p);
  }
};

TEST_P(CeresPerReading, LeastSquaresHasTheSameMinimum) {
  const ProbeStream stream = simulate(0.0);
  const FitResult result = fit(stream, options_for(Loss::plain));
  expect_same(result, solve_per_reading(GetParam(), stream, GetParam().nominal, nullptr));
}

TEST_P(CeresPerReading, HuberHasTheSameMinimumAtTheSameScale) {
  expect_same_robust<ceres::HuberLoss>(Loss::huber, 1.345);
}

TEST_P(CeresPerReading, TukeyHasTheSameMinimumAtTheSameScale) {
  expect_same_robust<ceres::TukeyLoss>(Loss::tukey, 4.685);
}

INSTANTIATE_TEST_SUITE_P(Surfaces, CeresPerReading, testing::ValuesIn(cases()),
                         [](const testing::TestParamInfo<Case>& test) {
                           return std::string(test.param.surface) + std::to_string(test.index);
                         });

}  // namespace
}  // namespace trueaxis::reference

// SPDX-License-Identifier: Apache-2.0
#include <ceres/cost_function.h>
#include <ceres/iteration_callback.h>
#include <ceres/problem.h>
#include <ceres/solver.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "fit/associate.hpp"
#include "math/linear_algebra.hpp"

namespace trueaxis {
namespace {

// The sizes of one clamping are bounded, so that nothing is allocated in the hot path; several
// clampings together have no bound (Most = Eigen::Dynamic).
template <int Most>
using Square = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor, Most, Most>;
template <int Most>
using Column = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, Most, 1>;
constexpr int one_clamping = static_cast<int>(max_parameters);

constexpr double least_curvature = 0.3;  // below, readings without weight drive the model

/// The factor R of JᵀJ = RᵀR and z = R⁻ᵀ Jᵀr; a singular matrix gets a factor of its own rank.
template <int Most>
/// Eq. 21.
void factorise(const NormalMatrix& normal, Square<Most>& r, Column<Most>& z) {
  using Matrix = Square<Most>;
  using Vector = Column<Most>;
  const auto p = static_cast<Eigen::Index>(normal.parameters);
  const Eigen::Map<const Matrix> h(normal.jtj.data(), p, p);
  const Eigen::Map<const Vector> g(normal.jtr.data(), p);
  const Vector d = h.diagonal().cwiseMax(std::numeric_limits<double>::min()).cwiseSqrt();
  const Matrix scaled = d.cwiseInverse().asDiagonal() * h * d.cwiseInverse().asDiagonal();
  const Vector scaled_g = d.cwiseInverse().asDiagonal() * g;
  const Eigen::LLT<Matrix> llt(scaled);
  const double smallest = llt.matrixLLT().diagonal().cwiseAbs().minCoeff();
  if (llt.info() == Eigen::Success &&
      smallest > 1e-6) {  // pivots of a unit-diagonal matrix: cond < 1e12
    z = llt.matrixL().solve(scaled_g);
    r = Matrix(llt.matrixU()) * d.asDiagonal();
    return;
  }
  const linear::Spectrum of = linear::spectrum(scaled);
  const Eigen::VectorXd root = of.values.cwiseMax(0.0).cwiseSqrt();
  const Eigen::VectorXd inverse =
      (of.values.array() > 1e-15 * of.values.maxCoeff()).select(root.cwiseInverse(), 0.0);
  const Eigen::MatrixXd directions = of.vectors.transpose();
  z = linear::scaled_rows(inverse, directions) * Eigen::VectorXd(scaled_g);
  r = linear::scaled_columns(linear::scaled_rows(root, directions), d);
}

/// The whole stream as one block of p + 1 residuals. Evaluated points are remembered: Ceres asks
/// for the cost of a candidate first and, if it accepts it, for the Jacobian at the same point.
template <int Most>
/// Eq. 22.
class CompressedCost final : public ceres::CostFunction {
  using Matrix = Square<Most>;
  using Vector = Column<Most>;

 public:
  CompressedCost(const JointModel& model, const LossScale& loss) : model_(model), loss_(loss) {
    set_num_residuals(static_cast<int>(model.parameter_count()) + 1);
    mutable_parameter_block_sizes()->push_back(static_cast<int32_t>(model.parameter_count()));
  }

  bool Evaluate(const double* const* parameters, double* residuals,
                double** jacobians) const override {
    const std::size_t p = model_.parameter_count();
    const std::span<const double> working(parameters[0], p);
    if (!std::ranges::equal(working, last_.working)) {
      if (!predict(working)) {
        last_.normal = model_.accumulate(working, loss_);
        ++passes_;
      }
      last_.working.assign(working.begin(), working.end());
      if (last_.normal.valid &&
          (!best_.normal.valid || last_.normal.sum_rho <= best_.normal.sum_rho))
        best_ = last_;
    }
    if (!last_.normal.valid) return false;
    Matrix r;
    Vector z;
    factorise<Most>(last_.normal, r, z);
    const double root = std::sqrt(hessian_scale(last_.normal, z.squaredNorm()));
    r *= root;
    z /= root;
    const auto rows = static_cast<Eigen::Index>(p);
    Eigen::Map<Vector>(residuals, rows) = z;
    residuals[p] = std::sqrt(std::max(0.0, last_.normal.sum_rho - z.squaredNorm()));
    if (jacobians != nullptr && jacobians[0] != nullptr) {
      Eigen::Map<Matrix>(jacobians[0], rows, rows) = -r;
      std::fill_n(jacobians[0] + p * p, p, 0.0);
    }
    return true;
  }

  /// The Hessian of a robust loss over JᵀWJ, which is at most 1, kept where the model stays convex
  /// and below the cost.
  static double hessian_scale(const NormalMatrix& normal, double reach) {
    const double scale = std::max(normal.curvature, least_curvature);
    return reach < scale * normal.sum_rho ? scale : 1.0;
  }

  /// A step whose predicted gain is below `negligible` is not worth a pass: at that distance the
  /// quadratic model of the last pass is exact to rounding (its error is the step squared over the
  /// radius).
  bool predict(std::span<const double> working) const {
    if (!last_.normal.valid) return false;
    const auto p = static_cast<Eigen::Index>(working.size());
    const Eigen::Map<const Matrix> h(last_.normal.jtj.data(), p, p);
    const Eigen::Map<const Vector> g(last_.normal.jtr.data(), p);
    const Vector step = Eigen::Map<const Vector>(working.data(), p) -
                        Eigen::Map<const Vector>(last_.working.data(), p);
    const Vector h_step = std::max(last_.normal.curvature, least_curvature) * (h * step);
    const double change = step.dot(h_step) - 2.0 * g.dot(step);
    if (std::abs(change) > negligible * last_.normal.sum_rho) return false;
    last_.normal.sum_rho += change;
    for (Eigen::Index i = 0; i < p; ++i) last_.normal.jtr[static_cast<std::size_t>(i)] -= h_step(i);
    return true;
  }

  /// The first evaluation, made before Ceres, which would log its failure.
  bool meets_all_lines(const std::vector<double>& start) const {
    std::vector<double> unused(start.size() + 1);
    const double* const parameters = start.data();
    return Evaluate(&parameters, unused.data(), nullptr);
  }

  const Minimum& best() const { return best_; }
  int passes() const { return passes_; }

 private:
  const JointModel& model_;
  const LossScale loss_;
  static constexpr double negligible = 1e-9;  // of the cost: a step of 3e-5 of the noise
  mutable Minimum last_, best_;
  mutable int passes_ = 0;
};

/// Ends at the rounding of the data themselves: below it a noise-free cost only flickers.
class RoundingFloor final : public ceres::IterationCallback {
 public:
  explicit RoundingFloor(double cost) : cost_(cost) {}
  ceres::CallbackReturnType operator()(const ceres::IterationSummary& summary) override {
    return summary.cost <= cost_ ? ceres::SOLVER_TERMINATE_SUCCESSFULLY : ceres::SOLVER_CONTINUE;
  }

 private:
  double cost_;
};

double largest_reading(const JointModel& model) {
  double largest = 0.0;
  for (const JointPart& part : model.parts()) {
    const ReadingBlock first = part.prepared->block(0);
    for (std::size_t i = 0; i < part.prepared->filled(0); ++i)
      largest = std::max(largest, std::abs(first.reading_mm[i]));
  }
  return largest;
}

template <int Most>
Minimum minimise_sized(const JointModel& model, std::vector<double> start, const LossScale& loss,
                       int max_iterations) {
  CompressedCost<Most> cost(model, loss);
  if (!cost.meets_all_lines(start)) {
    Minimum missed;
    missed.working = std::move(start);
    missed.iterations = cost.passes();
    return missed;
  }
  ceres::Problem::Options ownership;
  ownership.cost_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  ceres::Problem problem(ownership);
  problem.AddResidualBlock(&cost, nullptr, start.data());

  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.max_num_iterations = max_iterations;
  options.initial_trust_region_radius =
      1e12;  // Gauss-Newton until a step fails: the start is close
  options.max_trust_region_radius = 1e32;
  // A step that changes the cost by less is below 1e-6 of the noise. The point it leads to (which
  // is kept, see best()) is closer by the factor noise / radius again.
  options.function_tolerance = 1e-12;
  options.parameter_tolerance = 1e-15;
  options.gradient_tolerance = 1e-300;
  options.logging_type = ceres::SILENT;
  const double rounding = 4.0 * std::numeric_limits<double>::epsilon() * largest_reading(model);
  RoundingFloor floor(0.5 * static_cast<double>(model.size()) * rounding * rounding);
  options.callbacks.push_back(&floor);
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);

  Minimum minimum = cost.best();
  minimum.iterations = cost.passes();
  minimum.converged = minimum.normal.valid && (summary.termination_type == ceres::CONVERGENCE ||
                                               summary.termination_type == ceres::USER_SUCCESS);
  return minimum;
}

}  // namespace

Minimum minimise(const JointModel& model, std::vector<double> start, const LossScale& loss,
                 int max_iterations) {
  return model.clampings() == 1
             ? minimise_sized<one_clamping>(model, std::move(start), loss, max_iterations)
             : minimise_sized<Eigen::Dynamic>(model, std::move(start), loss, max_iterations);
}

void polish(const JointModel& model, const LossScale& loss, Minimum& minimum) {
  constexpr int most = 12;            // each step gains a digit at least
  constexpr double enough = 1e-18;    // relative gain of the cost: a step of 1e-9 of the noise
  constexpr double rounding = 1e-12;  // relative: a cost that rises by more is a step gone wrong
  const auto p = static_cast<Eigen::Index>(minimum.working.size());
  minimum.normal = model.accumulate(minimum.working, loss);  // its last step was predicted
  ++minimum.iterations;
  for (int i = 0; i < most && minimum.normal.valid; ++i) {
    Square<Eigen::Dynamic> r;
    Eigen::VectorXd z;
    factorise<Eigen::Dynamic>(minimum.normal, r, z);
    const double curvature = std::max(minimum.normal.curvature, least_curvature);
    if (z.squaredNorm() / curvature <= enough * minimum.normal.sum_rho) return;
    const Eigen::VectorXd step = linear::pivoted_least_squares(r, z) / curvature;
    Minimum next = minimum;
    for (Eigen::Index j = 0; j < p; ++j) next.working[static_cast<std::size_t>(j)] += step(j);
    next.normal = model.accumulate(next.working, loss);
    if (!next.normal.valid || next.normal.sum_rho > (1.0 + rounding) * minimum.normal.sum_rho)
      return;
    ++next.iterations;
    minimum = std::move(next);
  }
}

}  // namespace trueaxis

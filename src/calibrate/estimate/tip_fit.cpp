// SPDX-License-Identifier: Apache-2.0
#include "calibrate/estimate/tip_fit.hpp"

#include <ceres/cost_function.h>
#include <ceres/problem.h>
#include <ceres/solver.h>

#include <algorithm>
#include <cmath>

#include "math/linear_algebra.hpp"

namespace trueaxis::calibrate_detail {
namespace {

constexpr double takes_part = 0.1;  // of the largest member
constexpr double rank_of_places = 1e-9;

/// Orthonormal columns, to which one is added at a time.
class Basis {
 public:
  Basis(const MatrixXd& first, Index room) : q_(first.rows(), first.cols() + room) {
    if (first.cols() == 0) return;
    const MatrixXd basis = linear::orthonormal_basis(first, rank_of_places);
    size_ = basis.cols();
    q_.leftCols(size_) = basis;
  }
  VectorXd beside(VectorXd v) const {
    for (int twice = 0; twice < 2; ++twice)
      v -= q_.leftCols(size_) * (q_.leftCols(size_).transpose() * v);
    return v;
  }
  void add(const VectorXd& left) { q_.col(size_++) = left.normalized(); }
  bool full() const { return size_ == q_.rows(); }

 private:
  MatrixXd q_;
  Index size_ = 0;
};

MatrixXd columns(const MatrixXd& of, const std::vector<std::size_t>& which) {
  MatrixXd out(of.rows(), static_cast<Index>(which.size()));
  for (std::size_t k = 0; k < which.size(); ++k)
    out.col(static_cast<Index>(k)) = of.col(static_cast<Index>(which[k]));
  return out;
}

/// Which of the kept unknowns make up the column of a held one, and whether the places do.
void explain(Held& held, const MatrixXd& unknowns, const MatrixXd& places,
             const std::vector<std::size_t>& kept, double tells) {
  MatrixXd all(unknowns.rows(), places.cols() + static_cast<Index>(kept.size()));
  all << places, columns(unknowns, kept);
  const VectorXd column = unknowns.col(static_cast<Index>(held.unknown));
  const VectorXd share = linear::least_squares(all, column);
  const double least = std::max(tells, takes_part * column.norm());
  held.places = (places * share.head(places.cols())).norm() >= least;
  for (std::size_t k = 0; k < kept.size(); ++k) {
    const Index c = places.cols() + static_cast<Index>(k);
    if (std::abs(share[c]) * all.col(c).norm() >= least) held.alike.push_back(kept[k]);
  }
}

/// The direction of least effect among the kept ones: its σ, and its members.
double weakest(const MatrixXd& beside_places, VectorXd& direction) {
  const linear::Spectrum of = linear::spectrum(linear::gram(beside_places));
  direction = of.vectors.col(0);
  return std::sqrt(std::max(0.0, of.values[0]));
}

}  // namespace

Determined determine(const MatrixXd& unknowns, const MatrixXd& places, double tells) {
  Determined out;
  Basis basis(places, unknowns.cols());
  const Basis of_places = basis;
  for (Index j = 0; j < unknowns.cols(); ++j) {
    const VectorXd left = basis.beside(unknowns.col(j));
    if (!basis.full() && left.norm() >= tells) {
      basis.add(left);
      out.kept.push_back(static_cast<std::size_t>(j));
    } else {
      out.held.push_back({static_cast<std::size_t>(j), {}, false, unknowns.col(j).norm()});
    }
  }
  MatrixXd beside(unknowns.rows(), unknowns.cols());
  for (Index j = 0; j < unknowns.cols(); ++j) beside.col(j) = of_places.beside(unknowns.col(j));
  VectorXd direction;
  while (!out.kept.empty()) {
    if (weakest(columns(beside, out.kept), direction) >= tells) break;
    const double part = 0.3 * direction.cwiseAbs().maxCoeff();
    std::size_t last = out.kept.size() - 1;
    while (std::abs(direction[static_cast<Index>(last)]) < part) --last;
    const std::size_t unknown = out.kept[last];
    out.kept.erase(out.kept.begin() + static_cast<std::ptrdiff_t>(last));
    out.held.push_back({unknown, {}, false, unknowns.col(static_cast<Index>(unknown)).norm()});
  }
  for (Held& held : out.held) explain(held, unknowns, places, out.kept, tells);
  std::ranges::sort(out.held, {}, &Held::unknown);
  return out;
}

namespace {

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

std::vector<Unknown> kept_of(const std::vector<Unknown>& unknowns, const Determined& determined) {
  std::vector<Unknown> kept;
  for (const std::size_t k : determined.kept) kept.push_back(unknowns[k]);
  return kept;
}

/// Residuals over σ as a function of kept unknowns over their largest size, and of the places.
class Chain final : public ceres::CostFunction {
 public:
  Chain(const Problem& problem, const ErrorModel& given, const std::vector<Unknown>& kept)
      : problem_(problem), given_(given), kept_(kept) {
    set_num_residuals(static_cast<int>(problem.equations));
    mutable_parameter_block_sizes()->push_back(static_cast<int>(size()));
  }

  Index size() const { return static_cast<Index>(kept_.size()) + problem_.places; }

  ErrorModel errors(const double* at) const {
    VectorXd values(static_cast<Index>(kept_.size()));
    for (Index j = 0; j < values.size(); ++j)
      values[j] = at[j] * kept_[static_cast<std::size_t>(j)].largest;
    return with(given_, kept_, values);
  }
  VectorXd places(const double* at) const {
    return Eigen::Map<const VectorXd>(at + kept_.size(), problem_.places);
  }

  bool Evaluate(const double* const* parameters, double* residuals,
                double** jacobians) const override {
    const ErrorModel now = errors(parameters[0]);
    const VectorXd at = places(parameters[0]);
    Eigen::Map<VectorXd>(residuals, problem_.equations) =
        problem_.weights.cwiseProduct(problem_.residuals(now, at));
    if (jacobians != nullptr && jacobians[0] != nullptr)
      Eigen::Map<RowMajor>(jacobians[0], problem_.equations, size()) =
          -weighted_jacobian(problem_, now, kept_, at);
    return true;
  }

 private:
  const Problem& problem_;
  const ErrorModel& given_;
  const std::vector<Unknown>& kept_;
};

/// The places of read-outs are means, which they begin at.
bool is_solved(const Problem& problem) { return problem.read_outs(); }

/// @returns what Ceres says where it did not converge, else ""
std::string minimise(Chain& chain, VectorXd& at) {
  ceres::Problem::Options ownership;
  ownership.cost_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  ceres::Problem problem(ownership);
  problem.AddResidualBlock(&chain, nullptr, at.data());
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.max_num_iterations = 50;
  options.initial_trust_region_radius = 1e8;  // near a Gauss-Newton step from the start
  options.function_tolerance = 1e-12;
  options.parameter_tolerance = 1e-14;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  return summary.termination_type == ceres::CONVERGENCE ? "" : summary.message;
}

}  // namespace

void weigh(const Problem& problem, MatrixXd& columns) {
  columns = linear::scaled_rows(problem.weights, columns);
}

MatrixXd weighted_jacobian(const Problem& problem, const ErrorModel& errors,
                           const std::vector<Unknown>& kept, const VectorXd& places) {
  MatrixXd all(problem.equations, static_cast<Index>(kept.size()) + problem.places);
  all << problem.jacobian(errors, kept, places), problem.places_jacobian(errors, places);
  for (std::size_t j = 0; j < kept.size(); ++j) all.col(static_cast<Index>(j)) *= kept[j].largest;
  weigh(problem, all);
  return all;
}

VectorXd best_places(const Problem& problem, const ErrorModel& errors) {
  const std::vector<Unknown> none;
  Chain chain(problem, errors, none);
  VectorXd at = problem.start;
  if (!is_solved(problem)) minimise(chain, at);
  return at;
}

Solution solve(const Problem& problem, const ErrorModel& given,
               const std::vector<Unknown>& unknowns) {
  Solution out;
  const MatrixXd first = weighted_jacobian(problem, given, unknowns, problem.start);
  const auto count = static_cast<Index>(unknowns.size());
  out.determined = determine(first.leftCols(count), first.rightCols(problem.places));
  const std::vector<Unknown> kept = kept_of(unknowns, out.determined);
  Chain chain(problem, given, kept);
  VectorXd at = VectorXd::Zero(chain.size());
  at.tail(problem.places) = problem.start;
  if (!is_solved(problem)) out.message = minimise(chain, at);
  out.converged = out.message.empty();
  out.places = chain.places(at.data());
  out.unknowns = VectorXd::Zero(count);
  for (std::size_t j = 0; j < kept.size(); ++j)
    out.unknowns[static_cast<Index>(out.determined.kept[j])] =
        at[static_cast<Index>(j)] * kept[j].largest;
  const ErrorModel errors = chain.errors(at.data());
  out.residuals = problem.weights.cwiseProduct(problem.residuals(errors, out.places));
  out.jacobian = weighted_jacobian(problem, errors, kept, out.places);
  out.freedom = static_cast<double>(problem.equations - chain.size());
  if (out.freedom > 0.0) out.variance = out.residuals.squaredNorm() / out.freedom;
  return out;
}

}  // namespace trueaxis::calibrate_detail

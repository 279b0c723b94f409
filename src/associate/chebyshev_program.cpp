// SPDX-License-Identifier: Apache-2.0
#include "associate/chebyshev_program.hpp"

#include <Eigen/LU>
#include <cmath>
#include <limits>

#include "math/linear_algebra.hpp"

namespace trueaxis {
namespace {

/// Columns of the dual: the rows of the program (a, 1), then e_k and −e_k of the box.
class Dual {
 public:
  Dual(const ChebyshevProgram& program, double reach)
      : program_(program), reach_(reach), m_(program.a.rows()), n_(program.a.cols()) {}

  Eigen::VectorXd column(Eigen::Index j) const {
    Eigen::VectorXd out = Eigen::VectorXd::Zero(n_ + 1);
    if (j < m_) {
      out.head(n_) = program_.a.row(j).transpose();
      out[n_] = 1.0;
    } else {
      out[(j - m_) % n_] = j - m_ < n_ ? 1.0 : -1.0;
    }
    return out;
  }
  double cost(Eigen::Index j) const { return j < m_ ? program_.g[j] : -reach_; }

  /// A basis that is feasible: the largest g, the box against its slope.
  std::vector<Eigen::Index> first_basis() const {
    Eigen::Index top = 0;
    program_.g.maxCoeff(&top);
    std::vector<Eigen::Index> basis;
    for (Eigen::Index k = 0; k < n_; ++k)
      basis.push_back(m_ + k + (program_.a(top, k) > 0.0 ? n_ : 0));
    basis.push_back(top);
    return basis;
  }

  /// The column that gains most (the first one that gains, when `careful`); -1: none.
  Eigen::Index entering(const Eigen::VectorXd& step, double h, double tolerance, bool careful) {
    gain_.noalias() = program_.g + program_.a * step;
    Eigen::Index best = -1;
    double most = tolerance;
    const auto offer = [&](Eigen::Index j, double gain) {
      if (gain > most && !(careful && best >= 0)) best = j, most = gain;
    };
    for (Eigen::Index j = 0; j < m_; ++j) offer(j, gain_[j] - h);
    for (Eigen::Index k = 0; k < n_; ++k) {
      offer(m_ + k, step[k] - reach_);
      offer(m_ + n_ + k, -step[k] - reach_);
    }
    return best;
  }
  Eigen::Index rows() const { return m_; }
  Eigen::Index unknowns() const { return n_; }

 private:
  const ChebyshevProgram& program_;
  double reach_;
  Eigen::Index m_, n_;
  Eigen::VectorXd gain_;
};

}  // namespace

ChebyshevSolution solve(const ChebyshevProgram& program, double reach, double tolerance) {
  Dual dual(program, reach);
  const Eigen::Index n = dual.unknowns();
  std::vector<Eigen::Index> basis = dual.first_basis();
  ChebyshevSolution out;
  Eigen::MatrixXd b(n + 1, n + 1);
  Eigen::VectorXd cost(n + 1);
  const Eigen::VectorXd one = Eigen::VectorXd::Unit(n + 1, n);
  constexpr int quick = 400, most = 4000;  // after `quick` exchanges by Bland's rule: no cycles
  for (int exchange = 0; exchange < most; ++exchange) {
    for (Eigen::Index i = 0; i <= n; ++i) {
      b.col(i) = dual.column(basis[static_cast<std::size_t>(i)]);
      cost[i] = dual.cost(basis[static_cast<std::size_t>(i)]);
    }
    const linear::Triangles lu(b);
    const Eigen::VectorXd lambda = lu.solve(one), y = lu.solve_transposed(cost);
    out.step = -y.head(n);
    out.h = y[n];
    const Eigen::Index in = dual.entering(out.step, out.h, tolerance, exchange > quick);
    if (in < 0) {
      for (std::size_t i = 0; i < basis.size(); ++i) {
        const double multiplier = lambda[static_cast<Eigen::Index>(i)];
        if (basis[i] >= dual.rows() || multiplier <= 1e-12) continue;
        out.rows.push_back(static_cast<std::size_t>(basis[i]));
        out.multipliers.push_back(multiplier);
      }
      out.solved = out.step.allFinite();
      return out;
    }
    const Eigen::VectorXd d = lu.solve(dual.column(in));
    Eigen::Index leaves = -1;
    double least = std::numeric_limits<double>::infinity();
    for (Eigen::Index i = 0; i <= n; ++i) {
      if (d[i] <= 1e-11) continue;
      const double ratio = std::max(lambda[i], 0.0) / d[i];
      const bool tie = leaves >= 0 && std::abs(ratio - least) <= 1e-15;
      if (ratio < least - 1e-15 || (tie && d[i] > d[leaves])) least = ratio, leaves = i;
    }
    if (leaves < 0) return out;  // cannot be: the box bounds the program
    basis[static_cast<std::size_t>(leaves)] = in;
  }
  return out;
}

}  // namespace trueaxis

// SPDX-License-Identifier: Apache-2.0
#include "associate/chebyshev_program.hpp"

#include <optional>

#include "math/dual_simplex.hpp"

namespace trueaxis {
namespace {

/// h − A δ ≥ g of every row, then δ_k ≥ −reach and −δ_k ≥ −reach of the box; x = (δ, h).
class Constraints {
 public:
  Constraints(const ChebyshevProgram& program, double reach, double tolerance)
      : program_(program),
        reach_(reach),
        tolerance_(tolerance),
        m_(program.a.rows()),
        n_(program.a.cols()) {}

  Eigen::VectorXd column(Eigen::Index j) const {
    Eigen::VectorXd out = Eigen::VectorXd::Zero(n_ + 1);
    if (j < m_) {
      out.head(n_) = -program_.a.row(j).transpose();
      out[n_] = 1.0;
    } else {
      out[(j - m_) % n_] = j - m_ < n_ ? -1.0 : 1.0;
    }
    return out;
  }
  double cost(Eigen::Index j) const { return j < m_ ? program_.g[j] : -reach_; }

  /// The largest g, the box against its slope.
  std::vector<Eigen::Index> first_basis() const {
    Eigen::Index top = 0;
    program_.g.maxCoeff(&top);
    std::vector<Eigen::Index> basis;
    for (Eigen::Index k = 0; k < n_; ++k)
      basis.push_back(m_ + k + (program_.a(top, k) > 0.0 ? n_ : 0));
    basis.push_back(top);
    return basis;
  }

  /// What is broken most; after `quick` exchanges the first that is (Bland's rule: no cycles).
  std::optional<Eigen::Index> entering(const Eigen::VectorXd& x, int exchange) {
    constexpr int quick = 400;
    gain_.noalias() = program_.g + program_.a * x.head(n_);
    std::optional<Eigen::Index> best;
    double most = tolerance_;
    const auto offer = [&](Eigen::Index j, double gain) {
      if (gain > most && !(exchange > quick && best)) best = j, most = gain;
    };
    for (Eigen::Index j = 0; j < m_; ++j) offer(j, gain_[j] - x[n_]);
    for (Eigen::Index k = 0; k < n_; ++k) {
      offer(m_ + k, x[k] - reach_);
      offer(m_ + n_ + k, -x[k] - reach_);
    }
    return best;
  }
  Eigen::Index rows() const { return m_; }

 private:
  const ChebyshevProgram& program_;
  double reach_, tolerance_;
  Eigen::Index m_, n_;
  Eigen::VectorXd gain_;
};

}  // namespace

ChebyshevSolution solve(const ChebyshevProgram& program, double reach, double tolerance) {
  constexpr int most_exchanges = 4000;
  constexpr double no_multiplier = 1e-12;
  Constraints constraints(program, reach, tolerance);
  const Eigen::Index n = program.a.cols();
  std::vector<Eigen::Index> basis = constraints.first_basis();
  const Vertex found =
      dual_simplex(Eigen::VectorXd::Unit(n + 1, n), basis, constraints, most_exchanges);
  ChebyshevSolution out{found.x.head(n), found.x[n], {}, {}, found.solved && found.x.allFinite()};
  if (!found.solved) return out;
  for (std::size_t i = 0; i < basis.size(); ++i) {
    const double multiplier = found.multipliers[static_cast<Eigen::Index>(i)];
    if (basis[i] >= constraints.rows() || multiplier <= no_multiplier) continue;
    out.rows.push_back(static_cast<std::size_t>(basis[i]));
    out.multipliers.push_back(multiplier);
  }
  return out;
}

}  // namespace trueaxis

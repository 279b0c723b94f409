// SPDX-License-Identifier: Apache-2.0
#include <Eigen/Core>
#include <Eigen/LU>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <optional>

#include "associate/distance_kernel.hpp"
#include "associate/extreme_element.hpp"
#include "associate/least_squares.hpp"
#include "math/dual_simplex.hpp"
#include "math/linear_algebra.hpp"

namespace trueaxis {
namespace {

/// The linear program of a Chebyshev problem (Eq. 249): the least h and the step δ in the box
/// |δ_k| ≤ reach with g + A δ ≤ h in every row.
struct ChebyshevProgram {
  Eigen::VectorXd g;
  Eigen::MatrixXd a;  ///< a row for each g
};

struct ChebyshevSolution {
  Eigen::VectorXd step;
  double h = 0.0;
  /// The rows that hold h up and their multipliers λ > 0; where the box holds the step Σ λ A is not
  /// 0.
  std::vector<std::size_t> rows;
  std::vector<double> multipliers;
  bool solved = false;
};

/// h − A δ ≥ g of every row, then δ_k ≥ −reach and −δ_k ≥ −reach of the box; x = (δ, h).
class Constraints {
 public:
  Constraints(const ChebyshevProgram& program, double reach, double tolerance)
      : program_(program),
        reach_(reach),
        tolerance_(tolerance),
        m_(program.a.rows()),
        n_(program.a.cols()) {}

  Unknowns column(Eigen::Index j) const {
    Unknowns out = Unknowns::Zero(n_ + 1);
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
  std::optional<Eigen::Index> entering(const Unknowns& x, int exchange) {
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

/// By Stiefel's exchange: the simplex method on the dual, which has as many rows as there are
/// unknowns, whatever the number of constraints. Rows may be many, unknowns are few.
ChebyshevSolution solve(const ChebyshevProgram& program, double reach, double tolerance) {
  constexpr int most_exchanges = 4000;
  constexpr double no_multiplier = 1e-12;
  Constraints constraints(program, reach, tolerance);
  const Eigen::Index n = program.a.cols();
  std::vector<Eigen::Index> basis = constraints.first_basis();
  const Vertex found =
      dual_simplex(Unknowns(Unknowns::Unit(n + 1, n)), basis, constraints, most_exchanges);
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

class Search {
 public:
  Search(const PointCloud& cloud, const Sides& sides, const Placed& start)
      : cloud_(cloud), sides_(sides), motions_(Index(free_motions(start.shape, sides))) {
    per_ = step_lengths(start.shape, cloud).cwiseInverse();
    if (sides.size_follows) per_[per_.size() - 1] = 0.0;
    const Index m = Index(cloud.points.size());
    sides_count_ = (sides.outer ? 1 : 0) + (sides.inner ? 1 : 0);
    program_.g.resize(m * sides_count_);
    program_.a.resize(m * sides_count_, motions_);
  }

  Minimax run(Placed placed, int max_iterations) {
    Minimax out{.placed = placed};
    evaluate(placed);
    out.h = program_.g.maxCoeff();
    // An inscribed element must not step over the points that hold it: outside of them it is
    // larger.
    const bool inscribed = sides_.inner && !sides_.outer;
    const double size = placed.shape == Shape::torus ? placed.second_size : placed.size;
    far_ = inscribed ? 10.0 * cloud_.length + 2.0 * placed.offset.norm()
                     : 100.0 * cloud_.length + 10.0 * placed.offset.norm();
    longest_ = inscribed ? std::min(cloud_.length, 0.1 * size) : cloud_.length;
    double reach = std::clamp(2.0 * std::abs(out.h), 1e-9 * longest_, longest_);
    const double rounding = 4e-16 * cloud_.length + 0.25 * cloud_.rounding;
    for (; out.iterations < max_iterations; ++out.iterations) {
      const ChebyshevSolution linear = solve(program_, reach, rounding + 1e-15 * reach);
      if (!linear.solved) break;
      const double gain = out.h - linear.h;
      const std::optional<Step> best = better_of(out.placed, linear, reach, out.h);
      if (best && best->h < out.h - 0.02 * rounding) {
        const bool good = out.h - best->h > 0.5 * gain;
        out.placed = recentred(best->placed, cloud_.centroid);
        evaluate(out.placed);
        out.h = program_.g.maxCoeff();
        reach = std::min(longest_, std::max(good ? 2.0 * reach : reach, 2.0 * best->length));
        if (runs_away(out.placed)) break;
        continue;
      }
      if (gain <= rounding || reach <= 1e-13 * cloud_.length) break;
      reach *= 0.2;
    }
    polish(out);
    certify(out);
    return out;
  }

 private:
  using Index = Eigen::Index;
  struct Step {
    Placed placed;
    double h, length;
  };

  bool runs_away(const Placed& placed) const { return placed.offset.norm() > far_; }

  void evaluate(const Placed& placed) {
    const Index m = Index(cloud_.points.size());
    for (Index at = 0; at < m; at += Index(block_size)) {
      const Index count = std::min(Index(block_size), m - at);
      evaluate_distances(placed, cloud_.points.subspan(std::size_t(at), std::size_t(count)),
                         block_);
      const double* d = block_.column[traits_of(placed.shape).parameters];
      Index row = at;
      for (const int sign : {1, -1}) {
        if (!(sign > 0 ? sides_.outer : sides_.inner)) continue;
        for (Index i = 0; i < count; ++i) program_.g[row + i] = sign * d[i];
        for (Index k = 0; k < motions_; ++k)
          for (Index i = 0; i < count; ++i)
            program_.a(row + i, k) = sign * per_[k] * block_.column[k][i];
        row += m;
      }
    }
  }

  double largest(const Placed& placed) const {
    double d[block_size], top = -1e300;
    for (std::size_t at = 0; at < cloud_.points.size(); at += block_size) {
      const std::size_t count = std::min(block_size, cloud_.points.size() - at);
      evaluate_only_distances(placed, cloud_.points.subspan(at, count), d);
      for (std::size_t i = 0; i < count; ++i)
        top = std::max(top, sides_.outer ? (sides_.inner ? std::abs(d[i]) : d[i]) : -d[i]);
    }
    return top;
  }

  Placed stepped(const Placed& from, const Eigen::VectorXd& step) const {
    Parameters full = Parameters::Zero(per_.size());
    full.head(motions_) = step.cwiseProduct(per_.head(motions_));
    return moved(from, full);
  }

  /// Newton's step where it is one, else the linear step: whichever is lower.
  std::optional<Step> better_of(const Placed& from, const ChebyshevSolution& linear, double reach,
                                double h) const {
    std::optional<Step> best;
    const auto offer = [&](const Eigen::VectorXd& step) {
      if (!step.allFinite() ||
          step.lpNorm<Eigen::Infinity>() > std::min(10.0 * reach, 1.01 * longest_))
        return;
      const Placed placed = stepped(from, step);
      const double top = largest(placed);
      if (top < (best ? best->h : h)) best = {placed, top, step.lpNorm<Eigen::Infinity>()};
    };
    offer(newton_step(from, linear));
    offer(linear.step);
    return best;
  }

  /// Points of the rows that hold the linear step up.
  std::vector<Point3> points_of(const ChebyshevSolution& linear) const {
    std::vector<Point3> out;
    for (const std::size_t row : linear.rows)
      out.push_back(cloud_.points[row % cloud_.points.size()]);
    return out;
  }
  int sign_of(std::size_t row) const { return row < cloud_.points.size() && sides_.outer ? 1 : -1; }

  /// Σ λ s ∇²d by differences: nine digits do, as Newton's step is repeated where it ends.
  Eigen::MatrixXd curvature(const Placed& at, const ChebyshevSolution& linear) const {
    const std::vector<Point3> points = points_of(linear);
    const auto value = [&](const Eigen::VectorXd& step) {
      double d[block_size], sum = 0.0;
      evaluate_only_distances(stepped(at, step), points, d);
      for (std::size_t i = 0; i < points.size(); ++i)
        sum += linear.multipliers[i] * sign_of(linear.rows[i]) * d[i];
      return sum;
    };
    const double size = std::abs(at.size) > 0.0 ? std::abs(at.size) : cloud_.length;
    const double t = 3e-4 * std::min(cloud_.length, size);
    Eigen::MatrixXd w(motions_, motions_);
    for (Index i = 0; i < motions_; ++i) {
      for (Index j = 0; j <= i; ++j) {
        const Eigen::VectorXd a = t * Eigen::VectorXd::Unit(motions_, i),
                              b = t * Eigen::VectorXd::Unit(motions_, j);
        w(i, j) = w(j, i) =
            (value(a + b) - value(a - b) - value(b - a) + value(-a - b)) / (4.0 * t * t);
      }
    }
    return w;
  }

  /// Eq. 250: the step to where the rows that hold the linear step up are equal and their gradients
  /// balance.
  Eigen::VectorXd newton_step(const Placed& at, const ChebyshevSolution& linear) const {
    const Index k = Index(linear.rows.size()), p = motions_;
    if (k == 0) return Eigen::VectorXd::Constant(p, std::nan(""));
    Eigen::MatrixXd kkt = Eigen::MatrixXd::Zero(p + 1 + k, p + 1 + k);
    Eigen::VectorXd right = Eigen::VectorXd::Zero(p + 1 + k);
    kkt.topLeftCorner(p, p) = curvature(at, linear);
    for (Index i = 0; i < k; ++i) {
      const Index row = Index(linear.rows[std::size_t(i)]);
      kkt.block(p + 1 + i, 0, 1, p) = program_.a.row(row);
      kkt.block(0, p + 1 + i, p, 1) = program_.a.row(row).transpose();
      kkt(p + 1 + i, p) = kkt(p, p + 1 + i) = -1.0;
      right[p + 1 + i] = -program_.g[row];
    }
    right[p] = -1.0;
    return linear::least_squares(kkt, right).head(p);
  }

  /// If fewer points hold the element than it has motions, h is flat about its optimum and goes
  /// no lower long before the place has all its digits: Newton's step goes by the balance.
  void polish(Minimax& out) {
    double last = 1e-5 * cloud_.length;
    for (int i = 0; i < 6; ++i) {
      const ChebyshevSolution linear =
          touching(solve(program_, 1e-3 * cloud_.length, 2e-15 * cloud_.length), out.h);
      const Eigen::VectorXd step = newton_step(out.placed, linear);
      const double length = step.norm();
      if (!std::isfinite(length) || length >= last) return;
      const Placed placed = recentred(stepped(out.placed, step), cloud_.centroid);
      const double top = largest(placed);
      if (top > out.h + 1e-14 * cloud_.length + cloud_.rounding) return;
      out.placed = placed;
      out.h = top;
      last = 0.5 * length;
      evaluate(placed);
    }
  }

  /// Without the rows that are below h and only balance what the place is still off.
  ChebyshevSolution touching(const ChebyshevSolution& of, double h) const {
    ChebyshevSolution out = of;
    out.rows.clear(), out.multipliers.clear();
    for (std::size_t i = 0; i < of.rows.size(); ++i) {
      if (h - program_.g[Index(of.rows[i])] > 1e-10 * cloud_.length + 8.0 * cloud_.rounding)
        continue;
      out.rows.push_back(of.rows[i]);
      out.multipliers.push_back(of.multipliers[i]);
    }
    return out;
  }

  void certify(Minimax& out) const {
    const ChebyshevSolution linear = solve(program_, cloud_.length, 2e-15 * cloud_.length);
    Eigen::VectorXd balance = Eigen::VectorXd::Zero(motions_);
    for (std::size_t i = 0; i < linear.rows.size(); ++i) {
      const std::size_t row = linear.rows[i];
      const int sign = sign_of(row);
      balance += linear.multipliers[i] * program_.a.row(Index(row)).transpose();
      out.contacts.push_back(
          {row % cloud_.points.size(), sign, sign * program_.g[Index(row)], linear.multipliers[i]});
    }
    out.stationarity = balance.norm();
    out.gap = std::max(0.0, out.h - linear.h);
    out.runs_away = runs_away(out.placed);
    out.converged = linear.solved && !out.runs_away && out.gap <= 1e-9 * cloud_.length;
    // The distance from a curve in space has no gradient on it; but no zone is narrower than none.
    const double on_it = 1e-12 * cloud_.length + 8.0 * cloud_.rounding;
    if (!out.converged && !sides_.size_follows && out.h <= on_it) {
      out.contacts.clear();
      out.stationarity = 0.0;
      out.gap = std::max(0.0, out.h);
      out.converged = true;
    }
  }

  const PointCloud& cloud_;
  Sides sides_;
  Index motions_, sides_count_ = 0;
  Parameters per_;
  ChebyshevProgram program_;
  DistanceBlock block_;
  double longest_ = 0.0;  ///< step
  double far_ = 0.0;      ///< an element that goes further has no end
};

}  // namespace

Sides sides_of(Shape shape, Criterion criterion) {
  if (criterion == Criterion::minimum_circumscribed) return {true, false, true};
  if (criterion == Criterion::maximum_inscribed) return {false, true, true};
  const bool tube = shape == Shape::line_3d || shape == Shape::circle_3d;
  return {true, !tube, false};
}

std::size_t free_motions(Shape shape, const Sides& sides) {
  return traits_of(shape).parameters - (sides.size_follows ? 1 : 0);
}

Minimax minimax(const Placed& start, const PointCloud& cloud, const Sides& sides,
                int max_iterations) {
  return Search(cloud, sides, start).run(start, max_iterations);
}

}  // namespace trueaxis

// SPDX-License-Identifier: Apache-2.0
#include "machine/bounded_least_squares.hpp"

#include <algorithm>
#include <cmath>

#include "math/linear_algebra.hpp"

namespace trueaxis {
namespace {

using Eigen::Index;
using Eigen::Vector3d;

/// y of M y + c with the components of `at` that are not free held there: of least length.
SmallVector least_with_held(const SmallMatrix& M, const Vector3d& c, const SmallVector& at,
                            const Eigen::Array<bool, Eigen::Dynamic, 1, 0, 6, 1>& free) {
  Vector3d rest = c;
  Eigen::MatrixXd columns(3, 0);
  for (Index i = 0; i < M.cols(); ++i) {
    if (free[i]) {
      columns.conservativeResize(3, columns.cols() + 1);
      columns.col(columns.cols() - 1) = M.col(i);
    } else {
      rest += at[i] * M.col(i);
    }
  }
  SmallVector y = at;
  if (columns.cols() == 0) return y;
  const Eigen::VectorXd solved = linear::least_squares(columns, Eigen::VectorXd(-rest), 1e-13);
  for (Index i = 0, k = 0; i < M.cols(); ++i)
    if (free[i]) y[i] = solved[k++];
  return y;
}

bool inside(const SmallVector& y, const SmallVector& bound) {
  for (Index i = 0; i < y.size(); ++i)
    if (std::abs(y[i]) > bound[i] * (1.0 + 1e-12)) return false;
  return true;
}

/// Two columns far from parallel: their normal equations, which is nearly every position.
bool solved_at_once(const SmallMatrix& M, const Vector3d& c, SmallVector& y) {
  if (M.cols() != 2) return false;
  const Vector3d a = M.col(0), b = M.col(1);
  const double aa = a.squaredNorm(), bb = b.squaredNorm(), ab = a.dot(b);
  const double det = aa * bb - ab * ab;
  if (!(det > 1e-4 * aa * bb)) return false;
  const double ca = -c.dot(a), cb = -c.dot(b);
  y.resize(2);
  y << (bb * ca - ab * cb) / det, (aa * cb - ab * ca) / det;
  return true;
}

/// The least on the border of a rectangle: on each of its four sides the other variable is the
/// least one of its line, or an end of it.
SmallVector least_on_border(const SmallMatrix& M, const Vector3d& c, const SmallVector& bound) {
  SmallVector best(2);
  double least = INFINITY;
  for (const Index held : {Index{0}, Index{1}}) {
    for (const double side : {1.0, -1.0}) {
      const Vector3d rest = c + side * bound[held] * M.col(held), other = M.col(1 - held);
      const double square = other.squaredNorm(), limit = bound[1 - held];
      SmallVector y(2);
      y[held] = side * bound[held];
      y[1 - held] = square > 0.0 ? std::clamp(-rest.dot(other) / square, -limit, limit) : 0.0;
      const double size = (rest + y[1 - held] * other).norm();
      if (size < least) {
        least = size;
        best = y;
      }
    }
  }
  return best;
}

}  // namespace

SmallVector bounded_least_squares(const SmallMatrix& M, const Vector3d& c,
                                  const SmallVector& bound) {
  const Index n = M.cols();
  SmallVector y = SmallVector::Zero(n);
  Eigen::Array<bool, Eigen::Dynamic, 1, 0, 6, 1> free(n);
  free.setConstant(true);
  if (!solved_at_once(M, c, y)) y = least_with_held(M, c, y, free);
  if (inside(y, bound)) return y;
  if (n == 2 && bound.allFinite()) return least_on_border(M, c, bound);
  SmallVector best = SmallVector::Zero(n);
  double least = INFINITY;
  int choices = 1;
  for (Index i = 0; i < n; ++i) choices *= std::isfinite(bound[i]) ? 3 : 1;
  for (int choice = 1; choice < choices; ++choice) {  // 0 is the one with none on its bound
    SmallVector at = SmallVector::Zero(n);
    for (Index i = 0, digits = choice; i < n; ++i) {
      if (!std::isfinite(bound[i])) continue;
      const Index digit = digits % 3;
      digits /= 3;
      free[i] = digit == 0;
      at[i] = digit == 1 ? bound[i] : digit == 2 ? -bound[i] : 0.0;
    }
    const SmallVector tried = least_with_held(M, c, at, free);
    if (!inside(tried, bound)) continue;
    const double size = (M * tried + c).norm();
    const bool better = size < least * (1.0 - 1e-12);
    if (better || (size <= least * (1.0 + 1e-12) && tried.norm() < best.norm())) {
      least = size;
      best = tried;
    }
  }
  return best;
}

}  // namespace trueaxis

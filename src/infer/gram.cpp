// SPDX-License-Identifier: Apache-2.0
#include "infer/gram.hpp"

#include <cmath>
#include <optional>

#include "math/linear_algebra.hpp"
#include "math/lower_triangle.hpp"

namespace trueaxis::infer {
namespace {

using Matrix = Eigen::MatrixXd;

// Of a column's square: the rounding of the Gram matrix (n ε) and of the columns leave nothing to
// trust below.
constexpr double undetermined = 1e-11;
// Of a normal matrix scaled to a diagonal of 1: its smallest eigenvalue is at least that over e.
constexpr double independent_determinant = 1e-10;

/// Σ of squares of the readings of a block less what coefficients make of the columns.
double left_of(const Eigen::MatrixXd& fold, const Columns& columns,
               const Eigen::VectorXd& coefficients) {
  const Eigen::VectorXd right = fold(columns, 0);
  const Eigen::MatrixXd left = fold(columns, columns);
  return fold(0, 0) - 2.0 * coefficients.dot(right) + coefficients.dot(left * coefficients);
}

/// Those of the other blocks, by a Cholesky factor; nothing where columns may depend.
std::optional<Eigen::VectorXd> independent_coefficients(const Eigen::MatrixXd& total,
                                                        const Eigen::MatrixXd& fold,
                                                        const Columns& columns) {
  const std::size_t n = columns.size();
  const auto place = [&](std::size_t j) {
    return static_cast<Eigen::Index>(j < n ? columns[j] : 0);
  };
  LowerTriangle normal(n + 1);  // the readings last
  for (std::size_t j = 0; j < n; ++j)
    for (std::size_t i = j; i <= n; ++i)
      normal(i, j) = total(place(i), place(j)) - fold(place(i), place(j));
  std::vector<double> norm2;
  for (std::size_t j = 0; j < n; ++j) norm2.push_back(normal(j, j));
  if (!normal.eliminate(n)) return {};
  double determinant = 1.0;
  for (std::size_t j = 0; j < n; ++j) determinant *= normal(j, j) * normal(j, j) / norm2[j];
  if (!(determinant > independent_determinant)) return {};
  Eigen::VectorXd out(static_cast<Eigen::Index>(n));
  for (std::size_t j = n; j-- > 0;) {
    double sum = normal(n, j);
    for (std::size_t i = j + 1; i < n; ++i) sum -= normal(i, j) * out(static_cast<Eigen::Index>(i));
    out(static_cast<Eigen::Index>(j)) = sum / normal(j, j);
  }
  return out;
}

}  // namespace

Solution solve(const Eigen::MatrixXd& gram, const Columns& columns) {
  const auto n = static_cast<Eigen::Index>(columns.size());
  Solution out;
  out.columns = columns;
  out.coefficients = Eigen::VectorXd::Zero(n);
  out.inverse = Matrix::Zero(n, n);
  out.rss = gram(0, 0);
  if (n == 0) return out;
  Matrix normal(n, n);
  Eigen::VectorXd right(n), scale(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto a = static_cast<Eigen::Index>(columns[static_cast<std::size_t>(i)]);
    right(i) = gram(a, 0);
    scale(i) = gram(a, a) > 0.0 ? 1.0 / std::sqrt(gram(a, a)) : 0.0;
    for (Eigen::Index j = 0; j < n; ++j)
      normal(i, j) = gram(a, static_cast<Eigen::Index>(columns[static_cast<std::size_t>(j)]));
  }
  const Matrix unit = scale.asDiagonal() * normal * scale.asDiagonal();
  const auto [values, vectors] = linear::spectrum(unit);
  Eigen::VectorXd inverse(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const bool there = values(i) > undetermined;
    inverse(i) = there ? 1.0 / values(i) : 0.0;
    out.rank += there;
  }
  out.inverse = linear::propagated(linear::scaled_rows(scale, vectors),
                                   Eigen::MatrixXd(inverse.asDiagonal()));
  out.coefficients = out.inverse * right;
  out.rss = gram(0, 0) - right.dot(out.coefficients);
  return out;
}

Projection::Projection(const Eigen::MatrixXd& gram, const Solution& taken)
    : norm2(gram.diagonal()),
      rank(taken.rank),
      whole_(&gram),
      cross_(static_cast<Eigen::Index>(taken.columns.size()), gram.cols()) {
  for (Eigen::Index i = 0; i < cross_.rows(); ++i)
    cross_.row(i) = gram.row(static_cast<Eigen::Index>(taken.columns[static_cast<std::size_t>(i)]));
  weighted_.noalias() = taken.inverse * cross_;
  rss = this->gram(0, 0);
}

Eigen::MatrixXd Projection::gram(const Columns& rows, const Columns& columns) const {
  Matrix out(rows.size(), columns.size());
  for (Eigen::Index i = 0; i < out.rows(); ++i) {
    for (Eigen::Index j = 0; j < out.cols(); ++j)
      out(i, j) = gram(static_cast<Eigen::Index>(rows[static_cast<std::size_t>(i)]),
                       static_cast<Eigen::Index>(columns[static_cast<std::size_t>(j)]));
  }
  return out;
}

Score score(const Projection& projection, const Columns& columns) {
  const auto n = static_cast<Eigen::Index>(columns.size());
  if (n == 0) return {};
  Matrix left(n, n);
  Eigen::VectorXd right(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto a = static_cast<Eigen::Index>(columns[static_cast<std::size_t>(i)]);
    const double scale_a = projection.norm2(a) > 0.0 ? 1.0 / std::sqrt(projection.norm2(a)) : 0.0;
    right(i) = projection.gram(a, 0) * scale_a;
    for (Eigen::Index j = 0; j < n; ++j) {
      const auto b = static_cast<Eigen::Index>(columns[static_cast<std::size_t>(j)]);
      const double scale_b = projection.norm2(b) > 0.0 ? 1.0 / std::sqrt(projection.norm2(b)) : 0.0;
      left(i, j) = projection.gram(a, b) * scale_a * scale_b;
    }
  }
  Score out;
  const auto take = [&](double value, double along) {
    if (value <= 1e-9) return;
    out.gain += along * along / value;
    ++out.rank;
  };
  if (n == 1) {
    take(left(0, 0), right(0));
    return out;
  }
  const auto [values, vectors] = linear::spectrum(left);
  const Eigen::VectorXd along = vectors.transpose() * right;
  for (Eigen::Index i = 0; i < n; ++i) take(values(i), along(i));
  return out;
}

double held_out(const Eigen::MatrixXd& total, const Eigen::MatrixXd& fold, const Columns& columns) {
  return left_of(fold, columns, solve(total - fold, columns).coefficients);
}

double held_out_fast(const Eigen::MatrixXd& total, const Eigen::MatrixXd& fold,
                     const Columns& columns) {
  const auto coefficients = independent_coefficients(total, fold, columns);
  return coefficients ? left_of(fold, columns, *coefficients) : held_out(total, fold, columns);
}

}  // namespace trueaxis::infer

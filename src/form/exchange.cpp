// SPDX-License-Identifier: Apache-2.0
#include "form/exchange.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "math/linear_algebra.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis::form {
namespace {

constexpr int most_exchanges = 10'000;
constexpr double epsilon = std::numeric_limits<double>::epsilon();
/// How far off the walls are that an exchange starts from, over the largest value.
constexpr double wall_over_largest = 1e4;
constexpr double least_pivot = 1e-10;

double largest_of(std::span<const double> y) {
  double largest = 0.0;
  for (const double value : y) largest = std::max(largest, std::abs(value));
  return largest;
}

}  // namespace

Exchange::Exchange(Rows rows, Criterion criterion)
    : rows_(std::make_shared<const Rows>(std::move(rows))), criterion_(criterion) {
  expects(rows_->rows() >= rows_->cols() && rows_->cols() > 0, "more readings than unknowns");
  const Eigen::Index p = rows_->cols();
  if (criterion_ == Criterion::gaussian) {
    normal_.compute(rows_->transpose() * *rows_);
    return;
  }
  // A zone has its half width as one unknown more, which is to be least; else it is the size.
  const bool zone = criterion_ == Criterion::minimum_zone;
  objective_ = Eigen::VectorXd::Unit(zone ? p + 1 : p, zone ? p : 0);
  begin();
}

void Exchange::begin() {
  active_.clear();
  for (std::ptrdiff_t k = 0; k < objective_.size(); ++k) active_.push_back({-1 - k, 1});
}

/// g of the constraint g·x ≥ limit. One-sided unknowns are those of the circumscribed problem; an
/// inscribed one is that of −y.
Eigen::VectorXd Exchange::gradient(const Active& one) const {
  if (one.reading < 0) return Eigen::VectorXd::Unit(objective_.size(), -1 - one.reading);
  Eigen::VectorXd g(objective_.size());
  g.head(rows_->cols()) = one.side * rows_->row(one.reading).transpose();
  if (criterion_ == Criterion::minimum_zone) g[rows_->cols()] = 1.0;
  return g;
}

double Exchange::limit(const Active& one, std::span<const double> y, double wall) const {
  if (one.reading < 0) return -wall;
  return one.side * y[static_cast<std::size_t>(one.reading)];
}

Nearest Exchange::least_squares(std::span<const double> y) const {
  const Eigen::Map<const Eigen::VectorXd> values(y.data(), static_cast<Eigen::Index>(y.size()));
  Eigen::VectorXd q = normal_.solve(rows_->transpose() * values);
  q += normal_.solve(rows_->transpose() * (values - *rows_ * q));  // refined once
  return {q, {}, true};
}

std::vector<double> Exchange::off(std::span<const double> y, const Nearest& nearest) const {
  const Eigen::Map<const Eigen::VectorXd> values(y.data(), rows_->rows());
  std::vector<double> out(y.size());
  Eigen::Map<Eigen::VectorXd>(out.data(), rows_->rows()) = values - *rows_ * nearest.q;
  return out;
}

Nearest Exchange::operator()(std::span<const double> given) {
  expects(static_cast<Eigen::Index>(given.size()) == rows_->rows(), "a value for every row");
  if (criterion_ == Criterion::gaussian) return least_squares(given);
  const bool zone = criterion_ == Criterion::minimum_zone;
  std::vector<double> y(given.begin(), given.end());
  if (criterion_ == Criterion::maximum_inscribed)
    for (double& value : y) value = -value;
  const double largest = largest_of(y), wall = wall_over_largest * largest + 1e-12;
  const double rounding = 16.0 * epsilon * largest;
  const Eigen::Index n = objective_.size(), p = rows_->cols();
  Eigen::MatrixXd basis(n, n);
  Eigen::VectorXd right(n), x(n), multipliers(n);
  const Eigen::Map<const Eigen::VectorXd> values(y.data(), rows_->rows());
  for (int round = 0; round < most_exchanges; ++round) {
    for (Eigen::Index j = 0; j < n; ++j) {
      const Active& one = active_[static_cast<std::size_t>(j)];
      basis.col(j) = gradient(one);
      right[j] = limit(one, y, wall);
    }
    const linear::Triangles solver(basis);
    x = solver.solve_transposed(right);
    multipliers = solver.solve(objective_);
    // The reading that is broken most comes in.
    const Eigen::VectorXd off = values - *rows_ * x.head(p);
    const double t = zone ? x[p] : 0.0;
    Eigen::Index high = 0, low = 0;
    const double above = off.maxCoeff(&high) - t, below = -off.minCoeff(&low) - t;
    const bool from_below = zone && below > above;
    if ((from_below ? below : above) <= rounding) break;
    const Active incoming{from_below ? low : high, from_below ? -1 : 1};
    // The first whose multiplier it brings to zero goes out.
    const Eigen::VectorXd mu = solver.solve(gradient(incoming));
    Eigen::Index leaves = -1;
    for (Eigen::Index j = 0; j < n; ++j) {
      if (mu[j] <= least_pivot) continue;
      if (leaves < 0) {
        leaves = j;
        continue;
      }
      const double a = std::max(0.0, multipliers[j]) * mu[leaves];
      const double b = std::max(0.0, multipliers[leaves]) * mu[j];
      if (a < b || (a == b && mu[j] > mu[leaves])) leaves = j;
    }
    if (leaves < 0) break;  // nothing can go: what is left is rounding
    active_[static_cast<std::size_t>(leaves)] = incoming;
  }
  Nearest nearest{x.head(p), {}, true};
  if (criterion_ == Criterion::maximum_inscribed) nearest.q = -nearest.q;
  const int turned = criterion_ == Criterion::maximum_inscribed ? -1 : 1;
  for (Eigen::Index j = 0; j < n; ++j) {
    const Active& one = active_[static_cast<std::size_t>(j)];
    if (one.reading < 0)
      nearest.determined = nearest.determined && std::abs(multipliers[j]) < least_pivot;
    else
      nearest.touches.push_back(
          {static_cast<std::size_t>(one.reading), turned * one.side, multipliers[j]});
  }
  return nearest;
}

}  // namespace trueaxis::form

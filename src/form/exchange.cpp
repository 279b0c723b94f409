// SPDX-License-Identifier: Apache-2.0
#include "form/exchange.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "math/dual_simplex.hpp"
#include "math/linear_algebra.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis::form {
namespace {

constexpr int most_exchanges = 10'000;
constexpr double epsilon = std::numeric_limits<double>::epsilon();
/// How far off the walls are that an exchange starts from, over the largest value.
constexpr double wall_over_largest = 1e4;
constexpr double least_pivot = 1e-10;
constexpr Eigen::Index stretch = 32;  // readings, of which the worst is remembered
constexpr double good_part = 0.1;

}  // namespace

Exchange::Exchange(Rows rows, Criterion criterion, std::span<const double> weight)
    : rows_(std::make_shared<const Rows>(std::move(rows))), criterion_(criterion) {
  expects(rows_->rows() >= rows_->cols() && rows_->cols() > 0, "more readings than unknowns");
  const Eigen::Index p = rows_->cols();
  if (criterion_ == Criterion::gaussian) {
    Rows weighed = *rows_;
    for (std::size_t i = 0; i < weight.size(); ++i)
      weighed.row(static_cast<Eigen::Index>(i)) *= weight[i];
    const Rows normal = linear::transposed_product(weighed, *rows_);
    solver_ = std::make_shared<const Rows>(
        linear::solve_normal(normal, Rows(weighed.transpose())).transpose());
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

namespace {

/// Readings as constraints, one-sided unknowns those of the circumscribed problem; an inscribed one
/// is that of −y. Walls hold what no reading does.
class Constraints {
 public:
  Constraints(const Exchange::Rows& rows, std::span<const double> y, bool zone)
      : rows_(rows), y_(y.data(), rows.rows()), zone_(zone), largest_(y_.cwiseAbs().maxCoeff()) {}

  Unknowns column(const Exchange::Active& one) const {
    const Eigen::Index p = rows_.cols(), n = zone_ ? p + 1 : p;
    if (one.reading < 0) return Unknowns::Unit(n, -1 - one.reading);
    Unknowns g(n);
    g.head(p) = one.side * rows_.row(one.reading).transpose();
    if (zone_) g[p] = 1.0;
    return g;
  }
  double cost(const Exchange::Active& one) const {
    return one.reading < 0 ? -(wall_over_largest * largest_ + 1e-12) : one.side * y_[one.reading];
  }
  /// One that is broken: the worst of those that were when all were looked at last, as long as that
  /// is worth a good part of the worst then; else of all.
  std::optional<Exchange::Active> entering(const Unknowns& x, int) {
    const double t = zone_ ? x[rows_.cols()] : 0.0;
    if (const auto known = worst_of(broken_, x, t, good_part * worst_then_)) return known;
    look_at_all(x, t);
    return worst_of(broken_, x, t, 0.0);
  }

 private:
  double least() const { return 16.0 * epsilon * largest_; }

  std::optional<Exchange::Active> worst_of(std::span<const Exchange::Active> list,
                                           const Unknowns& x, double t, double more_than) const {
    std::optional<Exchange::Active> out;
    double worst = std::max(more_than, least());
    for (const Exchange::Active& one : list) {
      double off = y_[one.reading];
      for (Eigen::Index k = 0; k < rows_.cols(); ++k) off -= rows_(one.reading, k) * x[k];
      if (one.side * off - t <= worst) continue;
      worst = one.side * off - t;
      out = one;
    }
    return out;
  }
  /// The worst of every stretch of readings.
  void look_at_all(const Unknowns& x, double t) {
    off_ = y_;
    off_.noalias() -= rows_ * x.head(rows_.cols());
    broken_.clear();
    worst_then_ = std::max(off_.maxCoeff(), zone_ ? -off_.minCoeff() : 0.0) - t;
    for (Eigen::Index begin = 0; begin < off_.size(); begin += stretch) {
      const auto part = off_.segment(begin, std::min(stretch, off_.size() - begin));
      const double high = part.maxCoeff(), low = part.minCoeff();
      const auto add = [&](double off, int side) {
        if (side * off - t > least())
          broken_.push_back({begin + (std::ranges::find(part, off) - part.begin()), side});
      };
      add(high, 1);
      if (zone_) add(low, -1);
    }
  }

  const Exchange::Rows& rows_;
  Eigen::Map<const Eigen::VectorXd> y_;
  bool zone_;
  double largest_, worst_then_ = std::numeric_limits<double>::infinity();
  std::vector<Exchange::Active> broken_;
  Eigen::VectorXd off_;
};

}  // namespace

Nearest Exchange::least_squares(std::span<const double> y) const {
  const Eigen::Map<const Eigen::VectorXd> values(y.data(), static_cast<Eigen::Index>(y.size()));
  Eigen::VectorXd q = solver_->transpose() * values;
  q += solver_->transpose() * (values - *rows_ * q);  // refined once
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
  Constraints constraints(*rows_, y, zone);
  const auto [x, multipliers, solved] =
      dual_simplex(objective_, active_, constraints, most_exchanges);
  Nearest nearest{x.head(rows_->cols()), {}, true};
  if (criterion_ == Criterion::maximum_inscribed) nearest.q = -nearest.q;
  const int turned = criterion_ == Criterion::maximum_inscribed ? -1 : 1;
  for (Eigen::Index j = 0; j < objective_.size(); ++j) {
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

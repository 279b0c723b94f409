// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <utility>

#include "diagnose/search/causes.hpp"
#include "diagnose/search/stepwise_search.hpp"
#include "math/linear_algebra.hpp"

namespace trueaxis::diagnose_detail {
namespace {

constexpr std::size_t levels = 2;                // constant lobes, and what growth adds
constexpr double left_alone = 1e-3;              // share of a column that must be left
constexpr double least2 = 1e-6;                  // the same of its square
constexpr int settles = 4;                       // rounds of orders and size
constexpr double steps[] = {0.06, 0.02, 0.007};  // of the shape
constexpr double least_gain = 0.1;               // of a step
// Share of the readings' root mean square that a place of the grid need not explain: a form that is
// off by half a step leaves more than the noise.
constexpr double coarse[] = {0.2, 0.05, 0.0};

/// Directions of columns beyond those of `q`, which they join.
Eigen::MatrixXd beyond(Eigen::MatrixXd& q, const Eigen::MatrixXd& columns) {
  const double whole = columns.colwise().norm().maxCoeff();
  const Eigen::MatrixXd own =
      linear::orthonormal_basis_above(linear::beside(q, columns), left_alone * whole);
  q.conservativeResize(Eigen::NoChange, q.cols() + own.cols());
  q.rightCols(own.cols()) = own;
  return own;
}

/// A form of some size and the lobes with it.
struct Fit {
  double criterion = 1e300, size = 0.0;
  std::vector<std::size_t> taken;  ///< of every order how many levels
};

class FormsWithLobes {
 public:
  FormsWithLobes(const LocalForms& forms, const std::vector<LobesOfOrder>& lobes)
      : forms_(forms), choice_(2.0 * std::log(static_cast<double>(lobes.size()))) {
    Eigen::MatrixXd q(forms.deviation_mm().size(), 0);
    base_ = beyond(q, forms.rows_of({}, true));
    for (const LobesOfOrder& order : lobes)
      for (std::size_t level = 0; level < levels; ++level)
        own_.push_back(level < order.size() ? beyond(q, forms.rows_of({order[level]}, false))
                                            : Eigen::MatrixXd(q.rows(), 0));
    log_readings_ = std::log(static_cast<double>(q.rows()));
    freedom_ = static_cast<double>(q.rows() - base_.cols());
    rest_freedom_ = std::max(static_cast<double>(q.rows() - q.cols()), 1.0);
    y_ = shares_of(forms.deviation_mm());
  }

  /// What is not explained at least, mm.
  void leave(double share) {
    double sum = y_.rest.squaredNorm();
    for (const Eigen::VectorXd& along : y_.along) sum += along.squaredNorm();
    left_alone2_ = share * share * sum;
  }

  Fit beside(const Hypothesis& form) const {
    const Shares f = shares_of(forms_.rows_of({form}, false).col(0));
    const Line rest = line_of(y_.rest, f.rest);
    std::vector<Line> along;
    for (std::size_t k = 0; k < own_.size(); ++k) along.push_back(line_of(y_.along[k], f.along[k]));
    Fit out;
    const auto begin_with = [&](const Line& one) {
      if (!(one.norm2 > least2 * f.whole2)) return;
      Fit fit = settled(rest, along, least2 * f.whole2, one.size);
      if (fit.criterion < out.criterion) out = std::move(fit);
    };
    begin_with(rest);
    for (const Line& one : along) begin_with(one);
    return out;
  }

 private:
  /// A column less the surface: along the lobes, level by level and order by order, and the rest.
  struct Shares {
    std::vector<Eigen::VectorXd> along;
    Eigen::VectorXd rest;
    double whole2 = 0.0;
  };
  Shares shares_of(const Eigen::VectorXd& column) const {
    Shares out;
    out.rest = column - base_ * (base_.transpose() * column);
    out.whole2 = column.squaredNorm();
    for (const Eigen::MatrixXd& own : own_) {
      out.along.push_back(own.transpose() * out.rest);
      out.rest -= own * out.along.back();
    }
    return out;
  }

  /// The square of what a form of a size leaves of readings, by the size that leaves least.
  struct Line {
    double size = 0.0, norm2 = 0.0, least = 0.0;
    double left2(double of_size) const {
      const double off = of_size - size;
      return least + norm2 * off * off;
    }
  };
  static Line line_of(const Eigen::VectorXd& y, const Eigen::VectorXd& f) {
    Line out{0.0, f.squaredNorm(), 0.0};
    if (out.norm2 > 0.0) out.size = y.dot(f) / out.norm2;
    out.least = (y - out.size * f).squaredNorm();
    return out;
  }

  /// The orders that are taken with that size of the form, the size which the others show, and so
  /// on.
  Fit settled(const Line& rest, const std::vector<Line>& along, double least_norm2,
              double size) const {
    Fit fit;
    fit.size = size;
    const auto left2 = [&](std::size_t k) { return along[k].left2(fit.size); };
    const auto price = [&](std::size_t k) {
      return log_readings_ * static_cast<double>(own_[k].cols());
    };
    double variance = rest.left2(size) / rest_freedom_ + left_alone2_ / freedom_;
    for (int round = 0; round < settles; ++round) {
      fit.taken.assign(own_.size() / levels, 0);
      double right = rest.size * rest.norm2, norm2 = rest.norm2, prices = 0.0;
      double freedom = rest_freedom_;
      for (std::size_t n = 0; n < fit.taken.size(); ++n) {
        double gain = -choice_, best = 0.0;
        for (std::size_t level = 0; level < levels; ++level) {
          gain += left2(levels * n + level) / variance - price(levels * n + level);
          if (gain > best) best = gain, fit.taken[n] = level + 1;
        }
        if (fit.taken[n] > 0) prices += choice_;
        for (std::size_t level = 0; level < levels; ++level) {
          const std::size_t k = levels * n + level;
          if (level < fit.taken[n]) {
            prices += price(k);
            continue;
          }
          right += along[k].size * along[k].norm2, norm2 += along[k].norm2;
          freedom += static_cast<double>(own_[k].cols());
        }
      }
      if (norm2 > least_norm2) fit.size = right / norm2;
      double rss = rest.left2(fit.size);
      for (std::size_t n = 0; n < fit.taken.size(); ++n)
        for (std::size_t level = fit.taken[n]; level < levels; ++level)
          rss += left2(levels * n + level);
      variance = rss / freedom + left_alone2_ / freedom_;
      rss = std::max(rss + left_alone2_, 1e-300);
      fit.criterion = freedom_ * std::log(rss) + prices;
    }
    return fit;
  }

  const LocalForms& forms_;
  double choice_, log_readings_ = 0.0, freedom_ = 0.0, rest_freedom_ = 0.0, left_alone2_ = 0.0;
  Eigen::MatrixXd base_;
  std::vector<Eigen::MatrixXd> own_;  ///< directions: order by order its levels
  Shares y_;
};

}  // namespace

std::vector<std::vector<Hypothesis>> forms_with_lobes(const Problem& problem,
                                                      const LocalForms& forms,
                                                      const std::vector<LobesOfOrder>& lobes,
                                                      std::size_t most) {
  struct Found {
    Hypothesis form;
    Fit fit;
  };
  FormsWithLobes fits(forms, lobes);
  const auto refine_at = [&](Found& found) {
    for (const double step : steps)
      for (bool moved = true; std::exchange(moved, false);)
        for (Hypothesis& near : neighbours(found.form, problem.point, step)) {
          keep_local(problem, near);
          Found now{near, fits.beside(near)};
          if (now.fit.criterion > found.fit.criterion - least_gain) continue;
          found = std::move(now);
          moved = true;
        }
  };
  std::vector<Found> best;
  for (const double share : coarse) {
    fits.leave(share);
    std::vector<Found> of_sizes(forms.sizes());
    for (std::size_t k = 0; k < forms.forms().size(); ++k) {
      Found now{forms.forms()[k], fits.beside(forms.forms()[k])};
      Found& of_size = of_sizes[forms.size_of(k)];
      if (now.fit.criterion < of_size.fit.criterion) of_size = std::move(now);
    }
    if (share > 0.0)
      for (Found& found : of_sizes) refine_at(found);
    best.insert(best.end(), of_sizes.begin(), of_sizes.end());
  }
  for (Found& found : best) {
    found.fit = fits.beside(found.form);
    refine_at(found);
  }
  std::ranges::stable_sort(best, {}, [](const Found& found) { return found.fit.criterion; });
  std::vector<std::vector<Hypothesis>> out;
  double before = -1e300;
  for (const Found& found : best) {
    if (out.size() == most || found.fit.taken.size() != lobes.size()) break;
    if (found.fit.criterion - before < least_gain) continue;  // the same, found twice
    before = found.fit.criterion;
    std::vector<Hypothesis>& terms = out.emplace_back();
    for (std::size_t n = 0; n < lobes.size(); ++n)
      if (found.fit.taken[n] > 0) terms.push_back(lobes[n][found.fit.taken[n] - 1]);
    terms.push_back(found.form);
  }
  return out;
}

}  // namespace trueaxis::diagnose_detail

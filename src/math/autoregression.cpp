// SPDX-License-Identifier: Apache-2.0
#include "math/autoregression.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "math/golden_section.hpp"
#include "math/gram.hpp"
#include "math/statistics.hpp"
#include "math/wide_gram.hpp"

namespace trueaxis {
namespace {

using Matrix = Eigen::MatrixXd;

constexpr double five_percent = 3.84;
constexpr std::size_t highest_order = 6;  // below longest_run of a mask
// Share of a column's square by which columns that nearly depend are told apart: without it a
// likelihood that could not be worked out was one of white noise.
constexpr double rounding = 1e-12;

/// The columns that are independent of those before them, by a Cholesky decomposition of the Gram
/// matrix without pivoting. It skips a column if its pivot vanishes: a singular normal matrix has
/// no likelihood.
std::vector<Eigen::Index> independent(const Matrix& gram) {
  std::vector<Eigen::Index> kept;
  Matrix left = gram;
  for (Eigen::Index j = 1; j < gram.rows(); ++j) {
    if (!(left(j, j) > 1e-6 * gram(j, j))) continue;
    kept.push_back(j);
    const Eigen::VectorXd column = left.col(j) / std::sqrt(left(j, j));
    left.noalias() -= column * column.transpose();
  }
  return kept;
}

/// The likelihoods of autoregressions after the independent columns of a Gram matrix.
class Likelihood {
 public:
  explicit Likelihood(const LaggedGram& gram)
      : all_columns_(gram.at(0, 0).rows() - 1),
        columns_(independent(gram.at(0, 0))),
        rows_(gram.rows()),
        first_rows_(gram.first_rows()),
        second_rows_(gram.second_rows()),
        whitened_(gram, columns_) {}

  /// Twice the restricted log likelihood, up to a constant (Eq. 65).
  double restricted2(double phi1, double phi2) {
    const auto r = regression(phi1, phi2);
    if (!r) return -1e300;
    const RunStart start({phi1, phi2});
    return -freedom() * std::log(r->rss) - r->logdet +
           2.0 * first_rows_ * std::log(start.scale(0)) +
           2.0 * second_rows_ * std::log(start.scale(1));
  }

  /// The noise and its residual.
  Autoregression with_remainder(std::vector<double> phi) {
    const auto r = regression(phi.empty() ? 0.0 : phi[0], phi.size() < 2 ? 0.0 : phi[1]);
    if (!r) return {std::move(phi), 0.0, 0.0, {}};
    return {std::move(phi), r->rss, freedom(), coefficients()};
  }

 private:
  /// Of the first column by the others.
  struct Regression {
    double rss, logdet;
  };
  std::optional<Regression> regression(double phi1, double phi2) {
    LowerTriangle& gram = whitened_.by(phi1, phi2);
    for (std::size_t j = 0; j < columns_.size(); ++j) gram(j, j) *= 1.0 + rounding;
    if (!gram.eliminate(columns_.size())) return {};
    Regression out{gram(columns_.size(), columns_.size()), 0.0};
    for (std::size_t j = 0; j < columns_.size(); ++j) out.logdet += 2.0 * std::log(gram(j, j));
    return out;
  }
  /// Those of the regression that was made last, from its Cholesky factor.
  Eigen::VectorXd coefficients() {
    const LowerTriangle& factor = whitened_.made();
    Eigen::VectorXd out = Eigen::VectorXd::Zero(all_columns_);
    for (std::size_t j = columns_.size(); j-- > 0;) {
      double sum = factor(columns_.size(), j);
      for (std::size_t i = j + 1; i < columns_.size(); ++i)
        sum -= factor(i, j) * out(columns_[i] - 1);
      out(columns_[j] - 1) = sum / factor(j, j);
    }
    return out;
  }
  double freedom() const { return rows_ - static_cast<double>(columns_.size()); }

  Eigen::Index all_columns_;
  std::vector<Eigen::Index> columns_;
  double rows_, first_rows_, second_rows_;
  WhitenedGram whitened_;
};

/// Where a likelihood is largest. (Brent's parabolas step over to another maximum: a slip of 100 µm
/// was then again a noise that rings.)
template <typename Function>
double maximise(const Function& f, double low, double high) {
  const GoldenSection found = golden_section(f, low, high, 16);
  return 0.5 * (found.low + found.high);
}

}  // namespace

LaggedGram::LaggedGram(Eigen::Index columns) {
  for (Lags* of : {&gram_, &first_, &second_})
    for (auto& line : *of) line.fill(Matrix::Zero(columns, columns));
}

LaggedColumns::LaggedColumns(const Matrix& x, std::span<const Eigen::Index> rows, std::size_t lags)
    : rows_(rows.size()), lags_(lags) {
  const std::size_t stride = (rows_ + 7) / 8 * 8, columns = static_cast<std::size_t>(x.cols());
  memory_ = hwy::AllocateAligned<double>(lags * columns * stride + 1);
  for (std::size_t lag = 0; lag < lags; ++lag) {
    for (Eigen::Index j = 0; j < x.cols(); ++j) {
      double* own = memory_.get() + column_.size() * stride;
      for (std::size_t i = 0; i < rows_; ++i)
        own[i] = x(rows[i] - static_cast<Eigen::Index>(lag), j);
      std::fill(own + rows_, own + stride, 0.0);
      column_.push_back(own);
    }
  }
}

/// Products of columns with each other, into those of the columns from `at` on.
void LaggedGram::add(const LaggedColumns& x, std::size_t at, Lags& to) {
  std::vector<double> lower(gram_size(x.all().size()), 0.0);
  add_wide_products({x.all(), x.rows()}, lower);
  for (std::size_t a = 0; a < x.lags(); ++a) {
    for (std::size_t b = a; b < x.lags(); ++b) {
      for (std::size_t i = 0; i < x.count(); ++i) {
        for (std::size_t j = 0; j < x.count(); ++j) {
          const std::size_t one = a * x.count() + i, other = b * x.count() + j;
          to[a][b](static_cast<Eigen::Index>(at + i), static_cast<Eigen::Index>(at + j)) +=
              lower[gram_index(std::max(one, other), std::min(one, other))];
        }
      }
    }
  }
}

void LaggedGram::add_cross(const LaggedColumns& before, const LaggedColumns& last, Lags& to) {
  const std::size_t there = before.count(), columns = before.all().size();
  std::vector<double> cross(last.all().size() * columns, 0.0);
  add_cross_products({last.all(), last.rows()}, {before.all(), before.rows()}, cross);
  const auto product = [&](std::size_t lag, std::size_t i, std::size_t lag_before, std::size_t j) {
    return cross[(lag * last.count() + i) * columns + lag_before * there + j];
  };
  for (std::size_t a = 0; a < last.lags(); ++a) {
    for (std::size_t b = a; b < last.lags(); ++b) {
      for (std::size_t i = 0; i < last.count(); ++i) {
        for (std::size_t j = 0; j < there; ++j) {
          const auto row = static_cast<Eigen::Index>(there + i),
                     column = static_cast<Eigen::Index>(j);
          to[a][b](row, column) += product(a, i, b, j);
          to[a][b](column, row) += product(b, i, a, j);
        }
      }
    }
  }
  add(last, there, to);
}

void LaggedGram::add(const Matrix& x, std::span<const Eigen::Index> rows) {
  add(LaggedColumns(x, rows, 3), 0, gram_);
  rows_ += static_cast<double>(rows.size());
}

void LaggedGram::add(const LaggedRows& rows) {
  add(rows.later, 0, gram_), add(rows.first, 0, first_), add(rows.second, 0, second_);
  rows_ += static_cast<double>(rows.later.rows());
  first_rows_ += static_cast<double>(rows.first.rows());
  second_rows_ += static_cast<double>(rows.second.rows());
}

void LaggedGram::add(const LaggedGram& other) {
  change(other, [](Matrix& to, const Matrix& from) { to += from; });
  rows_ += other.rows_;
  first_rows_ += other.first_rows_, second_rows_ += other.second_rows_;
}

LaggedGram LaggedGram::widened(Eigen::Index columns) const {
  LaggedGram out(columns);
  out.change(*this, [](Matrix& to, const Matrix& from) {
    to.topLeftCorner(from.rows(), from.cols()) = from;
  });
  out.rows_ = rows_, out.first_rows_ = first_rows_, out.second_rows_ = second_rows_;
  return out;
}

void LaggedGram::add_columns(const LaggedRows& before, const LaggedRows& last) {
  add_cross(before.later, last.later, gram_);
  add_cross(before.first, last.first, first_);
  add_cross(before.second, last.second, second_);
}

template <typename Change>
void LaggedGram::change(const LaggedGram& other, const Change& by) {
  constexpr std::array<Lags LaggedGram::*, 3> all{&LaggedGram::gram_, &LaggedGram::first_,
                                                  &LaggedGram::second_};
  for (const auto lags : all)
    for (std::size_t a = 0; a < 3; ++a)
      for (std::size_t b = a; b < 3; ++b) by((this->*lags)[a][b], (other.*lags)[a][b]);
}

void LaggedGram::add_transformed(const LaggedGram& other, const Matrix& t) {
  change(other, [&](Matrix& to, const Matrix& from) { to += t.transpose() * from * t; });
  rows_ += other.rows_;
  first_rows_ += other.first_rows_, second_rows_ += other.second_rows_;
}

WhitenedGram::WhitenedGram(const LaggedGram& gram, std::vector<Eigen::Index> columns)
    : whitened_(columns.size() + 1) {
  columns.push_back(0);
  const auto add = [&](Of rows, std::size_t a, std::size_t b, const Matrix& products) {
    LowerTriangle made(columns.size());
    for (std::size_t j = 0; j < columns.size(); ++j)
      for (std::size_t i = j; i < columns.size(); ++i)
        made(i, j) = a == b ? products(columns[i], columns[j])
                            : products(columns[i], columns[j]) + products(columns[j], columns[i]);
    parts_.push_back({rows, a, b, std::move(made)});
  };
  for (std::size_t a = 0; a < 3; ++a)
    for (std::size_t b = a; b < 3; ++b) add(Of::later, a, b, gram.gram_[a][b]);
  if (gram.first_rows_ > 0.0) add(Of::first, 0, 0, gram.first_[0][0]);
  for (std::size_t a = 0; a < 2 && gram.second_rows_ > 0.0; ++a)
    for (std::size_t b = a; b < 2; ++b) add(Of::second, a, b, gram.second_[a][b]);
}

LowerTriangle& WhitenedGram::by(double phi1, double phi2) {
  const RunStart start({phi1, phi2});
  const std::array<std::array<double, 3>, 3> weight{
      {{1.0, -phi1, -phi2},
       {start.scale(0), 0.0, 0.0},
       {start.scale(1), -start.scale(1) * start.phi(1)[0], 0.0}}};
  std::vector<LowerTriangle::Part> sum;
  for (const Part& part : parts_) {
    const std::array<double, 3>& of = weight[static_cast<std::size_t>(part.rows)];
    const double factor = of[part.a] * of[part.b];
    if (factor != 0.0) sum.push_back({factor, &part.products});
  }
  whitened_.become_sum(sum);
  return whitened_;
}

/// Levinson's recursion down: that of every lower order is the best predictor of its order.
RunStart::RunStart(const std::vector<double>& phi)
    : scale_(phi.size() + 1, 1.0), phi_(phi.size() + 1) {
  phi_.back() = phi;
  for (std::size_t k = phi.size(); k-- > 0;) {
    const std::vector<double>& above = phi_[k + 1];
    const double partial = above[k], left = 1.0 - partial * partial;
    for (std::size_t j = 0; j < k; ++j)
      phi_[k].push_back((above[j] + partial * above[k - 1 - j]) / left);
    scale_[k] = scale_[k + 1] * std::sqrt(left);
  }
}

std::vector<double> partial_correlations(const std::vector<double>& phi) {
  const RunStart lower(phi);
  std::vector<double> out;
  for (std::size_t k = 1; k <= phi.size(); ++k) out.push_back(lower.phi(k).back());
  return out;
}

std::vector<double> phi_of(const std::vector<double>& partial_correlations) {
  std::vector<double> phi;
  for (const double partial : partial_correlations) {
    const std::vector<double> below = phi;
    for (std::size_t j = 0; j < phi.size(); ++j) phi[j] -= partial * below[phi.size() - 1 - j];
    phi.push_back(partial);
  }
  return phi;
}

Autoregression find_autoregression(const LaggedGram& gram,
                                   const std::function<bool(double, double)>& is_form) {
  Likelihood of(gram);
  const double white = of.restricted2(0.0, 0.0);
  const double first = maximise([&](double p) { return of.restricted2(p, 0.0); }, -0.99, 0.995);
  const double one = of.restricted2(first, 0.0);
  // Partial correlations free the process stationary: φ₁ = a₁(1 − a₂), φ₂ = a₂.
  double a1 = first, a2 = 0.0;
  for (int round = 0; round < 2; ++round) {
    a2 = maximise([&](double p) { return of.restricted2(a1 * (1.0 - p), p); }, -0.99, 0.99);
    a1 = maximise([&](double p) { return of.restricted2(p * (1.0 - a2), a2); }, -0.99, 0.995);
  }
  const double two = of.restricted2(a1 * (1.0 - a2), a2);
  if (two - one > five_percent && two - white > 2.0 * five_percent && !is_form(a1 * (1.0 - a2), a2))
    return of.with_remainder({a1 * (1.0 - a2), a2});
  if (one - white > five_percent) return of.with_remainder({first});
  return of.with_remainder({});
}

Autoregression with_higher_orders(Autoregression second,
                                  std::span<const std::vector<double>> residual_runs) {
  struct Lattice {
    std::vector<double> forward, backward;  ///< errors of either prediction
  };
  std::vector<Lattice> runs;
  for (const std::vector<double>& run : residual_runs) runs.push_back({run, run});
  const auto raise = [&](double partial) {
    for (Lattice& run : runs)
      for (std::size_t i = run.forward.size(); i-- > 0;) {
        const double before = i > 0 ? run.backward[i - 1] : 0.0;
        run.backward[i] = before - partial * run.forward[i];
        run.forward[i] -= partial * before;
      }
  };
  std::vector<double> partials = partial_correlations(second.phi);
  for (const double partial : partials) raise(partial);
  while (partials.size() < highest_order) {
    double both = 0.0, squares = 0.0, count = 0.0;
    for (const Lattice& run : runs)
      for (std::size_t i = partials.size() + 1; i < run.forward.size(); ++i) {
        const double ahead = run.forward[i], behind = run.backward[i - 1];
        both += 2.0 * ahead * behind, squares += ahead * ahead + behind * behind, ++count;
      }
    const double partial = squares > 0.0 ? both / squares : 0.0;
    const double left = 1.0 - partial * partial;
    if (!(-count * std::log(left) > five_percent)) break;
    partials.push_back(partial);
    second.rss *= left;
    raise(partial);
  }
  second.phi = phi_of(partials);
  return second;
}

bool rings_with_spindle(double phi1, double phi2, std::span<const double> c_rad) {
  constexpr double lasting = 0.8, off_order = 0.1;  // radius of the poles; of an order
  constexpr double widest = 4.0;                    // orders: 0.8 at 110 readings per revolution
  const double radius = std::sqrt(-phi2);
  if (phi1 * phi1 + 4.0 * phi2 >= 0.0 || radius < lasting) return false;
  std::vector<double> step_rad;
  for (std::size_t i = 1; i < c_rad.size(); ++i) {
    const double step = std::abs(c_rad[i] - c_rad[i - 1]);
    if (step > 0.0 && step < std::numbers::pi) step_rad.push_back(step);
  }
  if (step_rad.empty()) return false;
  const double step = median(step_rad), order = std::acos(0.5 * phi1 / radius) / step;
  if (-std::log(radius) / step > widest) return false;
  return std::round(order) >= 1.0 && std::abs(order - std::round(order)) < off_order;
}

double variance_over_innovation(const std::vector<double>& phi) {
  return 1.0 / std::pow(RunStart(phi).scale(0), 2);
}

}  // namespace trueaxis

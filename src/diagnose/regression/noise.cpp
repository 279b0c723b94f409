// SPDX-License-Identifier: Apache-2.0
#include "diagnose/regression/noise.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "math/statistics.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis::diagnose_detail {
namespace {

using Matrix = Eigen::MatrixXd;

constexpr double far_out = 8.0;  // MAD σ; a real local form peaks at 4.5 σ
constexpr double clings = 3.0;   // beside a reading far out
constexpr std::size_t chunk = 512;
constexpr std::size_t enough_rows = 6000;  // φ to 0.013, a tenth of what matters
constexpr std::size_t least_rows = 200;
constexpr double five_percent = 3.84;

/// Gram matrices of the rows shifted by a and b readings, over the same rows.
struct Lagged {
  std::array<std::array<Matrix, 3>, 3> gram;
  double rows = 0.0;

  Matrix whitened(double phi1, double phi2) const {
    const double c[3] = {1.0, -phi1, -phi2};
    Matrix sum = Matrix::Zero(gram[0][0].rows(), gram[0][0].cols());
    for (std::size_t a = 0; a < 3; ++a) {
      sum += c[a] * c[a] * gram[a][a];
      for (std::size_t b = a + 1; b < 3; ++b) {
        if (c[a] * c[b] == 0.0) continue;
        sum += c[a] * c[b] * (gram[a][b] + gram[a][b].transpose());
      }
    }
    return sum;
  }

  /// Of the regression by the columns behind the first.
  struct Regression {
    double rss, logdet;
    Eigen::Index columns;
  };
  std::optional<Regression> regression(double phi1, double phi2) const {
    const Matrix all = whitened(phi1, phi2);
    const Eigen::Index m = all.rows() - 1;
    const Matrix normal = all.bottomRightCorner(m, m);
    const Eigen::LLT<Matrix> factor(normal);
    if (factor.info() != Eigen::Success) return {};
    const Eigen::VectorXd half = factor.matrixL().solve(all.col(0).tail(m));
    return Regression{all(0, 0) - half.squaredNorm(),
                      2.0 * factor.matrixLLT().diagonal().array().log().sum(), m};
  }

  /// Twice the restricted log likelihood, up to a constant (Patterson and Thompson 1971) (Eq. 65).
  double likelihood2(double phi1, double phi2) const {
    const auto r = regression(phi1, phi2);
    if (!r) return -1e300;
    return -(rows - static_cast<double>(r->columns)) * std::log(r->rss) - r->logdet;
  }

  /// The noise with −2 ln of its likelihood, not the restricted one: models with other columns are
  /// compared by it.
  Autoregression with_deviance(std::vector<double> phi) const {
    const auto r = regression(phi.empty() ? 0.0 : phi[0], phi.size() < 2 ? 0.0 : phi[1]);
    return {std::move(phi), r ? rows * std::log(r->rss) : 1e300};
  }
};

/// Where a likelihood is largest, by the golden section. (Brent's parabolas step over to another
/// maximum: a slip of 100 µm was then again a noise that rings.)
template <typename Function>
double maximise(Function f, double low, double high) {
  constexpr double golden = 0.6180339887498949;
  double a = high - golden * (high - low), b = low + golden * (high - low);
  double fa = f(a), fb = f(b);
  for (int i = 0; i < 16; ++i) {
    if (fa > fb) {
      high = b, b = a, fb = fa, a = high - golden * (high - low), fa = f(a);
    } else {
      low = a, a = b, fa = fb, b = low + golden * (high - low), fb = f(b);
    }
  }
  return 0.5 * (low + high);
}

/// Columns [deviation | base | terms] of some readings, scaled to unit size and made independent.
Matrix columns_of_rows(const LinearisationPoint& point, std::span<const double> deviation,
                       std::span<const Hypothesis> terms, std::size_t begin, std::size_t end) {
  const std::size_t base = point.base.columns(), count = 1 + base + columns_of(terms);
  Matrix out(static_cast<Eigen::Index>(end - begin), static_cast<Eigen::Index>(count));
  std::vector<double*> column(count);
  for (std::size_t j = 0; j < count; ++j)
    column[j] = out.data() + static_cast<Eigen::Index>(j) * out.rows();
  std::copy(deviation.begin() + static_cast<long>(begin),
            deviation.begin() + static_cast<long>(end), column[0]);
  for (std::size_t from = begin; from < end;) {
    std::size_t to = from + 1;
    while (to < end && point.rear[to] == point.rear[from]) ++to;
    std::vector<double*> here(column);
    for (double*& c : here) c += from - begin;
    point.fill_base(from, to, {here.data() + 1, base});
    std::size_t next = 1 + base;
    for (const Hypothesis& h : terms) {
      fill(h, point, from, to, {here.data() + next, h.columns()});
      next += h.columns();
    }
    from = to;
  }
  return out;
}

/// The columns that are independent beside those before them, by a Cholesky decomposition of the
/// Gram matrix without pivoting that leaves out where its pivot vanishes: a singular normal matrix
/// has no likelihood.
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

/// Whether an autoregression of the second order rings with the spindle: nothing random does, but
/// what turns with it and is not explained yet looks so.
bool rings_with_spindle(const LinearisationPoint& point, double phi1, double phi2) {
  constexpr double lasting = 0.8, off_order = 0.1;  // radius of the poles; of an order
  if (phi1 * phi1 + 4.0 * phi2 >= 0.0 || std::sqrt(-phi2) < lasting) return false;
  std::vector<double> step_rad;
  for (std::size_t i = 1; i < point.size(); ++i) {
    const double step = std::abs(point.c[i] - point.c[i - 1]);
    if (step > 0.0 && step < 0.5 * two_pi) step_rad.push_back(step);
  }
  if (step_rad.empty()) return false;
  const double order = std::acos(0.5 * phi1 / std::sqrt(-phi2)) / median(step_rad);
  return std::round(order) >= 1.0 && std::abs(order - std::round(order)) < off_order;
}

}  // namespace

std::vector<double> remainder(const LinearisationPoint& point, std::span<const double> deviation_mm,
                              std::span<const Hypothesis> terms, const Eigen::VectorXd& solution) {
  std::vector<double> out(point.size());
  for (std::size_t begin = 0; begin < point.size(); begin += chunk) {
    const std::size_t end = std::min(begin + chunk, point.size());
    const Matrix columns = columns_of_rows(point, deviation_mm, terms, begin, end);
    const Eigen::VectorXd left = columns.col(0) - columns.rightCols(columns.cols() - 1) * solution;
    std::copy(left.data(), left.data() + left.size(), out.begin() + static_cast<long>(begin));
  }
  return out;
}

std::vector<Rejected> mask_outliers(const LinearisationPoint& point,
                                    std::span<const Hypothesis> basis,
                                    std::span<const double> deviation_mm, ObservationMask& mask,
                                    int threads) {
  std::vector<double> left(deviation_mm.begin(), deviation_mm.end());
  double sigma = 0.0;
  std::size_t masked = 0;
  for (int round = 0; round < 6; ++round) {
    sigma = mad_sigma(left);
    std::vector<char> used(point.size(), 1);
    const auto outside = [&](std::size_t i, double times) {
      return std::abs(left[i]) > times * sigma;
    };
    for (std::size_t i = 0; i < point.size(); ++i) used[i] = !outside(i, far_out);
    for (std::size_t i = 1; i < point.size(); ++i)
      if (!used[i - 1] && outside(i, clings)) used[i] = 0;
    for (std::size_t i = point.size() - 1; i-- > 0;)
      if (!used[i + 1] && outside(i, clings)) used[i] = 0;
    const auto count = static_cast<std::size_t>(std::ranges::count(used, 0));
    if (count * 3 > point.size()) break;  // not outliers: the surface is another one
    const bool same = round > 0 && used == mask.used;
    mask.used = std::move(used);
    masked = count;
    if (same || (round == 0 && masked == 0 && point.size() < least_rows)) break;
    mask.find_runs(point);
    NormalEquations equations(point, mask, deviation_mm, {}, threads);
    Columns all = equations.base();
    for (const Columns& own : equations.append(basis))
      all.insert(all.end(), own.begin(), own.end());
    left = remainder(point, deviation_mm, basis, solve(equations.total(), all).coefficients);
  }
  mask.find_runs(point);
  std::vector<Rejected> list;
  for (std::size_t i = 0; i < point.size() && masked > 0; ++i) {
    if (mask.used[i]) continue;
    list.push_back({i + 1, fmt::format("{:.3g} µm off, {:.1f} σ", left[i] / mm_per_um,
                                       std::abs(left[i]) / sigma)});
  }
  return list;
}

Autoregression autoregression(const LinearisationPoint& point, const ObservationMask& mask,
                              std::span<const double> deviation_mm,
                              std::span<const Hypothesis> terms) {
  Lagged lagged;
  const auto columns = static_cast<Eigen::Index>(1 + point.base.columns() + columns_of(terms));
  for (auto& line : lagged.gram) line.fill(Matrix::Zero(columns, columns));
  std::size_t available = 0;
  for (std::size_t f = 0; f < mask.folds(); ++f)
    available += std::min(mask.fold_begin[f + 1] - mask.fold_begin[f], enough_rows / 4);
  const std::size_t stride = 1 + available / (2 * enough_rows);
  for (std::size_t f = 0; f < mask.folds(); f += stride) {
    // A block of a long stream is cut: whole blocks would be more than enough.
    const std::size_t begin = mask.fold_begin[f];
    const std::size_t end = std::min(mask.fold_begin[f + 1], begin + enough_rows / 4);
    const Matrix x = columns_of_rows(point, deviation_mm, terms, begin, end);
    std::vector<Eigen::Index> good;
    for (std::size_t i = begin + 2; i < end; ++i) {
      if (mask.used[i] && mask.run[i] >= 2) good.push_back(static_cast<Eigen::Index>(i - begin));
    }
    const auto n = static_cast<Eigen::Index>(good.size());
    Matrix at[3];
    for (Eigen::Index lag = 0; lag < 3; ++lag) {
      at[lag].resize(n, columns);
      for (Eigen::Index i = 0; i < n; ++i)
        at[lag].row(i) = x.row(good[static_cast<std::size_t>(i)] - lag);
    }
    for (std::size_t a = 0; a < 3; ++a) {
      for (std::size_t b = a; b < 3; ++b) lagged.gram[a][b].noalias() += at[a].transpose() * at[b];
    }
    lagged.rows += static_cast<double>(n);
  }
  if (lagged.rows < static_cast<double>(least_rows)) return {};
  std::vector<Eigen::Index> kept = independent(lagged.gram[0][0]);
  kept.insert(kept.begin(), 0);
  for (std::size_t a = 0; a < 3; ++a) {
    for (std::size_t b = a; b < 3; ++b) lagged.gram[a][b] = Matrix(lagged.gram[a][b](kept, kept));
  }
  const double white = lagged.likelihood2(0.0, 0.0);
  const double first = maximise([&](double p) { return lagged.likelihood2(p, 0.0); }, -0.99, 0.995);
  const double one = lagged.likelihood2(first, 0.0);
  // Partial correlations free the process stationary: φ₁ = a₁(1 − a₂), φ₂ = a₂.
  double a1 = first, a2 = 0.0;
  for (int round = 0; round < 2; ++round) {
    a2 = maximise([&](double p) { return lagged.likelihood2(a1 * (1.0 - p), p); }, -0.99, 0.99);
    a1 = maximise([&](double p) { return lagged.likelihood2(p * (1.0 - a2), a2); }, -0.99, 0.995);
  }
  const double two = lagged.likelihood2(a1 * (1.0 - a2), a2);
  if (two - one > five_percent && two - white > 2.0 * five_percent &&
      !rings_with_spindle(point, a1 * (1.0 - a2), a2))
    return lagged.with_deviance({a1 * (1.0 - a2), a2});
  if (one - white > five_percent) return lagged.with_deviance({first});
  return lagged.with_deviance({});
}

}  // namespace trueaxis::diagnose_detail

// SPDX-License-Identifier: Apache-2.0
#include "diagnose/search/scan_steps.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "diagnose/regression/noise.hpp"
#include "diagnose/search/causes.hpp"

namespace trueaxis::diagnose_detail {
namespace {

using Matrix = Eigen::MatrixXd;
using Index = Eigen::Index;
using Three = Eigen::Matrix3d;

constexpr Index least_readings = 4;  // before and after a step: fewer are outliers
constexpr double absorbed = 1e-6;  // share of a column's square below which base and terms hold it
constexpr double undetermined = 1e-11;

/// Whether a row is one of the noise model's: it and those that predict it are there.
bool counts(const ObservationMask& mask, std::size_t row, std::size_t lags) {
  return mask.used[row] && mask.run[row] >= lags;
}

/// [readings | base | terms | step], as they are and whitened.
struct Rows {
  Matrix raw, white;
};
Rows rows_of(const Problem& problem, const std::vector<double>& phi,
             const std::vector<Hypothesis>& columns) {
  Rows out;
  const std::size_t size = problem.point.size();
  out.raw.resize(static_cast<Index>(size),
                 static_cast<Index>(1 + problem.point.base.columns() + columns_of(columns)));
  for (std::size_t begin = 0; begin < size; begin += most_rows) {
    const std::size_t end = std::min(begin + most_rows, size);
    out.raw.middleRows(static_cast<Index>(begin), static_cast<Index>(end - begin)) =
        columns_of_rows(problem.point, problem.deviation_mm, columns, begin, end);
  }
  out.white = Matrix::Zero(out.raw.rows(), out.raw.cols());
  for (Index i = 0; i < out.raw.rows(); ++i) {
    if (!counts(problem.mask, static_cast<std::size_t>(i), phi.size())) continue;
    out.white.row(i) = out.raw.row(i);
    for (std::size_t j = 0; j < phi.size(); ++j)
      out.white.row(i) -= phi[j] * out.raw.row(i - static_cast<Index>(j) - 1);
  }
  return out;
}

/// An orthonormal basis of some columns.
Matrix orthonormal(const Matrix& columns) {
  const Eigen::VectorXd scale = columns.colwise().norm().cwiseMax(1e-300).cwiseInverse();
  const Matrix unit = scale.asDiagonal() * (columns.transpose() * columns) * scale.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Matrix> eigen(unit);
  const Index there = (eigen.eigenvalues().array() > undetermined).count();
  return columns * (scale.asDiagonal() * eigen.eigenvectors().rightCols(there) *
                    eigen.eigenvalues().tail(there).cwiseSqrt().cwiseInverse().asDiagonal());
}

/// What the columns of a form take off the sum of squares.
double gain_of(const std::vector<std::size_t>& form, const Three& left,
               const Eigen::Vector3d& right, const Eigen::Vector3d& whole) {
  double gain = 0.0;
  Three rest = left;
  Eigen::Vector3d along = right;
  for (const std::size_t free : form) {  // a Cholesky step each
    const auto j = static_cast<Index>(free);
    if (!(rest(j, j) > absorbed * whole(j))) continue;
    gain += along(j) * along(j) / rest(j, j);
    const Eigen::Vector3d share = rest.col(j) / rest(j, j);
    along -= share * along(j);
    rest -= share * rest.row(j).eval();
  }
  return gain;
}

/// Dates one effect.
std::vector<Hypothesis> dated(const Problem& problem, const std::vector<double>& phi,
                              const std::vector<Hypothesis>& terms, const Effect& effect) {
  const LinearisationPoint& point = problem.point;
  TermShape never = typical_shape(effect, point);
  never.onset_s = 1e300;
  std::vector<Hypothesis> all(terms);
  all.push_back(of_effect(effect, never));
  const Rows rows = rows_of(problem, phi, all);
  const Matrix step_raw = rows.raw.rightCols(3), step = rows.white.rightCols(3);
  const Matrix taken = orthonormal(rows.white.middleCols(1, rows.white.cols() - 4));
  const Eigen::VectorXd left = rows.white.col(0) - taken * (taken.transpose() * rows.white.col(0));
  const std::vector<Form>& forms = effect.search.forms;
  std::vector<double> best(forms.size(), 0.0);
  std::vector<Index> date(forms.size(), 0);
  Three gram = Three::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  Matrix cross = Matrix::Zero(3, taken.cols());
  const Index size = rows.raw.rows(), lags = static_cast<Index>(phi.size());
  for (Index k = 1; k + least_readings <= size; ++k) {
    const auto add = [&](Index row, const Eigen::Vector3d& own, Three& to, Matrix& to_cross,
                         Eigen::Vector3d& to_right) {
      to += own * own.transpose();
      to_cross.noalias() += own * taken.row(row);
      to_right += own * left(row);
    };
    add(k - 1, step.row(k - 1), gram, cross, right);
    if (k < least_readings ||
        point.time[static_cast<std::size_t>(k)] <= point.time[static_cast<std::size_t>(k - 1)])
      continue;
    // Readings just after the step are predicted from those before it.
    Three own = gram;
    Matrix own_cross = cross;
    Eigen::Vector3d own_right = right;
    for (Index row = k; row < std::min(size, k + lags); ++row) {
      if (!counts(problem.mask, static_cast<std::size_t>(row), phi.size())) continue;
      Eigen::Vector3d before = Eigen::Vector3d::Zero();
      for (Index lag = row - k + 1; lag <= lags; ++lag)
        before -= phi[static_cast<std::size_t>(lag - 1)] * step_raw.row(row - lag).transpose();
      add(row, before, own, own_cross, own_right);
    }
    const Eigen::Vector3d whole = own.diagonal();
    own.noalias() -= own_cross * own_cross.transpose();
    for (std::size_t f = 0; f < forms.size(); ++f) {
      const double gain =
          gain_of(forms[f].free.empty() ? std::vector<std::size_t>{0, 1, 2} : forms[f].free, own,
                  own_right, whole);
      if (gain > best[f]) best[f] = gain, date[f] = k;
    }
  }
  std::vector<Hypothesis> out;
  for (std::size_t f = 0; f < forms.size(); ++f) {
    if (date[f] == 0) continue;
    const auto k = static_cast<std::size_t>(date[f]);
    TermShape shape = never;
    shape.onset_s = 0.5 * (point.time[k - 1] + point.time[k]);
    out.push_back(of_effect(effect, shape, forms[f].free, effect.search.tests));
  }
  return out;
}

}  // namespace

std::vector<Hypothesis> scan_steps(const Problem& problem, const std::vector<double>& phi,
                                   const std::vector<Hypothesis>& terms, double& tests) {
  std::vector<Hypothesis> out;
  tests = 0.0;
  for (const Effect* effect : problem.effects) {
    if (!is_step(effect->term)) continue;
    tests += effect->search.tests * static_cast<double>(effect->search.forms.size());
    for (Hypothesis& h : dated(problem, phi, terms, *effect)) out.push_back(std::move(h));
  }
  return out;
}

}  // namespace trueaxis::diagnose_detail

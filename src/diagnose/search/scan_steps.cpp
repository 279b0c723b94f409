// SPDX-License-Identifier: Apache-2.0
#include "diagnose/search/scan_steps.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "diagnose/regression/noise.hpp"
#include "diagnose/regression/size_prior.hpp"
#include "diagnose/search/causes.hpp"
#include "math/linear_algebra.hpp"

namespace trueaxis::diagnose_detail {
namespace {

using Matrix = Eigen::MatrixXd;
using ByRows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using Index = Eigen::Index;
constexpr int most_columns = 7;  // of a step
using Square = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, most_columns, most_columns>;
using Vector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, most_columns, 1>;

constexpr double absorbed = 1e-6;  // share of a column's square below which base and terms hold it
constexpr double undetermined = 1e-11;
constexpr double seen_step =
    24.0;  // σ² of the sum of squares: less is not a step among so many tests
constexpr std::size_t per_column = least_beside_step / 2;  // readings next to a step of two sizes
constexpr std::size_t few = 16;  // readings per column: with so few on a side two are ignored
constexpr double kept = 0.25;    // share of the gain that is there without them: of eight (6/8)²
constexpr double lasting[] = {1.0 / 32.0, 1.0 / 16.0, 1.0 / 8.0, 1.0 / 4.0};  // of all time
constexpr Index most_dates = 4096;  // tried at first, then those about the best
constexpr double as_likely = 12.0;  // σ² of the sum of squares: dates among which sizes decide

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
  out.raw = columns_of_rows(problem.point, problem.deviation_mm, columns, 0, problem.point.size());
  out.white = Matrix::Zero(out.raw.rows(), out.raw.cols());
  for (Index c = 0; c < out.raw.cols(); ++c) {
    for (Index i = 0; i < out.raw.rows(); ++i) {
      if (!counts(problem.mask, static_cast<std::size_t>(i), phi.size())) continue;
      double value = out.raw(i, c);
      for (std::size_t j = 0; j < phi.size(); ++j)
        value -= phi[j] * out.raw(i - static_cast<Index>(j) - 1, c);
      out.white(i, c) = value;
    }
  }
  return out;
}

/// An orthonormal basis of some columns.
ByRows orthonormal(const Matrix& columns) {
  const Eigen::VectorXd scale = columns.colwise().norm().cwiseMax(1e-300).cwiseInverse();
  const Matrix unit = scale.asDiagonal() * (columns.transpose() * columns) * scale.asDiagonal();
  const auto [values, vectors] = linear::spectrum(unit);
  const Index there = (values.array() > undetermined).count();
  return columns * (scale.asDiagonal() * vectors.rightCols(there) *
                    values.tail(there).cwiseSqrt().cwiseInverse().asDiagonal());
}

/// A step before a reading: what base and terms leave of its columns.
struct Date {
  std::size_t reading;
  Square gram;
  Vector right, whole;  ///< products with the residuals; squares of the columns themselves
  Vector without;       ///< products without the two largest readings of a short side
  struct Settled {
    Square gram;
    Vector right;
  };
  /// Without the readings at the step that are predicted across it; none: noise is white.
  std::optional<Settled> settled;
};

/// The two readings that are farthest off on the shorter side of a step before the k-th.
std::array<Index, 2> two_largest(const Eigen::VectorXd& left, Index k) {
  const bool first = 2 * k < left.size();
  std::array<Index, 2> out{first ? 0 : k, first ? 1 : k + 1};
  const auto smaller = [&](Index a, Index b) { return std::abs(left(a)) < std::abs(left(b)); };
  for (Index row = out[1] + 1; row < (first ? k : left.size()); ++row) {
    Index& least = smaller(out[0], out[1]) ? out[0] : out[1];
    if (smaller(least, row)) least = row;
  }
  return out;
}

/// Readings that a step may come before.
struct Window {
  Index from, to, every = 1;
  bool has(Index k) const { return k >= from && k <= to && (k - from) % every == 0; }
};

/// Steps between two readings of a window that have enough on both sides.
std::vector<Date> dates_of(const Problem& problem, const std::vector<double>& phi, const Rows& rows,
                           const ByRows& taken, const Eigen::VectorXd& left, Index columns,
                           const Window& window) {
  const std::span<const double> time = problem.point.time;
  const Matrix step_raw = rows.raw.rightCols(columns), step = rows.white.rightCols(columns);
  const auto least = static_cast<Index>(least_beside_step);
  const Index size = rows.raw.rows(), lags = static_cast<Index>(phi.size());
  struct Sums {
    Square gram;
    Vector right;
    Matrix cross;
  };
  const auto add = [&](Index row, const Vector& own, Sums& to) {
    to.gram += own * own.transpose();
    to.cross.noalias() += own * taken.row(row);
    to.right += own * left(row);
  };
  const auto remaining = [](const Sums& of) -> Square {
    return of.gram - of.cross * of.cross.transpose();
  };
  std::vector<Date> out;
  Sums before{Square::Zero(columns, columns), Vector::Zero(columns),
              Matrix::Zero(columns, taken.cols())};
  Sums with_after;
  for (Index k = 1; k + least <= std::min(size, window.to + least); ++k) {
    const auto reading = static_cast<std::size_t>(k);
    add(k - 1, step.row(k - 1), before);
    if (k < least || !window.has(k) || !(time[reading] > time[reading - 1])) continue;
    if (lags > 0) with_after = before;
    // Readings just after the step are predicted from those before it.
    for (Index row = k; row < std::min(size, k + lags); ++row) {
      if (!counts(problem.mask, static_cast<std::size_t>(row), phi.size())) continue;
      Vector own = Vector::Zero(columns);
      for (Index lag = row - k + 1; lag <= lags; ++lag)
        own -= phi[static_cast<std::size_t>(lag - 1)] * step_raw.row(row - lag).transpose();
      add(row, own, with_after);
    }
    const Sums& sums = lags > 0 ? with_after : before;
    out.push_back({reading, remaining(sums), sums.right, sums.gram.diagonal(), sums.right, {}});
    if (lags > 0) out.back().settled = {remaining(before), before.right};
    if (std::min(k, size - k) > static_cast<Index>(few) * columns) continue;
    for (const Index row : two_largest(left, k))
      out.back().without -= left(row) * ((row < k ? 1.0 : 0.0) * step.row(row).transpose() -
                                         sums.cross * taken.row(row).transpose());
  }
  return out;
}

/// What the columns of a form take off the sum of squares: a step of Cholesky's each.
double gain_of(const std::vector<Index>& form, const Date& date, const Square& gram,
               const Vector& right) {
  std::array<std::array<double, most_columns>, most_columns> rest;
  std::array<double, most_columns> along;
  const std::size_t m = form.size();
  for (std::size_t i = 0; i < m; ++i) {
    along[i] = right(form[i]);
    for (std::size_t j = i; j < m; ++j) rest[i][j] = gram(form[i], form[j]);
  }
  double gain = 0.0;
  for (std::size_t j = 0; j < m; ++j) {
    if (!(rest[j][j] > absorbed * date.whole(form[j]))) continue;
    gain += along[j] * along[j] / rest[j][j];
    for (std::size_t i = j + 1; i < m; ++i) {
      const double share = rest[j][i] / rest[j][j];
      along[i] -= share * along[j];
      for (std::size_t k = i; k < m; ++k) rest[i][k] -= share * rest[j][k];
    }
  }
  return gain;
}

/// The most likely date of a form, by their plausible sizes, among those that explain as much
/// within the noise. A step at a standing spindle shows along the probe alone.
const Date* most_likely(const std::vector<Index>& form, const SizePrior& prior,
                        const std::vector<Date>& dates, std::size_t size, double rss,
                        double freedom) {
  std::vector<double> gains;
  const std::size_t fewest = per_column * std::max<std::size_t>(form.size(), 2);
  for (const Date& date : dates) {
    const double gain = gain_of(form, date, date.gram, date.right);
    const std::size_t side = std::min(date.reading, size - date.reading);
    const bool of_outliers = side <= few * std::max<std::size_t>(form.size(), 2) &&
                             gain_of(form, date, date.gram, date.without) < kept * gain;
    const bool of_few = side < fewest;
    // In correlated noise one large innovation looks like a step, and dies out.
    const bool passes =
        date.settled && gain_of(form, date, date.settled->gram, date.settled->right) <
                            std::min(gain, seen_step * std::max(rss - gain, 0.0) / freedom);
    gains.push_back(of_outliers || of_few || passes ? 0.0 : gain);
  }
  const auto top = std::ranges::max_element(gains);
  if (top == gains.end() || !(*top > 0.0)) return nullptr;
  const double variance = std::max(rss - *top, 0.0) / freedom;
  if (*top < seen_step * variance) return &dates[static_cast<std::size_t>(top - gains.begin())];
  const double near = *top - as_likely * variance;
  const Date* best = nullptr;
  double least = 1e300;
  for (std::size_t i = 0; i < dates.size(); ++i) {
    if (!(gains[i] > 0.0) || gains[i] < near) continue;
    const double criterion = weigh(prior, dates[i].gram(form, form), dates[i].right(form),
                                   dates[i].whole(form), rss, freedom)
                                 .criterion;
    if (criterion < least) least = criterion, best = &dates[i];
  }
  return best;
}

/// The same as what lasts some time, about its date. In less than a turn each angle is met once:
/// what lasts no longer may be a form.
void add_lasting(const Hypothesis& step, const Problem& problem, std::vector<Hypothesis>& list) {
  const LinearisationPoint& point = problem.point;
  const double all_s = point.time.back() - point.time.front();
  for (const double share : lasting) {
    if (share * problem.resolution.turns < 1.0) continue;
    Hypothesis slow = step;
    slow.shape.duration_s = share * all_s;
    slow.shape.onset_s = std::clamp(step.shape.onset_s - 0.5 * slow.shape.duration_s,
                                    point.time.front(), point.time.back() - slow.shape.duration_s);
    slow.tests *= std::size(lasting);
    list.push_back(std::move(slow));
  }
}

/// Dates one effect.
std::vector<Hypothesis> dated(const Problem& problem, const std::vector<double>& phi,
                              const std::vector<Hypothesis>& terms, const Effect& effect) {
  const std::span<const double> time = problem.point.time;
  TermShape shape = typical_shape(effect, problem.point);
  shape.onset_s = 1e300;
  std::vector<Hypothesis> all(terms);
  all.push_back(of_effect(effect, shape));
  const Rows rows = rows_of(problem, phi, all);
  const auto columns = static_cast<Index>(all.back().columns());
  const ByRows taken = orthonormal(rows.white.middleCols(1, rows.white.cols() - 1 - columns));
  const Eigen::VectorXd left = rows.white.col(0) - taken * (taken.transpose() * rows.white.col(0));
  const auto dates_in = [&](const Window& window) {
    return dates_of(problem, phi, rows, taken, left, columns, window);
  };
  const Index every = 1 + rows.white.rows() / most_dates;
  const std::vector<Date> dates = dates_in({0, rows.white.rows(), every});
  std::vector<Hypothesis> out;
  for (const SearchForm& form : effect.search.forms) {
    if (problem.resolution.degrees < form.degrees) continue;
    Hypothesis h = of_effect(effect, shape, form.free, effect.search.tests);
    std::vector<Index> free;
    for (std::size_t j = 0; j < h.columns(); ++j)
      free.push_back(static_cast<Index>(form.free.empty() ? j : form.free[j]));
    const auto likely_of = [&](const std::vector<Date>& some) {
      return most_likely(free, size_prior(h), some, time.size(), left.squaredNorm(),
                         std::max(1.0, static_cast<double>(rows.white.rows() - taken.cols())));
    };
    const Date* date = likely_of(dates);
    if (date == nullptr) continue;
    std::vector<Date> near;
    if (every > 1) {
      const auto at = static_cast<Index>(date->reading);
      near = dates_in({at - every, at + every});
      date = likely_of(near);
      if (date == nullptr) continue;
    }
    h.shape.onset_s = 0.5 * (time[date->reading - 1] + time[date->reading]);
    out.push_back(h);
    add_lasting(h, problem, out);
  }
  return out;
}

}  // namespace

std::vector<Hypothesis> scan_steps(const Problem& problem, const std::vector<double>& phi,
                                   const std::vector<Hypothesis>& terms, double& tests) {
  std::vector<Hypothesis> out;
  tests = 0.0;
  for (const Effect* effect : problem.effects) {
    if (!is_step(effect->term) || effect->search.when != SearchRange::When::scanned) continue;
    // Twice as long, half as many dates: those that last are as many again.
    tests += 2.0 * effect->search.tests * static_cast<double>(effect->search.forms.size());
    for (Hypothesis& h : dated(problem, phi, terms, *effect)) out.push_back(std::move(h));
  }
  return out;
}

void erase_other_durations(std::vector<Candidate>& list) {
  const auto lasts = [](const Candidate& c) { return c.hypothesis.shape.duration_s > 0.0; };
  std::vector<Candidate> kept;
  for (Candidate& c : list) {
    const auto other = [&](const Candidate& k) {
      return lasts(k) && k.hypothesis.effect == c.hypothesis.effect &&
             k.hypothesis.free == c.hypothesis.free;
    };
    if (!lasts(c) || std::ranges::none_of(kept, other)) kept.push_back(std::move(c));
  }
  list = std::move(kept);
}

}  // namespace trueaxis::diagnose_detail

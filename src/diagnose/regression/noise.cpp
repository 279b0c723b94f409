// SPDX-License-Identifier: Apache-2.0
#include "diagnose/regression/noise.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <optional>

#include "base/threads.hpp"
#include "math/statistics.hpp"

namespace trueaxis::diagnose_detail {
namespace {

using Matrix = Eigen::MatrixXd;

constexpr std::size_t noise_chunk = 512;
constexpr std::size_t enough_rows = 6000;  // φ to 0.013, a tenth of what matters
constexpr std::size_t least_rows = 200;
constexpr double least_freedom = 20.0;  // readings beyond the columns: u(φ) is 0.2 of white noise

/// Columns of terms of as many readings as `out` has rows, from `begin` on.
void fill_rows(const LinearisationPoint& point, std::span<const Hypothesis> terms,
               std::size_t begin, Eigen::Ref<Matrix> out) {
  PointRoom room;
  const std::size_t end = begin + static_cast<std::size_t>(out.rows());
  for_each_side(point.part(begin, end, room), [&](const PointPart& side) {
    Eigen::Index next = 0;
    for (const Hypothesis& h : terms) {
      std::vector<double*> own(h.columns());
      for (double*& column : own)
        column = &out(static_cast<Eigen::Index>(side.begin - begin), next++);
      fill(h, point, side, own);
    }
  });
}

}  // namespace

Eigen::MatrixXd columns_of_rows(const LinearisationPoint& point, std::span<const double> deviation,
                                std::span<const Hypothesis> terms, std::size_t begin,
                                std::size_t end) {
  const std::size_t base = point.base.columns(), count = 1 + base + columns_of(terms);
  Matrix out(static_cast<Eigen::Index>(end - begin), static_cast<Eigen::Index>(count));
  std::vector<double*> column(count);
  for (std::size_t j = 0; j < count; ++j)
    column[j] = out.data() + static_cast<Eigen::Index>(j) * out.rows();
  std::copy(deviation.begin() + static_cast<long>(begin),
            deviation.begin() + static_cast<long>(end), column[0]);
  PointRoom room;
  for_each_side(point.part(begin, end, room), [&](const PointPart& side) {
    std::vector<double*> here(column);
    for (double*& c : here) c += side.begin - begin;
    point.fill_base(side, {here.data() + 1, base});
    std::size_t next = 1 + base;
    for (const Hypothesis& h : terms) {
      fill(h, point, side, {here.data() + next, h.columns()});
      next += h.columns();
    }
  });
  return out;
}

std::vector<double> remainder(const LinearisationPoint& point, std::span<const double> deviation_mm,
                              std::span<const Hypothesis> terms, const Eigen::VectorXd& solution,
                              int threads) {
  std::vector<double> out(point.size());
  const auto work = [&](std::size_t k) {
    const std::size_t begin = k * noise_chunk, end = std::min(begin + noise_chunk, point.size());
    const Matrix columns = columns_of_rows(point, deviation_mm, terms, begin, end);
    const Eigen::VectorXd left = columns.col(0) - columns.rightCols(columns.cols() - 1) * solution;
    std::copy(left.data(), left.data() + left.size(), out.begin() + static_cast<long>(begin));
  };
  const bool small = point.size() < 20'000;  // a thread costs more than it saves
  for_each_index((point.size() + noise_chunk - 1) / noise_chunk, small ? 1 : threads, work);
  return out;
}

/// Readings enough for the noise. A block of a long stream is cut: whole blocks would be more than
/// enough; short ones in a row are one stretch.
std::vector<NoiseEstimator::Stretch> NoiseEstimator::stretches_of(
    const ObservationMask& mask) const {
  constexpr std::size_t most = enough_rows / 4;
  std::size_t available = 0;
  for (std::size_t f = 0; f < mask.folds(); ++f)
    available += std::min(mask.fold_begin[f + 1] - mask.fold_begin[f], most);
  const std::size_t stride = 1 + available / (2 * enough_rows);
  std::vector<Stretch> out;
  for (std::size_t f = 0; f < mask.folds(); f += stride) {
    const std::size_t begin = mask.fold_begin[f],
                      end = std::min(mask.fold_begin[f + 1], begin + most);
    if (!out.empty() && out.back().end == begin && end - out.back().begin <= most)
      out.back().end = end;
    else
      out.push_back({begin, end, {}, {}, {}});
  }
  for (Stretch& s : out) {
    const std::size_t from = s.begin - std::min<std::size_t>(s.begin, 2);  // those before its first
    for (std::size_t i = s.begin; i < s.end; ++i)
      if (mask.used[i])
        (mask.run[i] == 0   ? s.first
         : mask.run[i] == 1 ? s.second
                            : s.later)
            .push_back(static_cast<Eigen::Index>(i - from));
    s.begin = from;
  }
  return out;
}

LaggedRows NoiseEstimator::Stretch::rows_of(const Eigen::MatrixXd& columns) const {
  return {{columns, later, 3}, {columns, first, 1}, {columns, second, 2}};
}

NoiseEstimator::NoiseEstimator(const LinearisationPoint& point, const ObservationMask& mask,
                               std::span<const double> deviation_mm,
                               std::span<const Hypothesis> basis, int threads)
    : point_(&point),
      deviation_mm_(deviation_mm),
      basis_(basis.begin(), basis.end()),
      threads_(threads),
      stretches_(stretches_of(mask)),
      gram_(static_cast<Eigen::Index>(1 + point.base.columns() + columns_of(basis))) {
  std::vector<std::optional<LaggedRows>> rows(stretches_.size());
  std::vector<LaggedGram> grams(stretches_.size(), gram_);
  for_each_index(stretches_.size(), threads_, [&](std::size_t k) {
    const Stretch& s = stretches_[k];
    rows[k].emplace(s.rows_of(columns_of_rows(point, deviation_mm, basis, s.begin, s.end)));
    grams[k].add(*rows[k]);
  });
  for (std::optional<LaggedRows>& of : rows) rows_.push_back(std::move(*of));
  for (const LaggedGram& of : grams) gram_.add(of);
}

Autoregression NoiseEstimator::operator()(std::span<const Hypothesis> terms) const {
  const auto fresh = static_cast<Eigen::Index>(columns_of(terms)), there = gram_.at(0, 0).rows();
  if (gram_.rows() < static_cast<double>(there + fresh - 1) + least_freedom) return {};
  LaggedGram gram = gram_.widened(there + fresh);
  for (std::size_t k = 0; k < stretches_.size() && fresh > 0; ++k) {
    const Stretch& s = stretches_[k];
    Matrix columns(static_cast<Eigen::Index>(s.end - s.begin), fresh);
    fill_rows(*point_, terms, s.begin, columns);
    gram.add_columns(rows_[k], s.rows_of(columns));
  }
  Autoregression out = find_autoregression(
      gram, [&](double phi1, double phi2) { return rings_with_spindle(phi1, phi2, point_->c); });
  const auto columns = static_cast<double>(out.coefficients.size());
  // Fewer readings, and what the columns take of the noise would look like more of its spectrum:
  // columns/N of a correlation, whose standard error is 1/√N.
  if (out.phi.size() < 2 || columns * columns > gram.rows()) return out;
  const auto runs = residual_runs(terms, out.coefficients);
  return with_higher_orders(std::move(out), runs);
}

std::vector<std::vector<double>> NoiseEstimator::residual_runs(
    std::span<const Hypothesis> terms, const Eigen::VectorXd& coefficients) const {
  std::vector<Hypothesis> all = basis_;
  all.insert(all.end(), terms.begin(), terms.end());
  std::vector<std::vector<double>> runs;
  for (const Stretch& s : stretches_) {
    const Matrix x = columns_of_rows(*point_, deviation_mm_, all, s.begin, s.end);
    const Eigen::VectorXd left = x.col(0) - x.rightCols(x.cols() - 1) * coefficients;
    std::vector<char> counts(static_cast<std::size_t>(left.size()), 0);
    for (const auto* rows : {&s.first, &s.second, &s.later})
      for (const Eigen::Index i : *rows)
        counts[static_cast<std::size_t>(i)] = rows == &s.first ? 2 : 1;
    bool goes_on = false;
    for (std::size_t i = 0; i < counts.size(); ++i) {
      if (counts[i] != 0 && (!goes_on || counts[i] == 2)) runs.emplace_back();
      goes_on = counts[i] != 0;
      if (goes_on) runs.back().push_back(left(static_cast<Eigen::Index>(i)));
    }
  }
  return runs;
}

Autoregression autoregression(const LinearisationPoint& point, const ObservationMask& mask,
                              std::span<const double> deviation_mm,
                              std::span<const Hypothesis> terms, int threads) {
  return NoiseEstimator(point, mask, deviation_mm, terms, threads)({});
}

}  // namespace trueaxis::diagnose_detail

// SPDX-License-Identifier: Apache-2.0
#include "diagnose/evidence.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numeric>
#include <thread>

namespace trueaxis::diagnose_detail {
namespace {

constexpr std::size_t chunk_rows = 512;
constexpr double undetermined = 1e-11;  // of a column's square: rounding of the Gram matrix and of
                                        // the linearisation leave nothing to trust below

using Matrix = Eigen::MatrixXd;

}  // namespace

Evidence::Evidence(const Scene& scene, const Rows& rows, std::span<const double> deviation_mm,
                   std::vector<double> autoregression, int threads)
    : scene_(&scene),
      rows_(&rows),
      deviation_(deviation_mm),
      autoregression_(std::move(autoregression)),
      threads_(threads),
      folds_(rows.folds()) {
  for (std::size_t i = 0; i < scene.size(); ++i)
    count_ += rows.used[i] && rows.run[i] >= autoregression_.size();
  base_.resize(scene.base.columns());
  std::iota(base_.begin(), base_.end(), 1U);
  pass({});
}

std::vector<Columns> Evidence::append(std::span<const Hypothesis> list) {
  std::vector<Columns> places;
  auto next = static_cast<std::size_t>(total_.rows());
  for (const Hypothesis& h : list) {
    Columns own(h.columns());
    std::iota(own.begin(), own.end(), next);
    next += own.size();
    places.push_back(std::move(own));
  }
  if (!list.empty()) pass(list);
  return places;
}

void Evidence::shrink(std::size_t columns) {
  auto now = static_cast<std::size_t>(total_.rows());
  while (now > columns) {
    now -= list_.back().columns();
    list_.pop_back();
  }
  const auto size = static_cast<Eigen::Index>(now);
  total_.conservativeResize(size, size);
  for (Matrix& fold : folds_) fold.conservativeResize(size, size);
}

void Evidence::pass(std::span<const Hypothesis> fresh) {
  const Scene& scene = *scene_;
  const bool first = total_.rows() == 0;
  const std::size_t fixed = 1 + base_.size();
  const std::size_t before = first ? 0 : static_cast<std::size_t>(total_.rows());
  const std::size_t after = first ? fixed : before + columns_of(fresh);
  const std::size_t history = autoregression_.size();
  const auto k0 = static_cast<Eigen::Index>(before), k1 = static_cast<Eigen::Index>(after);

  const auto work = [&](std::size_t f) {
    Matrix& gram = folds_[f];
    gram.conservativeResize(k1, k1);
    gram.bottomRows(k1 - k0).setZero();
    Matrix raw(static_cast<Eigen::Index>(chunk_rows + history), k1);
    Matrix white(static_cast<Eigen::Index>(chunk_rows), k1);
    std::vector<double*> column(after);
    for (std::size_t begin = rows_->fold_begin[f]; begin < rows_->fold_begin[f + 1];) {
      std::size_t end = std::min(begin + chunk_rows, rows_->fold_begin[f + 1]);
      const std::size_t from = begin - std::min(begin, history);
      for (std::size_t i = from + 1; i < end; ++i) {
        if (scene.rear[i] != scene.rear[i - 1] && i > begin) end = i;
      }
      // A fold begins with its pass where the side changes: nothing before it is then read.
      const std::size_t start = scene.rear[from] == scene.rear[begin] ? from : begin;
      const auto lead = static_cast<Eigen::Index>(begin - start);
      const auto rows = static_cast<Eigen::Index>(end - begin);
      for (std::size_t j = 0; j < after; ++j)
        column[j] = raw.data() + static_cast<Eigen::Index>(j) * raw.rows();
      std::copy(deviation_.begin() + static_cast<long>(start),
                deviation_.begin() + static_cast<long>(end), column[0]);
      scene.fill_base(start, end, {column.data() + 1, base_.size()});
      std::size_t next = fixed;
      for (const auto* some : {&list_}) {
        for (const Hypothesis& h : *some) {
          fill(h, scene, start, end, {column.data() + next, h.columns()});
          next += h.columns();
        }
      }
      for (const Hypothesis& h : fresh) {
        fill(h, scene, start, end, {column.data() + next, h.columns()});
        next += h.columns();
      }
      white.topRows(rows) = raw.middleRows(lead, rows);
      for (std::size_t lag = 1; lag <= history; ++lag) {
        const auto shift = static_cast<Eigen::Index>(lag);
        const Eigen::Index skip = std::max<Eigen::Index>(0, shift - lead);
        if (skip >= rows) continue;
        white.middleRows(skip, rows - skip) -=
            autoregression_[lag - 1] * raw.middleRows(lead + skip - shift, rows - skip);
      }
      for (Eigen::Index i = 0; i < rows; ++i) {
        const std::size_t reading = begin + static_cast<std::size_t>(i);
        if (!rows_->used[reading] || rows_->run[reading] < history) white.row(i).setZero();
      }
      const auto block = white.topRows(rows);
      gram.bottomRows(k1 - k0).noalias() += block.rightCols(k1 - k0).transpose() * block;
      begin = end;
    }
    gram.topRightCorner(k0, k1 - k0) = gram.bottomLeftCorner(k1 - k0, k0).transpose();
  };

  std::atomic<std::size_t> next{0};
  const auto loop = [&] {
    for (std::size_t f = next++; f < folds_.size(); f = next++) work(f);
  };
  std::vector<std::thread> helpers;
  const bool small = scene.size() * after < 200'000;  // a thread costs more than it saves
  for (int t = 1; t < threads_ && !small; ++t) helpers.emplace_back(loop);
  loop();
  for (std::thread& helper : helpers) helper.join();

  list_.insert(list_.end(), fresh.begin(), fresh.end());
  total_ = Matrix::Zero(k1, k1);
  for (const Matrix& fold : folds_) total_ += fold;
}

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
  const Eigen::SelfAdjointEigenSolver<Matrix> eigen(unit);
  Eigen::VectorXd inverse(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const bool there = eigen.eigenvalues()(i) > undetermined;
    inverse(i) = there ? 1.0 / eigen.eigenvalues()(i) : 0.0;
    out.rank += there;
  }
  out.inverse = scale.asDiagonal() * eigen.eigenvectors() * inverse.asDiagonal() *
                eigen.eigenvectors().transpose() * scale.asDiagonal();
  out.coefficients = out.inverse * right;
  out.rss = gram(0, 0) - right.dot(out.coefficients);
  return out;
}

Projection project(const Eigen::MatrixXd& gram, const Columns& taken) {
  const Solution solution = solve(gram, taken);
  Projection out;
  out.norm2 = gram.diagonal();
  out.rank = solution.rank;
  const auto n = static_cast<Eigen::Index>(taken.size());
  Matrix cross(n, gram.cols());
  for (Eigen::Index i = 0; i < n; ++i)
    cross.row(i) = gram.row(static_cast<Eigen::Index>(taken[static_cast<std::size_t>(i)]));
  out.gram = gram - cross.transpose() * (solution.inverse * cross);
  out.rss = out.gram(0, 0);
  return out;
}

Score score(const Projection& projection, const Columns& columns) {
  const auto n = static_cast<Eigen::Index>(columns.size());
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
  const Eigen::SelfAdjointEigenSolver<Matrix> eigen(left);
  const Eigen::VectorXd along = eigen.eigenvectors().transpose() * right;
  for (Eigen::Index i = 0; i < n; ++i) take(eigen.eigenvalues()(i), along(i));
  return out;
}

}  // namespace trueaxis::diagnose_detail

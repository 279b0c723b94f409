// SPDX-License-Identifier: Apache-2.0
#include "diagnose/regression/normal_equations.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "base/threads.hpp"
#include "math/autoregression.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis::diagnose_detail {
namespace {

constexpr std::size_t chunk_rows = 512;
// A floor under the residual sum of squares, a reading: nothing below it is evidence. Readings are
// written to a nanometre; and columns are linear where the terms are not: about second_order of
// what the terms take (RMS) is left as their next order.
constexpr double least_floor_mm = 1e-6, second_order = 5e-4;

using Matrix = Eigen::MatrixXd;

/// Beginnings of parts that threads share, at most 64.
std::vector<std::size_t> parts_of(std::size_t size) {
  constexpr std::size_t most = 64, least = 4 * chunk_rows;
  const std::size_t chunks = (size + most * chunk_rows - 1) / (most * chunk_rows);
  const std::size_t rows = std::max(least, chunks * chunk_rows);
  std::vector<std::size_t> begins;
  for (std::size_t b = 0; b < size; b += rows) begins.push_back(b);
  begins.push_back(size);
  return begins;
}

/// Cells of the Fourier-Legendre basis that are one column of degree 0 times a polynomial in s.
bool same_order(const Hypothesis& a, const Hypothesis& b) {
  const auto cell = [](const Hypothesis& h) {
    return !h.effect && h.pattern.kind == Pattern::Kind::fourier_legendre && !h.pattern.in_time;
  };
  return cell(a) && cell(b) && a.pattern.order == b.pattern.order &&
         a.pattern.spindle == b.pattern.spindle;
}

}  // namespace

/// Whitened columns: the deviation, the base and the first terms.
struct NormalEquations::Kept {
  std::size_t terms, columns;
  std::vector<std::vector<WhiteColumns>> blocks;  ///< of every part
};

NormalEquations::NormalEquations(const LinearisationPoint& point, const ObservationMask& mask,
                                 std::span<const double> deviation_mm,
                                 std::vector<double> autoregression, int threads, bool blocks)
    : point_(&point),
      mask_(&mask),
      deviation_(deviation_mm),
      autoregression_(std::move(autoregression)),
      threads_(threads),
      part_begin_(blocks ? mask.fold_begin : parts_of(point.size())),
      folds_(blocks ? mask.folds() : 0) {
  const RunStart start(autoregression_);
  for (std::size_t i = 0; i < point.size(); ++i) {
    if (!mask.used[i]) continue;
    ++count_;
    if (mask.run[i] < autoregression_.size())
      log_volume_ += 2.0 * std::log(start.scale(mask.run[i]));
  }
  double sum = 0.0;
  for (std::size_t i = 0; i < point.size(); ++i)
    sum += mask.used[i] ? deviation_[i] * deviation_[i] : 0.0;
  floor2_ = std::max(least_floor_mm * least_floor_mm,
                     second_order * second_order * sum / static_cast<double>(point.size())) +
            mask.alike_mm * mask.alike_mm;
  base_.resize(point.base.columns());
  std::iota(base_.begin(), base_.end(), 1U);
  pass({}, 0);
}

const std::vector<Eigen::MatrixXd>& NormalEquations::folds() const {
  expects(!folds_.empty(), "equations with blocks");
  return folds_;
}

std::vector<Columns> NormalEquations::append(std::span<const Hypothesis> list,
                                             std::size_t together) {
  std::vector<Columns> places;
  auto next = static_cast<std::size_t>(total_.rows());
  for (const Hypothesis& h : list) {
    Columns own(h.columns());
    std::iota(own.begin(), own.end(), next);
    next += own.size();
    places.push_back(std::move(own));
  }
  if (!list.empty()) pass(list, together);
  return places;
}

void NormalEquations::shrink(std::size_t columns) {
  auto now = static_cast<std::size_t>(total_.rows());
  while (now > columns) {
    now -= list_.back().columns();
    list_.pop_back();
  }
  const auto size = static_cast<Eigen::Index>(now);
  total_.conservativeResize(size, size);
  for (Matrix& fold : folds_) fold.conservativeResize(size, size);
}

void NormalEquations::fill_raw(std::span<const Hypothesis> fresh, const PointPart& part,
                               std::span<double* const> columns) const {
  std::size_t next = 0;
  if (!kept_) {
    std::ranges::copy(deviation_.subspan(part.begin, part.size()), columns[0]);
    point_->fill_base(part, columns.subspan(1, base_.size()));
    next = 1 + base_.size();
  }
  const std::span<const Hypothesis> there = std::span(list_).subspan(kept_ ? kept_->terms : 0);
  for (const std::span<const Hypothesis> some : {there, fresh}) {
    const Hypothesis* constant = nullptr;  // the cell of degree 0 whose order the next ones share
    std::vector<const double*> constant_columns;
    for (const Hypothesis& h : some) {
      const std::span<double* const> own = columns.subspan(next, h.columns());
      next += own.size();
      if (h.pattern.degree > 0 && constant != nullptr && same_order(*constant, h)) {
        raise_degree(h, *point_, part, constant_columns, own);
        continue;
      }
      fill(h, *point_, part, own);
      constant = same_order(h, h) && h.pattern.degree == 0 ? &h : nullptr;
      if (constant != nullptr) constant_columns.assign(own.begin(), own.end());
    }
  }
}

Appended NormalEquations::appended(std::span<const Hypothesis> fresh, std::size_t together) const {
  Appended out;
  out.before = static_cast<std::size_t>(total_.rows());
  const std::size_t own = out.before == 0 ? 1 + base_.size() : 0;
  out.together = out.before + own + columns_of(fresh.first(together));
  std::size_t end = out.together;
  for (std::size_t h = together; h < fresh.size(); ++h) {
    end += fresh[h].columns();
    if (h > together && same_order(fresh[h - 1], fresh[h])) out.ends.pop_back();
    out.ends.push_back(end);
  }
  return out;
}

template <typename Work>
void NormalEquations::for_each_block(std::size_t part, const Work& work) const {
  PointRoom room;
  std::size_t number = 0;
  for (std::size_t begin = part_begin_[part]; begin < part_begin_[part + 1]; ++number) {
    const std::size_t before = begin - std::min(begin, autoregression_.size());
    PointPart at = point_->part(before, std::min(begin + chunk_rows, part_begin_[part + 1]), room);
    // Where the side changes a pass begins: nothing before it is then read.
    const auto own = at.rear.begin() + static_cast<long>(begin - before);
    const auto side = std::find_if(own, at.rear.end(), [&](char rear) { return rear != *own; });
    std::size_t skipped = begin - before;
    while (skipped > 0 && at.rear[skipped - 1] == *own) --skipped;
    at = at.part(skipped, static_cast<std::size_t>(side - at.rear.begin()));
    work(at, begin, number);
    begin = at.begin + at.size();
  }
}

void NormalEquations::fill_white(std::span<const Hypothesis> fresh, const PointPart& at,
                                 std::size_t begin, WhiteColumns& out) const {
  const std::size_t lead = begin - at.begin, end = at.begin + at.size();
  fill_raw(fresh, at, out.raw());
  out.whiten(autoregression_, lead, end - begin);
  for (std::size_t i = begin; i < end; ++i) {
    if (!mask_->used[i])
      out.drop(i - begin);
    else if (mask_->run[i] < autoregression_.size())
      out.begin_run(autoregression_, lead, i - begin, mask_->run[i]);
  }
}

void NormalEquations::keep_columns() {
  if (!point_->kept) return;
  kept_ = nullptr;
  auto kept = std::make_shared<Kept>();
  kept->terms = list_.size(), kept->columns = static_cast<std::size_t>(total_.rows());
  kept->blocks.resize(part_begin_.size() - 1);
  for_each_index(kept->blocks.size(), threads_for_columns(kept->columns), [&](std::size_t part) {
    for_each_block(part, [&](const PointPart& at, std::size_t begin, std::size_t) {
      WhiteColumns& own = kept->blocks[part].emplace_back(kept->columns, autoregression_.size(),
                                                          at.begin + at.size() - begin);
      fill_white({}, at, begin, own);
      own.white(at.begin + at.size() - begin);
      own.forget_raw();
    });
  });
  kept_ = std::move(kept);
}

/// A thread costs more than it saves where there is little to do.
int NormalEquations::threads_for_columns(std::size_t columns) const {
  return point_->size() * columns < 200'000 ? 1 : threads_;
}

GramSums NormalEquations::sums_of(std::size_t part, std::span<const Hypothesis> fresh,
                                  const Appended& appended) const {
  const std::size_t kept = kept_ ? kept_->columns : 0;
  WhiteColumns made(appended.columns() - kept, autoregression_.size(),
                    std::min(chunk_rows, part_begin_[part + 1] - part_begin_[part]));
  GramSums out(appended);
  std::vector<const double*> columns(appended.columns());
  for_each_block(part, [&](const PointPart& at, std::size_t begin, std::size_t block) {
    const std::size_t rows = at.begin + at.size() - begin;
    fill_white(fresh, at, begin, made);
    if (kept_) std::ranges::copy(kept_->blocks[part][block].white(), columns.begin());
    std::ranges::copy(made.white(rows), columns.begin() + static_cast<long>(kept));
    out.add(columns, rows);
  });
  return out;
}

void NormalEquations::pass(std::span<const Hypothesis> fresh, std::size_t together) {
  const Appended appended = this->appended(fresh, together);
  const bool first = appended.before == 0;
  std::vector<std::optional<GramSums>> sums(part_begin_.size() - 1);
  for_each_index(sums.size(), threads_for_columns(appended.columns()),
                 [&](std::size_t p) { sums[p].emplace(sums_of(p, fresh, appended)); });

  list_.insert(list_.end(), fresh.begin(), fresh.end());
  const auto columns = static_cast<Eigen::Index>(appended.columns()),
             there = static_cast<Eigen::Index>(appended.before);
  const auto widen = [&](Matrix& gram) {
    gram.conservativeResize(columns, columns);
    gram.rightCols(columns - there).setZero();
    gram.bottomRows(columns - there).setZero();
  };
  widen(total_);
  for (Matrix& fold : folds_) widen(fold);
  for (std::size_t p = 0; p < sums.size(); ++p) {
    if (!folds_.empty()) sums[p]->add_to(folds_[p]);
    sums[p]->add_to(total_);
  }
  for (std::size_t p = 0; first && p < sums.size(); ++p) {
    const double floor2 =
        floor2_ * static_cast<double>(counted(part_begin_[p], part_begin_[p + 1]));
    if (!folds_.empty()) folds_[p](0, 0) += floor2;
    total_(0, 0) += floor2;
  }
}

std::size_t NormalEquations::counted(std::size_t begin, std::size_t end) const {
  std::size_t count = 0;
  for (std::size_t i = begin; i < end; ++i) count += mask_->used[i] != 0;
  return count;
}

}  // namespace trueaxis::diagnose_detail

// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "diagnose/regression/normal_equations.hpp"
#include "math/autoregression.hpp"

namespace trueaxis::diagnose_detail {

WhiteColumns::WhiteColumns(std::size_t columns, std::size_t history, std::size_t rows)
    : history_(history) {
  const std::size_t stride = (rows + history + 7) / 8 * 8;
  raw_ = hwy::AllocateAligned<double>(columns * stride + 8);
  if (history > 0) white_ = hwy::AllocateAligned<double>(columns * stride + 8);
  for (std::size_t j = 0; j < columns; ++j) {
    raw_column_.push_back(raw_.get() + j * stride);
    white_column_.push_back(history > 0 ? white_.get() + j * stride : raw_column_.back());
  }
  view_.assign(white_column_.begin(), white_column_.end());
}

void WhiteColumns::whiten(const std::vector<double>& phi, std::size_t lead, std::size_t rows) {
  for (std::size_t c = 0; c < raw_column_.size() && history_ > 0; ++c) {
    const double* from = raw_column_[c] + lead;
    double* to = white_column_[c];
    std::copy(from, from + rows, to);
    for (std::size_t lag = 1; lag <= phi.size(); ++lag) {
      const std::size_t skip = lag > lead ? lag - lead : 0;
      for (std::size_t i = skip; i < rows; ++i)
        to[i] -= phi[lag - 1] * from[static_cast<long>(i) - static_cast<long>(lag)];
    }
  }
}

void WhiteColumns::begin_run(const std::vector<double>& phi, std::size_t lead, std::size_t row,
                             std::size_t run) {
  const RunStart start(phi);
  const std::vector<double>& own = start.phi(run);
  for (std::size_t c = 0; c < raw_column_.size(); ++c) {
    const double* from = raw_column_[c] + lead + row;
    double value = from[0];
    for (std::size_t j = 0; j < own.size(); ++j) value -= own[j] * from[-1 - static_cast<long>(j)];
    white_column_[c][row] = start.scale(run) * value;
  }
}

void WhiteColumns::drop(std::size_t row) {
  for (double* column : white_column_) column[row] = 0.0;
}

std::span<const double* const> WhiteColumns::white(std::size_t rows) {
  for (std::size_t row = rows; row < (rows + 7) / 8 * 8; ++row) drop(row);
  return view_;
}

void WhiteColumns::forget_raw() {
  if (history_ > 0) raw_ = nullptr;
  raw_column_.clear();
}

}  // namespace trueaxis::diagnose_detail

// SPDX-License-Identifier: Apache-2.0
#include "model/normal_matrix.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/stop.hpp"
#include "math/gram.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis {
namespace {

static_assert(max_columns + 1 <= max_gram_columns);
using Gram = std::array<double, gram_size(max_columns + 1)>;
constexpr std::size_t blocks_per_chunk =
    64;  // partial sums: rounding grows with √(N/8192), not with N

void clear_padding(std::size_t columns, std::size_t filled, PredictionBlock& block) {
  std::fill(block.residual + filled, block.residual + block_size, 0.0);
  for (std::size_t i = 0; i < columns; ++i)
    std::fill(block.column[i] + filled, block.column[i] + block_size, 0.0);
}

double entry(const Gram& gram, std::size_t i, std::size_t j) {
  return gram[gram_index(std::max(i, j), std::min(i, j))];
}

// J = T · columns for every reading: JᵀJ = T M Tᵀ (Eq. 20).
void transform_gram(const Gram& gram, const double* transform, std::size_t columns,
                    NormalMatrix& out) {
  const std::size_t p = out.parameters;
  std::array<double, max_parameters*(max_columns + 1)> half{};  // T · M, residual column last
  for (std::size_t a = 0; a < p; ++a) {
    for (std::size_t j = 0; j <= columns; ++j) {
      double sum = 0.0;
      for (std::size_t i = 0; i < columns; ++i)
        sum += transform[a * columns + i] * entry(gram, i, j);
      half[a * (columns + 1) + j] = sum;
    }
  }
  out.jtj.assign(p * p, 0.0);
  out.jtr.assign(p, 0.0);
  for (std::size_t a = 0; a < p; ++a) {
    out.jtr[a] = half[a * (columns + 1) + columns];
    for (std::size_t b = 0; b <= a; ++b) {
      double sum = 0.0;
      for (std::size_t j = 0; j < columns; ++j)
        sum += half[a * (columns + 1) + j] * transform[b * columns + j];
      out.jtj[a * p + b] = out.jtj[b * p + a] = sum;
    }
  }
}

}  // namespace

NormalMatrix accumulate(const Surface& surface, std::span<const double> working,
                        const PreparedStream& stream, const LossScale& loss) {
  const std::size_t columns = surface.column_count();
  expects(working.size() == surface.parameter_count(),
          "as many working parameters as the surface has");
  stop_if_asked();
  NormalMatrix out;
  out.parameters = working.size();
  Gram total{};
  LaneSums chunk;
  LossSums robust;
  PredictionBlock block;
  const double* column[max_columns + 1];
  for (std::size_t i = 0; i < columns; ++i) column[i] = block.column[i];
  column[columns] = block.residual;
  for (std::size_t index = 0; index < stream.blocks(); ++index) {
    surface.evaluate(working, stream.block(index), block);
    if (!block.valid) return out;
    const std::size_t filled = stream.filled(index);
    if (filled < block_size) clear_padding(columns, filled, block);
    if (loss.kind != LossScale::Kind::plain) apply_loss(loss, columns, filled, block, robust);
    add_products(column, columns + 1, chunk);
    if ((index + 1) % blocks_per_chunk == 0 || index + 1 == stream.blocks()) {
      for (std::size_t i = 0; i < gram_size(columns + 1); ++i) total[i] += chunk.sum(i);
      chunk = {};
    }
  }
  std::array<double, max_parameters * max_columns> transform;
  surface.transform(working, transform.data());
  transform_gram(total, transform.data(), columns, out);
  out.sum_rho = entry(total, columns, columns);
  if (loss.kind != LossScale::Kind::plain) {
    out.sum_rho = robust.rho;
    out.curvature = robust.weight > 0.0 ? robust.curvature / robust.weight : 1.0;
  }
  out.valid = true;
  return out;
}

bool residuals(const Surface& surface, std::span<const double> working,
               const PreparedStream& stream, std::span<double> out_mm) {
  expects(out_mm.size() == stream.size(), "room for one residual per reading");
  PredictionBlock block;
  bool valid = true;
  for (std::size_t index = 0; index < stream.blocks(); ++index) {
    surface.evaluate(working, stream.block(index), block);
    valid = valid && block.valid;
    std::copy_n(block.residual, stream.filled(index),
                out_mm.begin() + static_cast<std::ptrdiff_t>(index * block_size));
  }
  return valid;
}

void apply_loss(const LossScale& loss, std::size_t columns, std::size_t filled,
                PredictionBlock& block, LossSums& sums) {
  alignas(64) double root_weight[block_size] = {};
  const double c = loss.threshold_mm;
  for (std::size_t i = 0; i < filled; ++i) {
    const double r = std::abs(block.residual[i]);
    if (loss.kind == LossScale::Kind::huber) {
      const double weight = r <= c ? 1.0 : c / r;
      root_weight[i] = std::sqrt(weight);
      sums.rho += r <= c ? r * r : c * (2.0 * r - c);
      sums.weight += weight;
      sums.curvature += r <= c ? 1.0 : 0.0;
    } else {
      const double v = (r / c) * (r / c), u = std::max(0.0, 1.0 - v);
      root_weight[i] = u;
      sums.rho += c * c / 3.0 * (1.0 - u * u * u);
      sums.weight += u * u;
      sums.curvature += u * (1.0 - 5.0 * std::min(v, 1.0));
    }
  }
  double* column[max_columns + 1];
  for (std::size_t i = 0; i < columns; ++i) column[i] = block.column[i];
  column[columns] = block.residual;
  scale_columns(root_weight, columns + 1, column);
}

}  // namespace trueaxis

// SPDX-License-Identifier: Apache-2.0
#include "fit/robust.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "trueaxis/base/units.hpp"
#include "trueaxis/math/statistics.hpp"

namespace trueaxis {
namespace {

constexpr double huber_k = 1.345, tukey_c = 4.685;  // 95 % efficiency on Gaussian noise
constexpr double huber_listed = 6.0;                // σ: beyond it a Huber weight is below 0.23
constexpr std::size_t start_blocks = 8;             // 1024 readings fix a start well enough

/// Readings for the start: all of a short stream, else whole blocks spread by the golden ratio, so
/// that no period of the sampling is met.
struct Sample {
  std::vector<double> reading, cos_c, sin_c, position;
  ReadingBlock view() const {
    return {reading.data(), cos_c.data(), sin_c.data(), position.data()};
  }
};

void take(const ReadingBlock& block, std::size_t count, Sample& sample) {
  sample.reading.insert(sample.reading.end(), block.reading_mm, block.reading_mm + count);
  sample.cos_c.insert(sample.cos_c.end(), block.cos_c, block.cos_c + count);
  sample.sin_c.insert(sample.sin_c.end(), block.sin_c, block.sin_c + count);
  sample.position.insert(sample.position.end(), block.position_mm, block.position_mm + count);
}

Sample sample_of(const PreparedStream& stream) {
  Sample sample;
  const std::size_t blocks = stream.blocks();
  if (blocks <= start_blocks) {
    for (std::size_t i = 0; i < blocks; ++i) take(stream.block(i), stream.filled(i), sample);
    return sample;
  }
  // 128 readings each: 64 of a block's beginning would do as well; both ends of the stream are in.
  constexpr std::size_t parts = 2 * start_blocks, part = block_size / 2;
  for (std::size_t k = 0; k < parts; ++k) {
    const double golden = std::fmod(0.6180339887498949 * static_cast<double>(k), 1.0);
    std::size_t index = static_cast<std::size_t>(golden * static_cast<double>(blocks - 1));
    if (k + 1 == parts) index = blocks - 2;
    take(stream.block(index), std::min(part, stream.filled(index)), sample);
  }
  return sample;
}

/// Residuals of the sample at `working`, through the same evaluation as the fit.
std::vector<double> sample_residuals(const Surface& surface, std::span<const double> working,
                                     const Sample& sample) {
  std::vector<double> out;
  PredictionBlock prediction;
  for (std::size_t begin = 0; begin < sample.reading.size(); begin += block_size) {
    const std::size_t count = std::min(block_size, sample.reading.size() - begin);
    Sample padded;
    take({sample.reading.data() + begin, sample.cos_c.data() + begin, sample.sin_c.data() + begin,
          sample.position.data() + begin},
         count, padded);
    for (auto* column : {&padded.reading, &padded.cos_c, &padded.sin_c, &padded.position}) {
      column->resize(block_size, column->back());
    }
    surface.evaluate(working, padded.view(), prediction);
    if (!prediction.valid) return {};
    out.insert(out.end(), prediction.residual, prediction.residual + count);
  }
  return out;
}

/// Outliers pull an algebraic start: refit twice on the readings within 3 σ of the last one.
std::vector<double> trimmed_start(const Surface& surface, const Sample& all,
                                  std::vector<double> start) {
  for (int round = 0; round < 2; ++round) {
    const std::vector<double> residual = sample_residuals(surface, start, all);
    if (residual.empty()) break;
    const double limit = 3.0 * mad_sigma(residual);
    Sample kept;
    for (std::size_t i = 0; i < residual.size(); ++i) {
      if (std::abs(residual[i]) > limit) continue;
      take({&all.reading[i], &all.cos_c[i], &all.sin_c[i], &all.position[i]}, 1, kept);
    }
    if (kept.reading.size() <= 2 * surface.parameter_count()) break;
    start = surface.start(kept.view(), kept.reading.size());
  }
  return start;
}

LossScale loss_scale(Loss loss, double sigma_mm) {
  if (loss == Loss::huber) return {LossScale::Kind::huber, huber_k * sigma_mm};
  if (loss == Loss::tukey) return {LossScale::Kind::tukey, tukey_c * sigma_mm};
  return {};
}

}  // namespace

Association associate(const Surface& surface, const PreparedStream& stream, Loss loss,
                      int max_iterations) {
  Association association;
  const Sample sample = sample_of(stream);
  std::vector<double> start = surface.start(sample.view(), sample.reading.size());
  if (loss != Loss::plain) start = trimmed_start(surface, sample, std::move(start));
  association.residual_mm.resize(stream.size());
  if (loss == Loss::plain) {
    association.minimum = minimise(surface, stream, std::move(start), {}, max_iterations);
    residuals(surface, association.minimum.working, stream, association.residual_mm);
    return association;
  }
  // Huber's convex loss carries the scale to its place; Tukey's, which has several minima, starts
  // there.
  residuals(surface, start, stream, association.residual_mm);
  double sigma = mad_sigma(association.residual_mm);
  int iterations = 0;
  for (const Loss stage : {Loss::huber, Loss::tukey}) {
    if (sigma <= 0.0 || (stage == Loss::tukey && loss == Loss::huber)) break;
    for (int round = 0; round < 20; ++round) {
      association.loss = loss_scale(stage, sigma);
      association.minimum = minimise(surface, stream, start, association.loss, max_iterations);
      iterations += association.minimum.iterations;
      start = association.minimum.working;
      association.scale_mm = sigma;
      residuals(surface, start, stream, association.residual_mm);
      const double next = mad_sigma(association.residual_mm);
      const bool stands = std::abs(next - sigma) <= 1e-3 * sigma;
      if (stands || next <= 0.0) break;
      sigma = next;
    }
  }
  if (association.minimum.normal.valid) {
    const int before = association.minimum.iterations;
    polish(surface, stream, association.loss, association.minimum);
    iterations += association.minimum.iterations - before;
    residuals(surface, association.minimum.working, stream, association.residual_mm);
  }
  if (association.minimum.working.empty()) {  // more than half of the residuals are exactly zero
    association.loss = {};
    association.minimum = minimise(surface, stream, std::move(start), {}, max_iterations);
    residuals(surface, association.minimum.working, stream, association.residual_mm);
  }
  association.minimum.iterations = std::max(iterations, association.minimum.iterations);
  return association;
}

Influence1 influence(const LossScale& loss, double residual_mm) {
  const double c = loss.threshold_mm, r = residual_mm;
  switch (loss.kind) {
    case LossScale::Kind::huber:
      return std::abs(r) <= c ? Influence1{r, 1.0} : Influence1{std::copysign(c, r), 0.0};
    case LossScale::Kind::tukey: {
      const double v = (r / c) * (r / c);
      return v >= 1.0 ? Influence1{0.0, 0.0}
                      : Influence1{r * (1.0 - v) * (1.0 - v), (1.0 - v) * (1.0 - 5.0 * v)};
    }
    case LossScale::Kind::plain:
      break;
  }
  return {r, 1.0};
}

std::vector<Rejected> list_rejected(const Association& association) {
  std::vector<Rejected> rejected;
  if (association.loss.kind == LossScale::Kind::plain) return rejected;
  const bool tukey = association.loss.kind == LossScale::Kind::tukey;
  const double limit = tukey ? association.loss.threshold_mm : huber_listed * association.scale_mm;
  for (std::size_t i = 0; i < association.residual_mm.size(); ++i) {
    const double size = std::abs(association.residual_mm[i]);
    if (size < limit) continue;
    char why[96];
    std::snprintf(why, sizeof why, "%.4g µm off, %.1f σ%s", association.residual_mm[i] / mm_per_um,
                  size / association.scale_mm, tukey ? "" : " (little weight)");
    rejected.push_back({i + 1, why});
  }
  return rejected;
}

}  // namespace trueaxis

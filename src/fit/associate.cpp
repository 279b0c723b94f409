// SPDX-License-Identifier: Apache-2.0
#include "fit/associate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "math/golden_section.hpp"
#include "math/statistics.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

constexpr std::size_t start_blocks = 8;  // 1024 readings fix a start well enough

void take(const ReadingBlock& block, std::size_t count, Sample& sample) {
  sample.reading.insert(sample.reading.end(), block.reading_mm, block.reading_mm + count);
  sample.cos_c.insert(sample.cos_c.end(), block.cos_c, block.cos_c + count);
  sample.sin_c.insert(sample.sin_c.end(), block.sin_c, block.sin_c + count);
  sample.position.insert(sample.position.end(), block.position_mm, block.position_mm + count);
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

bool lower(const Minimum& a, const Minimum& b) {
  if (a.normal.valid != b.normal.valid) return a.normal.valid;
  if (!a.normal.valid) return false;
  if (a.converged != b.converged) return a.converged;
  return a.normal.sum_rho < b.normal.sum_rho;
}

/// The level starts of all parts; empty for a surface that has none.
std::vector<double> level_start(const JointModel& model, const std::vector<Sample>& samples) {
  std::vector<std::vector<double>> working;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    working.push_back(
        model.parts()[i].surface->level_start(samples[i].view(), samples[i].reading.size()));
    if (working.back().empty()) return {};
  }
  return model.joined(working);
}

/// Further starts of a part that is alone: of several streams others tell its parameters.
std::vector<std::vector<double>> further_starts(const JointModel& model,
                                                const std::vector<double>& level) {
  if (model.parts().size() != 1 || level.empty()) return {};
  return model.parts().front().surface->further_starts(level);
}

constexpr double huber_k = 1.345, tukey_c = 4.685;  // 95 % efficiency on Gaussian noise
constexpr double huber_listed = 6.0;                // σ: beyond it a Huber weight is below 0.23

/// Eq. 28.
LossScale loss_scale(Loss loss, double sigma_mm) {
  if (loss == Loss::huber) return {LossScale::Kind::huber, huber_k * sigma_mm};
  if (loss == Loss::tukey) return {LossScale::Kind::tukey, tukey_c * sigma_mm};
  return {};
}

/// Whether two minima are one, to the rounding of their numbers.
bool same_place(const JointModel& model, const Minimum& a, const Minimum& b) {
  constexpr double apart_mm = 1e-5;
  const std::vector<double> scale = model.scale_mm(a.working);
  for (std::size_t j = 0; j < scale.size(); ++j) {
    if (std::abs(a.working[j] - b.working[j]) * scale[j] > apart_mm) return false;
  }
  return true;
}

constexpr std::size_t few_beyond = 2;  // readings beyond the parameters that leave other surfaces

/// Through so few readings pass surfaces of other tilts: a cylinder through five has up to six.
std::vector<std::vector<double>> tilted_starts(const JointModel& model,
                                               const std::vector<double>& working) {
  constexpr double tilts[] = {0.03, 0.1, 0.3, 0.7, 1.5, 3.0};
  constexpr int directions = 16;
  std::vector<std::vector<double>> starts;
  for (std::size_t c = 0; c < model.clampings(); ++c) {
    for (const double tilt : tilts) {
      for (int k = 0; k < directions; ++k) {
        const double angle = k * two_pi / directions;
        starts.push_back(
            model.tilted(working, c, {tilt * std::cos(angle), tilt * std::sin(angle)}));
      }
    }
  }
  if (!starts.empty() && starts.front() == working) starts.clear();  // a surface without tilt
  return starts;
}

}  // namespace

Sample sample_of(const PreparedStream& stream) {
  Sample sample;
  const std::size_t blocks = stream.blocks();
  if (blocks <= start_blocks) {
    for (std::size_t i = 0; i < blocks; ++i) take(stream.block(i), stream.filled(i), sample);
    return sample;
  }
  // The first 64 readings of 16 blocks, among them the first of the stream and the last but one:
  // the last may hold a single reading.
  constexpr std::size_t parts = 2 * start_blocks, part = block_size / 2;
  for (std::size_t k = 0; k < parts; ++k) {
    auto index = static_cast<std::size_t>(golden_share(k) * static_cast<double>(blocks - 1));
    if (k + 1 == parts) index = blocks - 2;
    take(stream.block(index), std::min(part, stream.filled(index)), sample);
  }
  return sample;
}

std::vector<Sample> samples_of(const JointModel& model) {
  std::vector<Sample> samples;
  for (const JointPart& part : model.parts()) samples.push_back(sample_of(*part.prepared));
  return samples;
}

std::vector<double> find_start(const JointModel& model, const std::vector<Sample>& samples,
                               Loss loss) {
  std::vector<std::vector<double>> working;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const Surface& surface = *model.parts()[i].surface;
    working.push_back(surface.start(samples[i].view(), samples[i].reading.size()));
    if (loss != Loss::plain)
      working.back() = trimmed_start(surface, samples[i], std::move(working.back()));
  }
  std::vector<double> start = model.joined(working);
  if (loss == Loss::plain || model.accumulate(start, {}).valid) return start;
  std::vector<double> level = level_start(model, samples);
  return level.empty() ? start : level;
}

Minima lowest_minimum(const JointModel& model, const std::vector<Sample>& samples,
                      const std::vector<double>& start, const LossScale& loss, int max_iterations) {
  Minima minima{minimise(model, start, loss, max_iterations), {}};
  const Minimum& best = minima.best;
  std::vector<std::size_t> to_mirror;  // clampings; all of them where nothing was found
  const bool found = best.normal.valid && best.converged;
  for (std::size_t c = 0; c < model.clampings(); ++c) {
    if (!found || model.tilt_may_be_mirrored(best.working, c)) to_mirror.push_back(c);
  }
  const bool few = model.size() <= model.parameter_count() + few_beyond;
  std::vector<double> level = level_start(model, samples);
  std::vector<std::vector<double>> further = further_starts(model, level);
  if (to_mirror.empty() && !few && further.empty()) return minima;
  int passes = best.iterations;
  const auto attempt = [&](std::vector<double> from) {
    Minimum other = minimise(model, std::move(from), loss, max_iterations);
    passes += other.iterations;
    // If two ways lead to one minimum, the first stays, whatever their last steps leave.
    const bool there = minima.best.converged && same_place(model, other, minima.best);
    if (lower(other, minima.best) && !there) std::swap(other, minima.best);
    if (other.converged && !same_place(model, other, minima.best) &&
        (!minima.rival || lower(other, *minima.rival)))
      minima.rival = std::move(other);
  };
  if (!level.empty()) attempt(std::move(level));
  for (std::vector<double>& other : further) attempt(std::move(other));
  for (const std::size_t c : to_mirror) {
    if (best.normal.valid) attempt(model.mirrored(best.working, c));
  }
  if (few && best.normal.valid) {
    for (std::vector<double>& other : tilted_starts(model, best.working)) attempt(std::move(other));
  }
  minima.best.iterations = passes;
  return minima;
}

Association associate(const JointModel& model, Loss loss, int max_iterations) {
  Association association;
  const std::vector<Sample> samples = samples_of(model);
  std::vector<double> start = find_start(model, samples, loss);
  association.residual_mm.resize(model.size());
  if (loss == Loss::plain) {
    Minima minima = lowest_minimum(model, samples, start, {}, max_iterations);
    association.minimum = std::move(minima.best);
    association.rival = std::move(minima.rival);
    model.residuals(association.minimum.working, association.residual_mm);
    return association;
  }
  // Huber's convex loss carries the scale to its place; Tukey's, which has several minima, starts
  // there.
  model.residuals(start, association.residual_mm);
  double sigma = mad_sigma(association.residual_mm);
  int iterations = 0;
  for (const Loss stage : {Loss::huber, Loss::tukey}) {
    if (sigma <= 0.0 || (stage == Loss::tukey && loss == Loss::huber)) break;
    for (int round = 0; round < 20; ++round) {
      association.loss = loss_scale(stage, sigma);
      Minima minima = lowest_minimum(model, samples, start, association.loss, max_iterations);
      association.minimum = std::move(minima.best);
      association.rival = std::move(minima.rival);
      iterations += association.minimum.iterations;
      start = association.minimum.working;
      association.scale_mm = sigma;
      model.residuals(start, association.residual_mm);
      const double next = mad_sigma(association.residual_mm);
      const bool stands = std::abs(next - sigma) <= 1e-3 * sigma;
      if (stands || next <= 0.0) break;
      sigma = next;
    }
  }
  association.minimum.iterations = iterations;
  if (association.minimum.normal.valid) {
    polish(model, association.loss, association.minimum);
    model.residuals(association.minimum.working, association.residual_mm);
  }
  if (association.minimum.working.empty()) {  // more than half of the residuals are exactly zero
    association.loss = {};
    association.minimum = minimise(model, std::move(start), {}, max_iterations);
    model.residuals(association.minimum.working, association.residual_mm);
  }
  return association;
}

PsiAndDerivative psi_and_derivative(const LossScale& loss, double residual_mm) {
  const double c = loss.threshold_mm, r = residual_mm;
  switch (loss.kind) {
    case LossScale::Kind::huber:
      return std::abs(r) <= c ? PsiAndDerivative{r, 1.0}
                              : PsiAndDerivative{std::copysign(c, r), 0.0};
    case LossScale::Kind::tukey: {
      const double v = (r / c) * (r / c);
      return v >= 1.0 ? PsiAndDerivative{0.0, 0.0}
                      : PsiAndDerivative{r * (1.0 - v) * (1.0 - v), (1.0 - v) * (1.0 - 5.0 * v)};
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
    rejected.push_back(
        {i + 1, fmt::format("{:.4g} µm off, {:.1f} σ{}", association.residual_mm[i] / mm_per_um,
                            size / association.scale_mm, tukey ? "" : " (little weight)")});
  }
  return rejected;
}

}  // namespace trueaxis

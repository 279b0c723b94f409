// SPDX-License-Identifier: Apache-2.0
#include "fit/robust.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "fit/starts.hpp"
#include "math/statistics.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

constexpr double huber_k = 1.345, tukey_c = 4.685;  // 95 % efficiency on Gaussian noise
constexpr double huber_listed = 6.0;                // σ: beyond it a Huber weight is below 0.23

/// Eq. 28.
LossScale loss_scale(Loss loss, double sigma_mm) {
  if (loss == Loss::huber) return {LossScale::Kind::huber, huber_k * sigma_mm};
  if (loss == Loss::tukey) return {LossScale::Kind::tukey, tukey_c * sigma_mm};
  return {};
}

}  // namespace

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
  if (association.minimum.normal.valid) {
    const int before = association.minimum.iterations;
    polish(model, association.loss, association.minimum);
    iterations += association.minimum.iterations - before;
    model.residuals(association.minimum.working, association.residual_mm);
  }
  if (association.minimum.working.empty()) {  // more than half of the residuals are exactly zero
    association.loss = {};
    association.minimum = minimise(model, std::move(start), {}, max_iterations);
    model.residuals(association.minimum.working, association.residual_mm);
  }
  association.minimum.iterations = std::max(iterations, association.minimum.iterations);
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

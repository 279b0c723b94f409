// SPDX-License-Identifier: Apache-2.0
#include "simulate/variates.hpp"

#include <array>
#include <cmath>
#include <cstddef>

namespace trueaxis::virtual_lathe {
namespace {

constexpr double ln2 = 0.693147180559945309417;

/// exp by halving and its series, to some ulp, in plain operations that every compiler rounds
/// alike.
constexpr double plain_exp(double x) {
  int halvings = 0;
  for (; x < -0.5 || x > 0.5; ++halvings) x *= 0.5;
  double term = 1.0, sum = 1.0;
  for (int i = 1; i < 16; ++i) sum += term *= x / i;
  for (; halvings > 0; --halvings) sum *= sum;
  return sum;
}

/// log of 0 < x ≤ 1: powers of two removed, then Halley's steps on exp.
constexpr double plain_log(double x) {
  double twos = 0.0;
  for (; x < 0.70710678118654752; x *= 2.0) twos -= ln2;
  double y = x - 1.0;
  for (int i = 0; i < 4; ++i) {
    const double e = plain_exp(y);
    y += 2.0 * (x - e) / (x + e);
  }
  return twos + y;
}

constexpr double plain_sqrt(double x) {
  if (x <= 0.0) return 0.0;
  double y = x > 1.0 ? x : 1.0;
  for (int i = 0; i < 60; ++i) y = 0.5 * (y + x / y);
  return y;
}

/// Right edges x of layers of one area under exp(−x²/2), the base with the tail first, and the
/// heights there.
struct Layers {
  static constexpr std::size_t count = 256;
  static constexpr double tail = 3.6541528853610088, area = 0.00492867323399;
  std::array<double, count + 1> x{}, height{};

  constexpr Layers() {
    const auto density = [](double at) { return plain_exp(-0.5 * at * at); };
    x[0] = area / density(tail);
    x[1] = tail;
    for (std::size_t i = 2; i < count; ++i) {
      x[i] = plain_sqrt(-2.0 * plain_log(area / x[i - 1] + density(x[i - 1])));
    }
    for (std::size_t i = 0; i <= count; ++i) height[i] = density(x[i]);
  }
};
constexpr Layers layers;

double positive_uniform(Xoshiro& bits) {
  return (static_cast<double>(bits() >> 11U) + 0.5) * 0x1p-53;
}

/// Beyond the base layer (Marsaglia, 1964).
double tail_variate(Xoshiro& bits) {
  while (true) {
    const double x = -plain_log(positive_uniform(bits)) / Layers::tail;
    if (-2.0 * plain_log(positive_uniform(bits)) > x * x) return Layers::tail + x;
  }
}

/// A point of a layer, from 53 bits for the place and 9 others for the layer and the sign.
struct Candidate {
  std::size_t layer;
  double x, sign;

  explicit Candidate(std::uint64_t word)
      : layer(word & 0xFFU),
        x(static_cast<double>(word >> 11U) * 0x1p-53 * layers.x[layer]),
        sign((word & 0x100U) != 0 ? -1.0 : 1.0) {}
  bool inside() const { return x < layers.x[layer + 1]; }
  double value() const { return sign * x; }
};

/// In the part of a layer that the density cuts through.
bool is_below_density(const Candidate& at, Xoshiro& bits) {
  if (at.layer == 0) return false;
  const double low = layers.height[at.layer], high = layers.height[at.layer + 1];
  return low + bits.uniform() * (high - low) < plain_exp(-0.5 * at.x * at.x);
}

/// Gamma of shape a ≥ 1 and scale 1 (Marsaglia and Tsang, 2000).
double gamma_variate(Xoshiro& bits, double a) {
  const double d = a - 1.0 / 3.0, c = 1.0 / std::sqrt(9.0 * d);
  while (true) {
    const double x = normal_variate(bits), root = 1.0 + c * x;
    if (root <= 0.0) continue;
    const double v = root * root * root, u = positive_uniform(bits);
    if (u < 1.0 - 0.0331 * x * x * x * x) return d * v;
    const double log_v = v <= 1.0 ? plain_log(v) : -plain_log(1.0 / v);
    if (plain_log(u) < 0.5 * x * x + d * (1.0 - v + log_v)) return d * v;
  }
}

}  // namespace

double normal_variate(Xoshiro& bits) {
  while (true) {
    const Candidate candidate(bits());
    if (candidate.inside() || is_below_density(candidate, bits)) return candidate.value();
    if (candidate.layer == 0) return candidate.sign * tail_variate(bits);
  }
}

// The generator's state stays in registers but for one draw in a hundred.
void add_normal_variates(Xoshiro& bits, double sigma, std::span<double> to) {
  Xoshiro local = bits;
  for (double& value : to) {
    const Xoshiro before = local;
    const Candidate candidate(local());
    if (candidate.inside()) {
      value += sigma * candidate.value();
    } else {
      bits = before;
      value += sigma * normal_variate(bits);
      local = bits;
    }
  }
  bits = local;
}

double student_variate(Xoshiro& bits, double dof) {
  const double normal = normal_variate(bits);
  const double chi_squared = 2.0 * gamma_variate(bits, 0.5 * dof);
  return normal * std::sqrt((dof - 2.0) / chi_squared);
}

}  // namespace trueaxis::virtual_lathe

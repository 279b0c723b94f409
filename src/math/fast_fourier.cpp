// SPDX-License-Identifier: Apache-2.0
#include "math/fast_fourier.hpp"

#include <algorithm>
#include <cmath>

#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

constexpr std::size_t longest_in_one_step = 16384;
constexpr std::size_t root_step = 1024;
constexpr std::size_t block = 8;  // columns moved at a time: whole lines of the cache

using Complex = FastFourier::Complex;

Complex unit_root(std::size_t power, std::size_t n) {
  const double angle = two_pi * static_cast<double>(power) / static_cast<double>(n);
  return {std::cos(angle), -std::sin(angle)};
}

// std::complex's own product looks for infinities.
Complex times(Complex a, Complex b) {
  return {a.real() * b.real() - a.imag() * b.imag(), a.real() * b.imag() + a.imag() * b.real()};
}

// The divisor next to the root, from below.
std::size_t divisor_below_root(std::size_t n) {
  auto d = static_cast<std::size_t>(std::sqrt(static_cast<double>(n)));
  while (n % d != 0) --d;
  return d;
}

}  // namespace

std::size_t smooth_even_size(std::size_t least) {
  std::size_t best = 2;
  while (best < least) best *= 2;
  for (std::size_t five = 2; five < best; five *= 5) {
    for (std::size_t three = five; three < best; three *= 3) {
      std::size_t n = three;
      while (n < least) n *= 2;
      best = std::min(best, n);
    }
  }
  return best;
}

FastFourier::FastFourier(std::size_t n) : n_(n), n2_(n) {
  if (n > longest_in_one_step) {
    n1_ = divisor_below_root(n);
    n2_ = n / n1_;
    for (std::size_t m = 0; m < root_step; ++m) fine_.push_back(unit_root(m, n));
    for (std::size_t m = 0; m < n; m += root_step) coarse_.push_back(unit_root(m, n));
  }
  for (const std::size_t length : {n1_, n2_}) {  // makes the roots
    if (length == 1) continue;
    std::vector<Complex> in(length), out(length);
    plan_.fwd(out.data(), in.data(), static_cast<Eigen::Index>(length));
  }
}

FastFourier::Complex FastFourier::root(std::size_t power) const {
  return times(coarse_[power / root_step], fine_[power % root_step]);
}

FastFourier::Workspace FastFourier::workspace() const {
  Workspace made;
  const bool steps = n1_ > 1;
  made.in = hwy::AllocateAligned<Complex>(steps ? block * n1_ : n_);
  made.out = hwy::AllocateAligned<Complex>(steps ? std::max(n1_, block * n2_) : 1);
  made.turned = hwy::AllocateAligned<Complex>(steps ? n_ : 1);
  made.result = hwy::AllocateAligned<Complex>(n_);
  made.plan = plan_;
  return made;
}

// j = j1 n2 + j2, k = k1 + n1 k2: transforms over j1, turned by exp(−2πi j2 k1/n), then over j2.
void FastFourier::in_four_steps(std::span<const double> real, std::span<const double> imaginary,
                                Workspace& with) const {
  auto& [in, out, turned, result, plan] = with;
  for (std::size_t first = 0; first < n2_; first += block) {
    const std::size_t columns = std::min(block, n2_ - first);
    for (std::size_t j1 = 0; j1 < n1_; ++j1) {
      const std::size_t from = j1 * n2_ + first;
      for (std::size_t c = 0; c < columns; ++c) {
        in[c * n1_ + j1] = {real[from + c], imaginary[from + c]};
      }
    }
    for (std::size_t c = 0; c < columns; ++c) {
      plan.fwd(out.get(), in.get() + c * n1_, static_cast<Eigen::Index>(n1_));
      for (std::size_t k1 = 0; k1 < n1_; ++k1) {
        in[c * n1_ + k1] = times(out[k1], root((first + c) * k1));
      }
    }
    for (std::size_t k1 = 0; k1 < n1_; ++k1) {
      for (std::size_t c = 0; c < columns; ++c) turned[k1 * n2_ + first + c] = in[c * n1_ + k1];
    }
  }
  for (std::size_t first = 0; first < n1_; first += block) {
    const std::size_t rows = std::min(block, n1_ - first);
    for (std::size_t r = 0; r < rows; ++r) {
      plan.fwd(out.get() + r * n2_, turned.get() + (first + r) * n2_,
               static_cast<Eigen::Index>(n2_));
    }
    for (std::size_t k2 = 0; k2 < n2_; ++k2) {
      for (std::size_t r = 0; r < rows; ++r) result[first + r + n1_ * k2] = out[r * n2_ + k2];
    }
  }
}

std::span<const Complex> FastFourier::operator()(std::span<const double> real,
                                                 std::span<const double> imaginary,
                                                 Workspace& with) const {
  if (n1_ > 1) {
    in_four_steps(real, imaginary, with);
  } else {
    for (std::size_t j = 0; j < n_; ++j) with.in[j] = {real[j], imaginary[j]};
    with.plan.fwd(with.result.get(), with.in.get(), static_cast<Eigen::Index>(n_));
  }
  return {with.result.get(), n_};
}

}  // namespace trueaxis

// SPDX-License-Identifier: Apache-2.0
#include "math/fast_fourier.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

constexpr std::size_t batch = BatchFourier::batch;  // whole lines of the cache

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

FastFourier::FastFourier(std::size_t n)
    : n_(n), n1_(divisor_below_root(n)), n2_(n / n1_), over_columns_(n1_), over_rows_(n2_) {
  for (std::size_t m = 0; m < n2_; ++m) fine_.push_back(unit_root(m, n));
  for (std::size_t m = 0; m < n; m += n2_) coarse_.push_back(unit_root(m, n));
  for (std::size_t k1 = 0; k1 < n1_; ++k1)
    for (std::size_t c = 0; c < batch; ++c) turns_.push_back(root(c * k1 % n));
}

FastFourier::Complex FastFourier::root(std::size_t power) const {
  return times(coarse_[power / n2_], fine_[power % n2_]);
}

FastFourier::Workspace FastFourier::workspace() const {
  Workspace made;
  for (auto& values : made.batches)
    values = hwy::AllocateAligned<double>(batch * std::max(n1_, n2_));
  made.turned_real = hwy::AllocateAligned<double>(n_);
  made.turned_imaginary = hwy::AllocateAligned<double>(n_);
  made.result = hwy::AllocateAligned<Complex>(n_);
  return made;
}

// j = j1 n2 + j2, k = k1 + n1 k2: transforms over j1, turned by exp(−2πi j2 k1/n), then over j2.
std::span<const Complex> FastFourier::operator()(std::span<const double> real,
                                                 std::span<const double> imaginary,
                                                 Workspace& with) const {
  const BatchFourier::Values room{with.batches[0].get(), with.batches[1].get()},
      other{with.batches[2].get(), with.batches[3].get()};
  // Columns of a matrix with rows of `length`, some from `first` on; those beyond its end are 0.
  const auto load = [&](std::span<const double> of_real, std::span<const double> of_imaginary,
                        std::size_t first, std::size_t length) {
    const std::size_t count = std::min(batch, length - first);
    for (std::size_t row = 0; row * length < n_; ++row) {
      for (const auto& [from, to] :
           {std::pair(of_real, room.real), {of_imaginary, room.imaginary}}) {
        std::copy_n(from.data() + row * length + first, count, to + row * batch);
        std::fill_n(to + row * batch + count, batch - count, 0.0);
      }
    }
    return count;
  };
  for (std::size_t first = 0; first < n2_; first += batch) {
    const std::size_t count = load(real, imaginary, first, n2_);
    const BatchFourier::Values sums = over_columns_(room, other);
    for (std::size_t k1 = 0; k1 < n1_; ++k1) {
      const Complex begin = root(first * k1);
      for (std::size_t c = 0; c < batch; ++c) {
        const std::size_t i = k1 * batch + c;
        const Complex turned = times({sums.real[i], sums.imaginary[i]}, times(begin, turns_[i]));
        sums.real[i] = turned.real(), sums.imaginary[i] = turned.imag();
      }
    }
    for (std::size_t c = 0; c < count; ++c) {
      double *to_real = with.turned_real.get() + (first + c) * n1_,
             *to_imaginary = with.turned_imaginary.get() + (first + c) * n1_;
      for (std::size_t k1 = 0; k1 < n1_; ++k1) {
        to_real[k1] = sums.real[k1 * batch + c];
        to_imaginary[k1] = sums.imaginary[k1 * batch + c];
      }
    }
  }
  for (std::size_t first = 0; first < n1_; first += batch) {
    const std::size_t count =
        load({with.turned_real.get(), n_}, {with.turned_imaginary.get(), n_}, first, n1_);
    const BatchFourier::Values sums = over_rows_(room, other);
    for (std::size_t k2 = 0; k2 < n2_; ++k2)
      for (std::size_t r = 0; r < count; ++r)
        with.result[first + r + n1_ * k2] = {sums.real[k2 * batch + r],
                                             sums.imaginary[k2 * batch + r]};
  }
  return {with.result.get(), n_};
}

}  // namespace trueaxis

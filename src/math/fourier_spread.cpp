// SPDX-License-Identifier: Apache-2.0
#include "math/fourier_spread.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "trueaxis/error.hpp"
#include "trueaxis/units.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "math/fourier_spread.cpp"  // compiled once for every instruction set
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace trueaxis::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Tag = hn::CappedTag<double, 4>;  // a third of the kernel

constexpr std::size_t batch = 64;  // points whose kernels are kept at a time

void kernel_values(const double* distance, std::size_t count, double (*out)[spread_width]) {
  const Tag tag;
  const SpreadPolynomials& factor = spread_polynomials();
  for (std::size_t i = 0; i < count; ++i) {
    const auto v = hn::Set(tag, 2.0 * distance[i] + static_cast<double>(spread_width) - 1.0);
    for (std::size_t l = 0; l < spread_width; l += hn::Lanes(tag)) {
      auto sum = hn::LoadU(tag, factor[spread_degree].data() + l);
      for (std::size_t k = spread_degree; k-- > 0;)
        sum = hn::MulAdd(sum, v, hn::LoadU(tag, factor[k].data() + l));
      hn::StoreU(sum, tag, out[i] + l);
    }
  }
}

HWY_INLINE void add(double factor, const double* kernel, double* grid) {
  const Tag tag;
  for (std::size_t l = 0; l < spread_width; l += hn::Lanes(tag)) {
    const auto sum =
        hn::MulAdd(hn::Set(tag, factor), hn::LoadU(tag, kernel + l), hn::LoadU(tag, grid + l));
    hn::StoreU(sum, tag, grid + l);
  }
}

/// A number and what it rounds away.
template <class V>
struct Twofold {
  V high, low;
};

template <class V>
HWY_INLINE Twofold<V> difference(V a, V b) {  // Knuth's (1969)
  const V high = hn::Sub(a, b), back = hn::Sub(high, a);
  return {high, hn::Sub(hn::Sub(a, hn::Sub(high, back)), hn::Add(b, back))};
}

template <class V>
HWY_INLINE Twofold<V> product(V a, V b) {
  const V high = hn::Mul(a, b);
#if HWY_NATIVE_FMA
  return {high, hn::MulSub(a, b, high)};
#else  // Dekker's (1971)
  const auto head = [](V x) {
    const V large = hn::Mul(hn::Set(hn::DFromV<V>(), 134217729.0), x);
    return hn::Sub(large, hn::Sub(large, x));
  };
  const V a1 = head(a), b1 = head(b), a2 = hn::Sub(a, a1), b2 = hn::Sub(b, b1);
  const V cross =
      hn::Add(hn::Add(hn::Sub(hn::Mul(a1, b1), high), hn::Mul(a1, b2)), hn::Mul(a2, b1));
  return {high, hn::Add(cross, hn::Mul(a2, b2))};
#endif
}

/// Turns of t less whole turns, −1/2 … 1/2: a double of many turns alone would lose them.
template <class V>
HWY_INLINE Twofold<V> part_of_turn(Twofold<V> turns, Twofold<V> t) {
  const Twofold<V> whole = product(turns.high, t.high);
  const V rest = hn::Add(hn::Mul(turns.high, t.low), hn::Mul(turns.low, t.high));
  return {hn::Sub(whole.high, hn::Round(whole.high)), hn::Add(whole.low, rest)};
}

void place_all(const SpreadGrid& grid, std::span<const double> t, std::uint32_t* first,
               double* distance, double* angle_rad) {
  const Tag tag;
  using V = hn::Vec<Tag>;
  const hn::Rebind<std::int32_t, Tag> whole;
  const hn::Rebind<std::uint32_t, Tag> index;
  const auto twofold = [&](long double value) {
    const auto high = static_cast<double>(value);
    return Twofold<V>{hn::Set(tag, high), hn::Set(tag, static_cast<double>(value - high))};
  };
  const Twofold<V> turns = twofold(grid.turns), middle_turns = twofold(grid.middle_turns);
  const V size = hn::Set(tag, grid.size), middle = hn::Set(tag, grid.middle);
  const V half_width = hn::Set(tag, 0.5 * static_cast<double>(spread_width));
  const auto one_vector = [&](const double* of_t, std::uint32_t* of_first, double* of_distance,
                              double* of_angle) {
    const Twofold<V> from_middle = difference(hn::LoadU(tag, of_t), middle);
    const Twofold<V> part = part_of_turn(turns, from_middle);
    const Twofold<V> points = product(part.high, size);
    const V rest = hn::MulAdd(part.low, size, points.low);
    const V begin = hn::Ceil(hn::Sub(hn::Add(points.high, rest), half_width));
    hn::StoreU(hn::Sub(hn::Sub(begin, points.high), rest), tag, of_distance);
    const V in_grid = hn::IfThenElse(hn::Lt(begin, hn::Zero(tag)), hn::Add(begin, size), begin);
    hn::StoreU(hn::BitCast(index, hn::DemoteTo(whole, in_grid)), index, of_first);
    const Twofold<V> angle = part_of_turn(middle_turns, from_middle);
    hn::StoreU(hn::Mul(hn::Add(angle.high, angle.low), hn::Set(tag, -two_pi)), tag, of_angle);
  };
  constexpr std::size_t most_lanes = 4;
  const std::size_t lanes = hn::Lanes(tag);
  std::size_t i = 0;
  for (; i + lanes <= t.size(); i += lanes)
    one_vector(t.data() + i, first + i, distance + i, angle_rad + i);
  if (i == t.size()) return;
  double last[most_lanes] = {}, last_distance[most_lanes], last_angle[most_lanes];
  std::uint32_t last_first[most_lanes];
  std::ranges::copy(t.subspan(i), last);
  one_vector(last, last_first, last_distance, last_angle);
  for (std::size_t j = i; j < t.size(); ++j) {
    first[j] = last_first[j - i];
    distance[j] = last_distance[j - i], angle_rad[j] = last_angle[j - i];
  }
}

void spread_columns(const SpreadPoints& points, std::span<const SpreadColumn> columns) {
  double kernel[batch][spread_width];
  for (std::size_t from = 0; from < points.first.size(); from += batch) {
    const std::size_t end = std::min(from + batch, points.first.size());
    kernel_values(points.distance.data() + from, end - from, kernel);
    for (const SpreadColumn& column : columns) {
      for (std::size_t i = from; i < end; ++i) {
        const std::size_t at = points.first[i];
        add(column.value[i] * points.cosine[i], kernel[i - from], column.real + at);
        add(column.value[i] * points.sine[i], kernel[i - from], column.imaginary + at);
      }
    }
  }
}

}  // namespace trueaxis::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace trueaxis {

HWY_EXPORT(spread_columns);
HWY_EXPORT(place_all);

void place(const SpreadGrid& grid, std::span<const double> t, std::span<std::uint32_t> first,
           std::span<double> distance, std::span<double> angle_rad) {
  expects(t.size() == first.size() && t.size() == distance.size() && t.size() == angle_rad.size(),
          "columns of one length");
  HWY_DYNAMIC_DISPATCH(place_all)(grid, t, first.data(), distance.data(), angle_rad.data());
}

// Interpolation at the Chebyshev nodes, its series in T_n summed into powers.
const SpreadPolynomials& spread_polynomials() {
  static const SpreadPolynomials made = [] {
    constexpr std::size_t n = spread_degree + 1;
    constexpr long double pi = std::numbers::pi_v<long double>, half = 0.5L * spread_width;
    SpreadPolynomials out{};
    for (std::size_t l = 0; l < spread_width; ++l) {
      std::array<long double, n> before{}, now{}, sum{};  // powers of T_{m−1}, T_m
      before[1] = now[0] = 1.0L;                          // T_{−1} = T_1
      for (std::size_t m = 0; m < n; ++m) {
        long double of_t = 0.0L;
        for (std::size_t j = 0; j < n; ++j) {
          const long double angle = pi * (static_cast<long double>(j) + 0.5L) / n;
          const long double x =
              (0.5L * (std::cos(angle) + 1.0L) - half + static_cast<long double>(l)) / half;
          of_t += std::exp(spread_beta * (std::sqrt(std::max(0.0L, 1.0L - x * x)) - 1.0L)) *
                  std::cos(angle * static_cast<long double>(m));
        }
        for (std::size_t k = 0; k < n; ++k) sum[k] += (m == 0 ? 1.0L : 2.0L) / n * of_t * now[k];
        std::array<long double, n> next{};
        for (std::size_t k = 0; k < n; ++k)
          next[k] = (k > 0 ? 2.0L * now[k - 1] : 0.0L) - before[k];
        before = now, now = next;
      }
      for (std::size_t k = 0; k < n; ++k) out[k][l] = static_cast<double>(sum[k]);
    }
    return out;
  }();
  return made;
}

void spread(const SpreadPoints& points, std::span<const SpreadColumn> columns) {
  HWY_DYNAMIC_DISPATCH(spread_columns)(points, columns);
}

}  // namespace trueaxis
#endif

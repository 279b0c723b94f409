// SPDX-License-Identifier: Apache-2.0
#include "math/fourier_sums.hpp"

#include <algorithm>
#include <array>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <numbers>
#include <utility>

#include "math/fast_fourier.hpp"
#include "math/fourier_spread.hpp"
#include "math/sincos.hpp"
#include "trueaxis/error.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

constexpr std::size_t most_orders = std::size_t{1} << 28;  // grid points are 32 bits
constexpr std::size_t grid_cache = 48 * 1024;              // numbers that stay in the second cache
constexpr std::size_t few_readings = 40000;                // whose places are kept
constexpr std::size_t part_rows = 4096;                    // placed at a time
constexpr long double turns_per_rad = 0.5L / std::numbers::pi_v<long double>;

// Turns less whole turns, −1/2 … 1/2: the extended format keeps what a double of many turns loses.
double part_of_turn(long double turns) { return static_cast<double>(turns - std::rint(turns)); }

ColumnSource columns_of(std::span<const std::span<const double>> from) {
  return [from](std::size_t begin, std::size_t size, std::span<double* const> columns) {
    for (std::size_t k = 0; k < from.size(); ++k)
      std::ranges::copy(from[k].subspan(begin, size), columns[k]);
  };
}

ColumnSource column_of(std::span<const double> t) {
  expects(std::ranges::all_of(t, [](double v) { return std::isfinite(v); }), "finite abscissae");
  return [t](std::size_t begin, std::size_t size, std::span<double* const> columns) {
    std::ranges::copy(t.subspan(begin, size), columns[0]);
  };
}

double middle_of(std::span<const double> t) {
  if (t.empty()) return 0.0;
  const auto [low, high] = std::ranges::minmax(t);
  return 0.5 * low + 0.5 * high;
}

// ∫ φ(2x/width) cos(2π x f) dx over the kernel, f in cycles a step of the grid.
double kernel_transform_at(double f) {
  using Rule = boost::math::quadrature::gauss<double, 30>;
  constexpr double half_width = 0.5 * static_cast<double>(spread_width);
  double sum = 0.0;
  for (std::size_t q = 0; q < Rule::abscissa().size(); ++q) {
    const double x = Rule::abscissa()[q];
    sum += 2.0 * half_width * Rule::weights()[q] *
           std::exp(spread_beta * (std::sqrt(1.0 - x * x) - 1.0)) *
           std::cos(two_pi * half_width * x * f);
  }
  return sum;
}

// Its Chebyshev series in f² over f = 0 … 1/4, of which it is an entire function: the last of 24
// coefficients is below 1e-20 of the first.
constexpr std::size_t kernel_terms = 24;
const std::array<double, kernel_terms>& kernel_series() {
  static const std::array<double, kernel_terms> made = [] {
    std::array<double, kernel_terms> out{};
    for (std::size_t j = 0; j < kernel_terms; ++j) {
      const double angle = std::numbers::pi * (static_cast<double>(j) + 0.5) / kernel_terms;
      const double value = kernel_transform_at(0.25 * std::sqrt(0.5 * (std::cos(angle) + 1.0)));
      for (std::size_t k = 0; k < kernel_terms; ++k)
        out[k] +=
            (k == 0 ? 1.0 : 2.0) / kernel_terms * value * std::cos(angle * static_cast<double>(k));
    }
    return out;
  }();
  return made;
}

// The transform at f = m/grid, summed by Clenshaw's recurrence for some m at a time.
std::vector<double> kernel_transform(std::size_t modes, std::size_t grid) {
  constexpr std::size_t batch = 256;
  const std::array<double, kernel_terms>& c = kernel_series();
  std::vector<double> out(modes);
  for (std::size_t from = 0; from < modes; from += batch) {
    const std::size_t count = std::min(batch, modes - from);
    double t[batch], now[batch] = {}, before[batch] = {};
    for (std::size_t i = 0; i < count; ++i) {
      const double part = 4.0 * static_cast<double>(from + i) / static_cast<double>(grid);
      t[i] = 2.0 * part * part - 1.0;
    }
    for (std::size_t k = kernel_terms; k-- > 1;) {
      for (std::size_t i = 0; i < count; ++i) {
        const double next = c[k] + 2.0 * t[i] * now[i] - before[i];
        before[i] = now[i], now[i] = next;
      }
    }
    for (std::size_t i = 0; i < count; ++i) out[from + i] = c[0] + t[i] * now[i] - before[i];
  }
  return out;
}

}  // namespace

/// Where some readings in a row are spread to.
struct FourierSums::Places {
  std::vector<std::uint32_t> first;
  std::vector<double> distance, cosine, sine;
};

struct FourierSums::Spreading {
  Spreading(ColumnSource t, std::size_t size, double middle, double w0, double dw, std::size_t K);
  void place(std::size_t begin, std::size_t end, Places& out) const;
  /// Calls work(begin, end, places) for all readings, some at a time.
  template <typename Work>
  void for_each_part(const Work& work) const;
  void correct();
  Sums sums_of(const SpreadColumn& column, FastFourier::Workspace& workspace) const;

  ColumnSource abscissae;
  std::size_t size;
  double middle, w0, dw;
  std::size_t orders;
  FastFourier transform;
  std::vector<Places> kept;                  ///< part by part, of few readings
  std::vector<std::complex<double>> factor;  ///< of order k: for the middle of t, for the kernel
};

FourierSums::Spreading::Spreading(ColumnSource t, std::size_t size_of_t, double middle_of_t,
                                  double first, double step, std::size_t K)
    : abscissae(std::move(t)),
      size(size_of_t),
      middle(middle_of_t),
      w0(first),
      dw(step),
      orders(K),
      transform(smooth_even_size(std::max(2 * K, 2 * spread_width))) {
  std::vector<Places> made;
  if (size <= few_readings) {
    for_each_part([&](std::size_t, std::size_t, const Places& of) { made.push_back(of); });
  }
  kept = std::move(made);
  correct();
}

template <typename Work>
void FourierSums::Spreading::for_each_part(const Work& work) const {
  Places made;
  for (std::size_t begin = 0, k = 0; begin < size; begin += part_rows, ++k) {
    const std::size_t end = std::min(begin + part_rows, size);
    if (kept.empty()) place(begin, end, made);
    work(begin, end, kept.empty() ? made : kept[k]);
  }
}

// Orders are counted from the middle one, abscissae from the middle of t.
void FourierSums::Spreading::place(std::size_t begin, std::size_t end, Places& out) const {
  const SpreadGrid grid{middle, turns_per_rad * dw,
                        turns_per_rad * (w0 + static_cast<long double>(orders / 2) * dw),
                        static_cast<double>(transform.size())};
  const std::size_t count = end - begin;
  std::vector<double> t(count), angle(count);
  double* const column = t.data();
  abscissae(begin, count, {&column, 1});
  out.first.resize(count), out.distance.resize(count);
  out.cosine.resize(count), out.sine.resize(count);
  trueaxis::place(grid, t, out.first, out.distance, angle);
  sincos(angle, out.sine, out.cosine);
}

void FourierSums::Spreading::correct() {
  const std::size_t half = orders / 2;
  const std::vector<double> kernel = kernel_transform(half + 1, transform.size());
  std::vector<double> angle(orders), sine_of(orders), cosine_of(orders);
  const long double start = turns_per_rad * w0 * middle, step = turns_per_rad * dw * middle;
  for (std::size_t k = 0; k < orders; ++k) {
    angle[k] = -two_pi * part_of_turn(start + static_cast<long double>(k) * step);
  }
  sincos(angle, sine_of, cosine_of);
  factor.resize(orders);
  for (std::size_t k = 0; k < orders; ++k) {
    const double scale = 1.0 / kernel[k < half ? half - k : k - half];
    factor[k] = {scale * cosine_of[k], scale * sine_of[k]};
  }
}

FourierSums::FourierSums(ColumnSource t, std::size_t size, double middle, double w0, double dw,
                         std::size_t K) {
  expects(K >= 1 && K <= most_orders, "1 to 2^28 orders");
  expects(std::isfinite(w0) && std::isfinite(dw), "finite frequencies");
  spreading_ = std::make_shared<const Spreading>(std::move(t), size, middle, w0, dw, K);
}

FourierSums::FourierSums(std::span<const double> t, double w0, double dw, std::size_t K)
    : FourierSums(column_of(t), t.size(), middle_of(t), w0, dw, K) {}

std::size_t FourierSums::orders() const { return spreading_->orders; }

// F from the grids of a column.
FourierSums::Sums FourierSums::Spreading::sums_of(const SpreadColumn& column,
                                                  FastFourier::Workspace& workspace) const {
  const std::size_t grid = transform.size(), half = orders / 2;
  for (std::size_t l = 0; l < spread_width; ++l) {  // the grid is a ring
    column.real[l] += column.real[grid + l];
    column.imaginary[l] += column.imaginary[grid + l];
  }
  const auto sums = transform({column.real, grid}, {column.imaginary, grid}, workspace);
  Sums result(orders);
  for (std::size_t k = 0; k < orders; ++k) {
    const std::complex<double> sum = sums[k < half ? grid - (half - k) : k - half];
    const std::complex<double> by = factor[k];
    result[k] = {sum.real() * by.real() - sum.imag() * by.imag(),
                 sum.real() * by.imag() + sum.imag() * by.real()};
  }
  return result;
}

std::vector<FourierSums::Sums> FourierSums::of(const ColumnSource& w, std::size_t count) const {
  const Spreading& spreading = *spreading_;
  const std::size_t length = spreading.transform.size() + spread_width;
  // Columns spread at a time: their grids stay in the second cache; or two, which share the places.
  const std::size_t most = std::clamp(grid_cache / length, std::size_t{2}, count + 2);
  FastFourier::Workspace workspace = spreading.transform.workspace();
  std::vector<Sums> result;
  std::vector<double> grids, values(count * part_rows);
  std::vector<double*> value;
  for (std::size_t k = 0; k < count; ++k) value.push_back(values.data() + k * part_rows);
  for (std::size_t from = 0; from < count; from += most) {
    const std::size_t to = std::min(from + most, count);
    grids.assign(2 * (to - from) * length, 0.0);
    std::vector<SpreadColumn> columns;
    for (std::size_t k = from; k < to; ++k) {
      double* real = grids.data() + 2 * columns.size() * length;
      columns.push_back({value[k], real, real + length});
    }
    spreading.for_each_part([&](std::size_t begin, std::size_t end, const Places& at) {
      w(begin, end - begin, value);
      spread({at.first, at.distance, at.cosine, at.sine}, columns);
    });
    for (const SpreadColumn& column : columns)
      result.push_back(spreading.sums_of(column, workspace));
  }
  return result;
}

std::vector<FourierSums::Sums> FourierSums::of(std::span<const std::span<const double>> w) const {
  for (const std::span<const double> values : w)
    expects(values.size() == spreading_->size, "a value an abscissa");
  return of(columns_of(w), w.size());
}

FourierSums::Sums FourierSums::of(std::span<const double> w) const {
  return std::move(of(std::span(&w, 1)).front());
}

}  // namespace trueaxis

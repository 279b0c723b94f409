// SPDX-License-Identifier: Apache-2.0
#include "math/fourier_sums.hpp"

#include <algorithm>
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
constexpr long double turns_per_rad = 0.5L / std::numbers::pi_v<long double>;

// Turns less whole turns, −1/2 … 1/2: the extended format keeps what a double of many turns loses.
double part_of_turn(long double turns) { return static_cast<double>(turns - std::rint(turns)); }

// ∫ φ(2x/width) cos(2π x f) dx over the kernel, f = 0 … 1/4 per step of the grid.
std::vector<double> kernel_transform(std::size_t modes, std::size_t grid) {
  using Rule = boost::math::quadrature::gauss<double, 30>;
  std::vector<double> sum(modes), angle(modes), sine(modes), cosine(modes);
  constexpr double half_width = 0.5 * static_cast<double>(spread_width);
  for (std::size_t q = 0; q < Rule::abscissa().size(); ++q) {
    const double x = Rule::abscissa()[q];
    const double weight = 2.0 * half_width * Rule::weights()[q] *
                          std::exp(spread_beta * (std::sqrt(1.0 - x * x) - 1.0));
    const double step = two_pi * half_width * x / static_cast<double>(grid);
    for (std::size_t m = 0; m < modes; ++m) angle[m] = step * static_cast<double>(m);
    sincos(angle, sine, cosine);
    for (std::size_t m = 0; m < modes; ++m) sum[m] += weight * cosine[m];
  }
  return sum;
}

}  // namespace

struct FourierSums::Spreading {
  Spreading(std::span<const double> t, double w0, double dw, std::size_t K);
  void place(std::span<const double> t, double middle, double w0, double dw);
  void correct(double middle, double w0, double dw);
  Sums sums_of(const SpreadColumn& column, FastFourier::Workspace& workspace) const;

  std::size_t orders;
  FastFourier transform;
  std::vector<std::uint32_t> first;
  std::vector<double> distance, cosine, sine;
  std::vector<std::complex<double>> factor;  ///< of order k: of the middle of t, of the kernel
};

FourierSums::Spreading::Spreading(std::span<const double> t, double w0, double dw, std::size_t K)
    : orders(K), transform(smooth_even_size(std::max(2 * K, 2 * spread_width))) {
  double middle = 0.0;
  if (!t.empty()) {
    const auto [low, high] = std::minmax_element(t.begin(), t.end());
    middle = 0.5 * *low + 0.5 * *high;
  }
  place(t, middle, w0, dw);
  correct(middle, w0, dw);
}

// Orders are counted from the middle one, abscissae from the middle of t.
void FourierSums::Spreading::place(std::span<const double> t, double middle, double w0, double dw) {
  const auto grid = static_cast<long double>(transform.size());
  const long double turns = turns_per_rad * dw;
  const long double middle_turns = turns_per_rad * (w0 + static_cast<long double>(orders / 2) * dw);
  std::vector<double> angle(t.size());
  first.resize(t.size()), distance.resize(t.size());
  cosine.resize(t.size()), sine.resize(t.size());
  for (std::size_t i = 0; i < t.size(); ++i) {
    const long double from_middle = static_cast<long double>(t[i]) - middle;
    angle[i] = -two_pi * part_of_turn(middle_turns * from_middle);
    const long double part = turns * from_middle;
    const long double at = (part - std::rint(part)) * grid;  // −n/2 … n/2
    const double begin =
        std::ceil(static_cast<double>(at) - 0.5 * static_cast<double>(spread_width));
    distance[i] = static_cast<double>(begin - at);
    first[i] = static_cast<std::uint32_t>(begin < 0.0 ? begin + static_cast<double>(grid) : begin);
  }
  sincos(angle, sine, cosine);
}

void FourierSums::Spreading::correct(double middle, double w0, double dw) {
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

FourierSums::FourierSums(std::span<const double> t, double w0, double dw, std::size_t K) {
  expects(K >= 1 && K <= most_orders, "1 to 2^28 orders");
  expects(std::isfinite(w0) && std::isfinite(dw), "finite frequencies");
  expects(std::all_of(t.begin(), t.end(), [](double v) { return std::isfinite(v); }),
          "finite abscissae");
  spreading_ = std::make_shared<const Spreading>(t, w0, dw, K);
}

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

std::vector<FourierSums::Sums> FourierSums::of(std::span<const std::span<const double>> w) const {
  const Spreading& spreading = *spreading_;
  const std::size_t length = spreading.transform.size() + spread_width;
  // Columns spread at a time: their grids stay in the second cache.
  const std::size_t most = std::clamp(grid_cache / length, std::size_t{1}, w.size() + 1);
  FastFourier::Workspace workspace = spreading.transform.workspace();
  std::vector<Sums> result;
  std::vector<double> grids;
  for (std::size_t from = 0; from < w.size(); from += most) {
    const auto part = w.subspan(from, std::min(most, w.size() - from));
    grids.assign(2 * part.size() * length, 0.0);
    std::vector<SpreadColumn> columns;
    for (const std::span<const double> values : part) {
      expects(values.size() == spreading.first.size(), "a value an abscissa");
      double* real = grids.data() + 2 * columns.size() * length;
      columns.push_back({values.data(), real, real + length});
    }
    spread({spreading.first, spreading.distance, spreading.cosine, spreading.sine}, columns);
    for (const SpreadColumn& column : columns)
      result.push_back(spreading.sums_of(column, workspace));
  }
  return result;
}

FourierSums::Sums FourierSums::of(std::span<const double> w) const {
  return std::move(of(std::span(&w, 1)).front());
}

}  // namespace trueaxis

// SPDX-License-Identifier: Apache-2.0
#include "form/surface_sums.hpp"

#include <cmath>
#include <complex>
#include <numbers>
#include <utility>
#include <vector>

#include "math/linear_algebra.hpp"

namespace trueaxis::form {
namespace {

using Complex = std::complex<double>;
using Eigen::Index;
using Eigen::MatrixXd;

constexpr std::size_t block = 1024;  // readings
constexpr int cosines_from = 6;      // degrees
constexpr double longer = 1.25;      // than the readings: where the cosines have no slope

/// Sums over readings of f_d f_e, e ≤ d, and y f_d, times exp(ikθ).
class Sums {
 public:
  /// @param products whether f_d f_e are summed too, else y f_d alone
  Sums(const SurfaceTerms& terms, std::size_t right_sides, bool products)
      : degrees_(terms.degrees),
        orders_(products ? 2 * terms.orders : terms.orders),
        products_(products ? row_of(terms.degrees + 1, 0) : 0),
        sums_(MatrixXd::Zero(row_of_right(static_cast<Index>(right_sides), 0), 2 * orders_ + 2)) {}

  void add(std::span<const double> angle_rad, std::span<const double> t,
           std::span<const std::vector<double>> y_mm, std::size_t begin) {
    const auto n = static_cast<Index>(angle_rad.size());
    MatrixXd along(n, sums_.rows()), around(n, sums_.cols());
    for (Index i = 0; i < n; ++i) {
      const auto at = static_cast<std::size_t>(i);
      fill_along(along, i, t[at], y_mm, begin + at);
      around(i, 1) = std::cos(angle_rad[at]);
      around(i, orders_ + 2) = std::sin(angle_rad[at]);
    }
    for (Index k = 0; k <= orders_; ++k)
      for (Index i = 0; i < n; ++i)
        fill_around(around, i, k, angle_rad[static_cast<std::size_t>(i)]);
    sums_ += linear::transposed_product(along, around);
  }

  Complex product(Index d, Index e, Index k) const { return at(row_of(d, e), k); }
  Complex with_y(Index y, Index d, Index k) const { return at(row_of_right(y, d), k); }

 private:
  Complex at(Index row, Index k) const { return {sums_(row, k), sums_(row, orders_ + 1 + k)}; }

  static Index row_of(Index d, Index e) { return d * (d + 1) / 2 + e; }
  Index row_of_right(Index y, Index d) const { return products_ + y * (degrees_ + 1) + d; }

  void fill_along(MatrixXd& along, Index i, double t, std::span<const std::vector<double>> y_mm,
                  std::size_t reading) const {
    const Eigen::VectorXd f = form::along(static_cast<int>(degrees_), t);
    for (Index d = 0; d <= degrees_; ++d) {
      for (Index e = 0; products_ > 0 && e <= d; ++e) along(i, row_of(d, e)) = f[d] * f[e];
      for (std::size_t y = 0; y < y_mm.size(); ++y)
        along(i, row_of_right(static_cast<Index>(y), d)) = y_mm[y][reading] * f[d];
    }
  }

  /// exp(ikθ) by the order before it; anew every 32 orders.
  void fill_around(MatrixXd& around, Index i, Index k, double angle) const {
    const Index im = orders_ + 1;
    if (k % 32 == 0) {
      around(i, k) = std::cos(static_cast<double>(k) * angle);
      around(i, im + k) = std::sin(static_cast<double>(k) * angle);
    } else if (k > 1) {
      const double c = around(i, 1), s = around(i, im + 1);
      const double a = around(i, k - 1), b = around(i, im + k - 1);
      around(i, k) = a * c - b * s;
      around(i, im + k) = a * s + b * c;
    }
  }

  Index degrees_, orders_, products_;
  MatrixXd sums_;
};

class NormalMatrix {
 public:
  NormalMatrix(const SurfaceTerms& terms, const Sums& sums)
      : terms_(terms), out_(terms.size(), terms.size()) {
    products_.resize(static_cast<std::size_t>(2 * terms.orders + 1));
    for (int d = 0; d <= terms.degrees; ++d)
      for (int e = 0; e <= d; ++e) {
        for (std::size_t k = 0; k < products_.size(); ++k)
          products_[k] = sums.product(d, e, static_cast<Index>(k));
        for (int a = 0; a <= terms.orders && d <= terms.degrees_of(a); ++a)
          for (int b = 0; b <= terms.orders && e <= terms.degrees_of(b); ++b) put(a, d, b, e);
      }
  }
  MatrixXd take() { return std::move(out_); }

 private:
  void put(int a, int d, int b, int e) {
    const Complex more = products_[static_cast<std::size_t>(a + b)];
    Complex less = products_[static_cast<std::size_t>(std::abs(a - b))];
    if (a < b) less = std::conj(less);
    const Index i = terms_.column(a, d), j = terms_.column(b, e);
    const auto set = [&](Index row, Index column, double value) {
      out_(row, column) = value;
      out_(column, row) = value;
    };
    set(i, j, 0.5 * (less.real() + more.real()));
    if (b > 0) set(i, j + 1, 0.5 * (more.imag() - less.imag()));
    if (a > 0) set(i + 1, j, 0.5 * (more.imag() + less.imag()));
    if (a > 0 && b > 0) set(i + 1, j + 1, 0.5 * (less.real() - more.real()));
  }

  const SurfaceTerms& terms_;
  MatrixXd out_;
  std::vector<Complex> products_;
};

}  // namespace

Eigen::VectorXd along(int degrees, double t) {
  Eigen::VectorXd out(degrees + 1);
  double before = t, polynomial = 1.0;
  for (int d = 0; d <= std::min(degrees, cosines_from - 1); ++d) {
    out[d] = std::sqrt((4.0 * d * d - 1.0) / (2.0 * d * d - 1.0)) * polynomial;
    before = std::exchange(polynomial, 2.0 * t * polynomial - before);
  }
  const double phase = 0.5 * std::numbers::pi * (t / longer + 1.0);
  for (int d = cosines_from; d <= degrees; ++d) out[d] = std::numbers::sqrt2 * std::cos(d * phase);
  return out;
}

namespace {

Sums summed(const SurfaceTerms& terms, std::span<const double> angle_rad, std::span<const double> t,
            std::span<const std::vector<double>> y_mm, bool products) {
  Sums sums(terms, y_mm.size(), products);
  for (std::size_t begin = 0; begin < t.size(); begin += block) {
    const std::size_t n = std::min(block, t.size() - begin);
    sums.add(angle_rad.subspan(begin, n), t.subspan(begin, n), y_mm, begin);
  }
  return sums;
}

MatrixXd right_of(const SurfaceTerms& terms, const Sums& sums, std::size_t count) {
  MatrixXd right(terms.size(), static_cast<Index>(count));
  for (Index y = 0; y < right.cols(); ++y)
    for (int n = 0; n <= terms.orders; ++n)
      for (int d = 0; d <= terms.degrees_of(n); ++d) {
        const Complex sum = sums.with_y(y, d, n);
        right(terms.column(n, d), y) = sum.real();
        if (n > 0) right(terms.column(n, d) + 1, y) = sum.imag();
      }
  return right;
}

}  // namespace

SurfaceSums surface_sums(const SurfaceTerms& terms, std::span<const double> angle_rad,
                         std::span<const double> t, std::span<const std::vector<double>> y_mm) {
  const Sums sums = summed(terms, angle_rad, t, y_mm, true);
  SurfaceSums out;
  out.count = t.size();
  out.normal = NormalMatrix(terms, sums).take();
  out.right = right_of(terms, sums, y_mm.size());
  out.squares = Eigen::VectorXd::Zero(out.right.cols());
  for (Index y = 0; y < out.right.cols(); ++y)
    for (const double one : y_mm[static_cast<std::size_t>(y)]) out.squares[y] += one * one;
  return out;
}

MatrixXd surface_right(const SurfaceTerms& terms, std::span<const double> angle_rad,
                       std::span<const double> t, std::span<const std::vector<double>> y_mm) {
  return right_of(terms, summed(terms, angle_rad, t, y_mm, false), y_mm.size());
}

}  // namespace trueaxis::form

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

namespace trueaxis::form {

/// A surface over angle θ and length t in [−1, 1], h = Σ_n Σ_d f_d(t) (a_nd cos nθ + b_nd sin nθ).
/// Up to d = 5 f_d is a multiple of the Chebyshev polynomial T_d: courses that are simple, whatever
/// their slope at the ends. Above it is √2 cos(d π (t/1.25 + 1) / 2), which resolves as much at the
/// ends as inside; polynomials would make form of noise there. The mean squares are 1. Eq. 317.
struct SurfaceTerms {
  int orders = 1, degrees = 1;
  int last_order_of_all = 16;  ///< orders above have fewer degrees
  int degrees_of_others = 3;

  int degrees_of(int n) const {
    return n <= last_order_of_all ? degrees : std::min(degrees, degrees_of_others);
  }
  static int width(int n) { return n == 0 ? 1 : 2; }  ///< cosine, sine
  /// Column of order n and degree d; from n = 1 on of its cosine, which the sine follows.
  Eigen::Index column(int n, int d) const {
    if (n == 0) return d;
    const int all = std::min(n - 1, last_order_of_all), others = n - 1 - all;
    return (1 + degrees) * (1 + 2 * all) + 2 * (1 + degrees_of(last_order_of_all + 1)) * others +
           2 * d;
  }
  Eigen::Index size() const { return column(orders + 1, 0); }
};

/// f_0(t) … f_degrees(t).
Eigen::VectorXd along(int degrees, double t);

/// AᵀA of the columns of a surface over readings, and Aᵀy and yᵀy of each y.
struct SurfaceSums {
  Eigen::MatrixXd normal, right;
  Eigen::VectorXd squares;
  std::size_t count = 0;
};

/// A product of two columns is a sum of products f_d f_e with exp(ikθ). AᵀA therefore takes
/// N (D + 1) (D + 4) (2M + 1) steps for its (2M + 1)² (D + 1)² entries. Eq. 318.
SurfaceSums surface_sums(const SurfaceTerms& terms, std::span<const double> angle_rad,
                         std::span<const double> t, std::span<const std::vector<double>> y_mm);

/// Aᵀy of each y alone.
Eigen::MatrixXd surface_right(const SurfaceTerms& terms, std::span<const double> angle_rad,
                              std::span<const double> t, std::span<const std::vector<double>> y_mm);

}  // namespace trueaxis::form

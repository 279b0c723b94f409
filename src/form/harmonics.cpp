// SPDX-License-Identifier: Apache-2.0
#include "form/harmonics.hpp"

#include <Eigen/Dense>
#include <cmath>
#include <complex>

#include "math/linear_algebra.hpp"
#include "trueaxis/error.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis::form {
namespace {

using Complex = std::complex<double>;

/// Σ_i w_i exp(ikθ_i), k = 0 … orders − 1; the recurrence begins anew every 32 orders.
std::vector<Complex> sums_of(const Trace& trace, const std::vector<double>& w, std::size_t orders) {
  std::vector<Complex> sums(orders);
  for (std::size_t i = 0; i < trace.size(); ++i) {
    const Complex turn = std::polar(1.0, trace.at[i]);
    Complex at = 1.0;
    for (std::size_t k = 0; k < orders; ++k) {
      if (k % 32 == 0) at = std::polar(1.0, trace.at[i] * static_cast<double>(k));
      sums[k] += w[i] * at;
      at *= turn;
    }
  }
  return sums;
}

/// AᵀA of the columns 1, cos θ, sin θ, cos 2θ, … from the sums of orders to 2m. Eq. 267.
Eigen::MatrixXd normal_matrix(const std::vector<Complex>& sums, int order_max) {
  const Eigen::Index size = 2 * order_max + 1;
  Eigen::MatrixXd normal(size, size);
  const auto of = [&](int k) {
    const Complex sum = sums[static_cast<std::size_t>(std::abs(k))];
    return k < 0 ? std::conj(sum) : sum;
  };
  for (int a = 0; a <= order_max; ++a)
    for (int b = 0; b <= order_max; ++b) {
      const Complex less = of(a - b), more = of(a + b);
      const Eigen::Index i = a == 0 ? 0 : 2 * a - 1, j = b == 0 ? 0 : 2 * b - 1;
      normal(i, j) = 0.5 * (less.real() + more.real());
      if (b > 0) normal(i, j + 1) = 0.5 * (more.imag() - less.imag());
      if (a > 0) normal(i + 1, j) = 0.5 * (more.imag() + less.imag());
      if (a > 0 && b > 0) normal(i + 1, j + 1) = 0.5 * (less.real() - more.real());
    }
  return normal;
}

/// The solution and the variances of its entries over that of a reading.
std::pair<Eigen::VectorXd, Eigen::VectorXd> solved(const Eigen::MatrixXd& normal,
                                                   const Eigen::VectorXd& right) {
  const Eigen::VectorXd diagonal = normal.diagonal();
  Eigen::MatrixXd off = normal;
  off.diagonal().setZero();
  if (off.cwiseAbs().maxCoeff() < 1e-12 * diagonal.maxCoeff())  // even angles
    return {right.cwiseQuotient(diagonal), diagonal.cwiseInverse()};
  const linear::Cholesky factor(normal);
  return {factor.solve(right), factor.inverse().diagonal()};
}

}  // namespace

double Order::amplitude_mm() const { return std::hypot(cos_mm, sin_mm); }

double Order::phase_rad() const {
  const double angle = std::atan2(sin_mm, cos_mm);
  return angle < 0.0 ? angle + two_pi : angle;
}

std::vector<Order> harmonics_of(const Trace& trace, int order_max) {
  const auto m = static_cast<std::size_t>(order_max);
  expects(trace.size() > 2 * m + 1, "more readings than harmonics have numbers");
  const std::vector<double> ones(trace.size(), 1.0);
  const Eigen::MatrixXd normal = normal_matrix(sums_of(trace, ones, 2 * m + 1), order_max);
  const std::vector<Complex> values = sums_of(trace, trace.value_mm, m + 1);
  Eigen::VectorXd right(normal.rows());
  right[0] = values[0].real();
  for (Eigen::Index k = 1; k <= order_max; ++k) {
    right[2 * k - 1] = values[static_cast<std::size_t>(k)].real();
    right[2 * k] = values[static_cast<std::size_t>(k)].imag();
  }
  const auto [solution, variance] = solved(normal, right);
  std::vector<Order> orders{{0, solution[0], 0.0, std::sqrt(variance[0])}};
  for (Eigen::Index k = 1; k <= order_max; ++k)
    orders.push_back({static_cast<int>(k), solution[2 * k - 1], solution[2 * k],
                      std::sqrt(0.5 * (variance[2 * k - 1] + variance[2 * k]))});
  return orders;
}

}  // namespace trueaxis::form

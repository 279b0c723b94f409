// SPDX-License-Identifier: Apache-2.0
#include "form/true_form.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "support/dense.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis::form_study {
namespace {

constexpr int angles = 360, places = 31;

/// Convolution with exp(−π (θ / (α λ_c))²), normalised over the grid.
std::vector<double> filtered(const std::vector<double>& profile, double high_upr) {
  const double width = std::sqrt(std::numbers::ln2 / std::numbers::pi) * two_pi / high_upr;
  std::vector<double> weight(angles), out(angles, 0.0);
  double sum = 0.0;
  for (int k = 0; k < angles; ++k) {
    const double off = std::remainder(two_pi * k / angles, two_pi) / width;
    weight[static_cast<std::size_t>(k)] = std::exp(-std::numbers::pi * off * off);
    sum += weight[static_cast<std::size_t>(k)];
  }
  for (int i = 0; i < angles; ++i)
    for (int k = 0; k < angles; ++k)
      out[static_cast<std::size_t>(i)] += weight[static_cast<std::size_t>(k)] / sum *
                                          profile[static_cast<std::size_t>((i + k) % angles)];
  return out;
}

/// ln Σ exp(s β y) / β of y = h − rows q, and its derivatives by q.
struct SoftEnd {
  double value = 0.0;
  Eigen::VectorXd slope;
  Eigen::MatrixXd curvature;
};

/// Calls back with each row that counts and its weight exp(β (s y − largest)): below e^−40 it is
/// lost in the rounding of the sum.
template <class Function>
double for_each_near_end(const Eigen::VectorXd& y, double beta, double side, Function&& function) {
  const double largest = (side * y).maxCoeff();
  for (Eigen::Index i = 0; i < y.size(); ++i)
    if (const double exponent = beta * (side * y[i] - largest); exponent > -40.0)
      function(i, std::exp(exponent));
  return largest;
}

double soft_value(const Eigen::VectorXd& y, double beta, double side) {
  double sum = 0.0;
  const double largest =
      for_each_near_end(y, beta, side, [&](Eigen::Index, double weight) { sum += weight; });
  return largest + std::log(sum) / beta;
}

SoftEnd soft_end(const Eigen::MatrixXd& rows, const Eigen::VectorXd& y, double beta, double side) {
  const Eigen::Index n = rows.cols();
  double sum = 0.0;
  Eigen::VectorXd mean = Eigen::VectorXd::Zero(n);
  Eigen::MatrixXd products = Eigen::MatrixXd::Zero(n, n);
  const double largest = for_each_near_end(y, beta, side, [&](Eigen::Index i, double weight) {
    sum += weight;
    for (Eigen::Index a = 0; a < n; ++a) {
      mean[a] += weight * rows(i, a);
      for (Eigen::Index b = 0; b < n; ++b) products(a, b) += weight * rows(i, a) * rows(i, b);
    }
  });
  mean /= sum;
  return {largest + std::log(sum) / beta, -side * mean,
          beta * (products / sum - mean * mean.transpose())};
}

/// Least range of h − rows q.
double least_range(const Eigen::MatrixXd& rows, const Eigen::VectorXd& h) {
  Eigen::VectorXd q = dense::least_squares(rows, Eigen::VectorXd(h.array() - h.mean()));
  const auto range = [&](const Eigen::VectorXd& at) {
    const Eigen::VectorXd y = h - rows * at;
    return y.maxCoeff() - y.minCoeff();
  };
  const double first = range(q);
  if (first < 1e-12) return first;
  for (double beta = 10.0 / first; beta < 3e4 / first; beta *= 2.0)
    for (int step = 0; step < 8; ++step) {
      const Eigen::VectorXd y = h - rows * q;
      const SoftEnd high = soft_end(rows, y, beta, 1.0), low = soft_end(rows, y, beta, -1.0);
      Eigen::MatrixXd curvature = high.curvature + low.curvature;
      curvature.diagonal().array() += 1e-6 * curvature.trace() + 1e-12;
      const Eigen::VectorXd move = -dense::solve_symmetric(curvature, high.slope + low.slope);
      double length = 1.0;
      const auto soft = [&](const Eigen::VectorXd& at) {
        const Eigen::VectorXd z = h - rows * at;
        return soft_value(z, beta, 1.0) + soft_value(z, beta, -1.0);
      };
      const double now = high.value + low.value;
      while (length > 1e-3 && soft(q + length * move) > now) length *= 0.5;
      if (length <= 1e-3) break;
      q += length * move;
    }
  return range(q);
}

}  // namespace

TrueForm true_form(const Radius& radius, double length_mm, double high_upr) {
  Eigen::MatrixXd circle(angles, 2), cylinder(angles * places, 4);
  Eigen::VectorXd all(angles * places);
  TrueForm out;
  for (int p = 0; p < places; ++p) {
    const double z = length_mm * p / (places - 1);
    std::vector<double> profile;
    for (int i = 0; i < angles; ++i) profile.push_back(radius(two_pi * i / angles, z));
    profile = filtered(profile, high_upr);
    for (int i = 0; i < angles; ++i) {
      const double c = std::cos(two_pi * i / angles), s = std::sin(two_pi * i / angles);
      circle.row(i) << c, s;
      cylinder.row(p * angles + i) << c, s, c * (2.0 * z / length_mm - 1.0),
          s * (2.0 * z / length_mm - 1.0);
      all[p * angles + i] = profile[static_cast<std::size_t>(i)];
    }
    out.ront_mm = std::max(out.ront_mm, least_range(circle, all.segment(p * angles, angles)));
  }
  out.cylt_mm = least_range(cylinder, all);
  return out;
}

}  // namespace trueaxis::form_study

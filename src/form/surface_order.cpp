// SPDX-License-Identifier: Apache-2.0
#include "form/surface_order.hpp"

#include <cmath>
#include <utility>

#include "math/linear_algebra.hpp"

namespace trueaxis::form {
namespace {

constexpr double reaches[] = {0.3, 1.5, 4.0, 8.0};  // degrees that a course holds; 0.3: a line
constexpr double shares[] = {0.1, 2.0};             // of what changes, over what stays
constexpr double least_weight = 1e-4;

}  // namespace

std::vector<Eigen::VectorXd> courses_along_z(int first_degree, int degrees) {
  std::vector<Eigen::VectorXd> out;
  if (first_degree == 0) out.push_back(Eigen::VectorXd::Unit(degrees + 1, 0));
  const int changing = std::max(1, first_degree);
  for (const double share : shares) {
    for (const double reach : reaches) {
      Eigen::VectorXd weight = Eigen::VectorXd::Zero(degrees + 1);
      if (first_degree == 0) weight[0] = 1.0;
      for (int d = changing; d <= degrees; ++d) {
        const double off = (d - changing) / reach;
        weight[d] = (first_degree == 0 ? share : 1.0) * std::exp(-off * off);
        if (weight[d] < least_weight) weight[d] = 0.0;
      }
      out.push_back(weight);
      if (reach >= degrees) break;
    }
    if (first_degree > 0) break;
  }
  return out;
}

SurfaceOrder::SurfaceOrder(int order, int first_degree, int degrees, Eigen::Index column,
                           Eigen::MatrixXd normal)
    : order_(order), first_degree_(first_degree), column_(column), normal_(std::move(normal)) {
  const int width = SurfaceTerms::width(order);
  for (const Eigen::VectorXd& one : courses_along_z(first_degree, degrees)) {
    Eigen::VectorXd weight(size());
    for (Eigen::Index i = 0; i < size(); ++i) weight[i] = one[first_degree + i / width];
    weights_.push_back(weight);
  }
  systems_.resize(weights_.size());
}

const SurfaceOrder::System& SurfaceOrder::system(std::size_t course) const {
  if (systems_[course]) return *systems_[course];
  const Eigen::VectorXd root = weights_[course].cwiseSqrt();
  std::vector<Eigen::Index> there;
  for (Eigen::Index i = 0; i < size(); ++i)
    if (root[i] > 0.0) there.push_back(i);
  const auto m = static_cast<Eigen::Index>(there.size());
  Eigen::MatrixXd scaled(m, m);
  for (Eigen::Index i = 0; i < m; ++i)
    for (Eigen::Index j = 0; j < m; ++j) {
      const Eigen::Index a = there[static_cast<std::size_t>(i)],
                         b = there[static_cast<std::size_t>(j)];
      scaled(i, j) = root[a] * normal_(a, b) * root[b];
    }
  linear::Spectrum spectrum = linear::spectrum(scaled);
  System out{spectrum.values.cwiseMax(0.0), Eigen::MatrixXd::Zero(size(), m)};
  for (Eigen::Index i = 0; i < m; ++i) {
    const Eigen::Index a = there[static_cast<std::size_t>(i)];
    out.back.row(a) = root[a] * spectrum.vectors.row(i);
  }
  systems_[course] = std::move(out);
  return *systems_[course];
}

void SurfaceOrder::evidence(const Eigen::VectorXd& right, double variance,
                            const std::vector<double>& sizes, Eigen::MatrixXd& out) const {
  out.resize(static_cast<Eigen::Index>(courses()), static_cast<Eigen::Index>(sizes.size()));
  const Eigen::ArrayXd gain = Eigen::Map<const Eigen::ArrayXd>(sizes.data(), out.cols()) / variance;
  Eigen::ArrayXd grown(gain.size()), square(gain.size()), product(gain.size());
  Eigen::ArrayXd log_product(gain.size());
  for (std::size_t course = 0; course < courses(); ++course) {
    const System& in = system(course);
    const Eigen::VectorXd seen = in.back.transpose() * right;
    square.setZero(), product.setOnes(), log_product.setZero();
    for (Eigen::Index j = 0; j < seen.size(); ++j) {
      grown = 1.0 + gain * in.values[j];
      square += seen[j] * seen[j] / grown;
      product *= grown;
      if (product[product.size() - 1] > 1e200) {  // that of the largest size
        log_product += product.log();
        product.setOnes();
      }
    }
    out.row(static_cast<Eigen::Index>(course)) =
        0.5 * (gain / variance * square - log_product - product.log());
  }
}

Eigen::VectorXd SurfaceOrder::draw(const Eigen::VectorXd& right, double variance,
                                   std::size_t course, double size,
                                   const Eigen::VectorXd& normal_numbers) const {
  const System& in = system(course);
  Eigen::VectorXd at = in.back.transpose() * right;
  const double tau = std::sqrt(size);
  for (Eigen::Index j = 0; j < at.size(); ++j) {
    const double precision = 1.0 + size / variance * in.values[j];
    at[j] = tau / variance * at[j] / precision + normal_numbers[j] / std::sqrt(precision);
  }
  return tau * (in.back * at);
}

}  // namespace trueaxis::form

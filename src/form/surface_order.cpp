// SPDX-License-Identifier: Apache-2.0
#include "form/surface_order.hpp"

#include <algorithm>
#include <cmath>

#include "form/order_evidence.hpp"
#include "form/surface_local.hpp"
#include "math/linear_algebra.hpp"

namespace trueaxis::form {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double reaches[] = {0.3, 1.9, 5.0, 10.0};  // degrees that a course holds; 0.3: a line
constexpr double shares[] = {0.1, 2.0};              // of what changes, over what stays
constexpr double least_weight = 1e-4;

/// How an order's size may run along Z: variances of its degrees over that of the first. The first
/// of these is an order that is the same at every Z. Eq. 319.
std::vector<VectorXd> courses_along_z(int first_degree, int degrees) {
  std::vector<VectorXd> out;
  if (first_degree == 0) out.push_back(VectorXd::Unit(degrees + 1, 0));
  const int changing = std::max(1, first_degree);
  for (const double share : shares) {
    for (const double reach : reaches) {
      VectorXd weight = VectorXd::Zero(degrees + 1);
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

}  // namespace

SurfaceOrder::SurfaceOrder(int order, int first_degree, int degrees, Index column,
                           const MatrixXd& normal)
    : order_(order), first_degree_(first_degree), column_(column), seen_(0, normal.rows()) {
  const int width = SurfaceTerms::width(order);
  for (const VectorXd& one : courses_along_z(first_degree, degrees)) {
    VectorXd weight(size());
    for (Index i = 0; i < size(); ++i) weight[i] = one[first_degree + i / width];
    add_course(weight, normal);
  }
}

SurfaceOrder::SurfaceOrder(Index column, const MatrixXd& normal, double log_tests)
    : log_tests_(log_tests), column_(column), seen_(0, normal.rows()) {
  VectorXd weight(normal.rows());
  for (Index k = 0; k < weight.size(); ++k)
    weight[k] = LocalForm::shapes[static_cast<std::size_t>(k)].variance;
  add_course(weight, normal);
}

void SurfaceOrder::add_course(const VectorXd& weight, const MatrixXd& normal) {
  std::vector<Index> there;
  for (Index i = 0; i < size(); ++i)
    if (weight[i] > 0.0) there.push_back(i);
  const auto m = static_cast<Index>(there.size());
  const VectorXd root = weight(there).cwiseSqrt();
  const linear::Spectrum spectrum =
      linear::spectrum(linear::scaled_both(normal(there, there), root));
  seen_.conservativeResize(begin_.back() + m, Eigen::NoChange);
  seen_.bottomRows(m).setZero();
  seen_(Eigen::lastN(m), there) = linear::scaled_columns(spectrum.vectors.transpose(), root);
  for (const double value : spectrum.values) values_.push_back(std::max(value, 0.0));
  begin_.push_back(begin_.back() + m);
}

void SurfaceOrder::evidence(const VectorXd& right, double variance, std::span<const double> gain,
                            MatrixXd& out) const {
  out.resize(static_cast<Index>(gain.size()), courses());
  const VectorXd squares = (seen_ * right).array().square();
  for (Index course = 0; course < courses(); ++course) {
    const auto from = static_cast<std::size_t>(begin(course)),
               to = static_cast<std::size_t>(begin(course + 1));
    weigh_sizes({values_.data() + from, to - from}, {squares.data() + from, to - from}, gain,
                variance, out.col(course).data());
  }
  out.array() -= log_tests_;
}

VectorXd SurfaceOrder::draw(const VectorXd& right, double variance, Index course, double size,
                            const VectorXd& normal_numbers) const {
  const Index from = begin(course), count = begin(course + 1) - from;
  const auto seen = seen_.middleRows(from, count);
  VectorXd at = seen * right;
  const double tau = std::sqrt(size);
  for (Index j = 0; j < count; ++j) {
    const double precision = 1.0 + size / variance * values_[static_cast<std::size_t>(from + j)];
    at[j] = tau / variance * at[j] / precision + normal_numbers[j] / std::sqrt(precision);
  }
  return tau * (seen.transpose() * at);
}

}  // namespace trueaxis::form

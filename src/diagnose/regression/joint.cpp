// SPDX-License-Identifier: Apache-2.0
#include "diagnose/regression/joint.hpp"

#include <algorithm>
#include <cmath>

#include "math/linear_algebra.hpp"

namespace trueaxis::diagnose_detail {
namespace {

/// x and y of the last axis at height u of mid length, from its base coefficients. Of a face what
/// its tilt makes at the outer end.
Eigen::MatrixXd position_at(const LinearisationPoint& point, double u) {
  const auto per = static_cast<Eigen::Index>(point.base.per_axis());
  Eigen::MatrixXd at = Eigen::MatrixXd::Zero(2, per);
  if (point.base.face) {
    at(0, 0) = at(1, 1) = point.end_mm();
    return at;
  }
  at(0, 0) = at(1, 1) = 1.0;
  if (point.base.tilts) at(0, 2) = at(1, 3) = u * point.z_half_mm;
  return at;
}

Eigen::Index last_axis(const LinearisationPoint& point) {
  return static_cast<Eigen::Index>((point.base.axes - 1) * point.base.per_axis());
}

}  // namespace

Joint::Joint(const Problem& problem, const std::vector<double>& phi,
             std::vector<Hypothesis> hypotheses, std::size_t fitted_terms, bool blocks)
    : equations(problem.point, problem.mask, problem.deviation_mm, phi, problem.threads, blocks),
      places(equations.append(hypotheses, fitted_terms)),
      terms(std::move(hypotheses)),
      fitted(fitted_terms) {
  solution = solve(equations.total(), besides());
  const auto freedom = static_cast<double>(equations.count()) - static_cast<double>(solution.rank);
  sigma_mm = freedom > 0.0 ? std::sqrt(std::max(solution.rss, 0.0) / freedom) : 0.0;
}

Eigen::VectorXd Joint::base() const {
  return solution.coefficients.head(static_cast<Eigen::Index>(equations.base().size()));
}

Eigen::MatrixXd Joint::base_covariance() const {
  const auto n = static_cast<Eigen::Index>(equations.base().size());
  return sigma_mm * sigma_mm * solution.inverse.topLeftCorner(n, n);
}

Eigen::VectorXd Joint::of(std::size_t term) const {
  auto at = static_cast<Eigen::Index>(equations.base().size());
  for (std::size_t t = 0; t < term; ++t) at += static_cast<Eigen::Index>(places[t].size());
  return solution.coefficients.segment(at, static_cast<Eigen::Index>(places[term].size()));
}

std::vector<double> Joint::contribution_of(std::size_t term) const {
  const Eigen::VectorXd linear = of(term);
  return contribution(equations.point(), {&terms[term], 1}, span_of(linear), equations.threads());
}

AxisShift axis_shift(const LinearisationPoint& point, const Eigen::VectorXd& change,
                     const Eigen::MatrixXd& covariance) {
  const auto per = static_cast<Eigen::Index>(point.base.per_axis());
  const Eigen::Index from = last_axis(point);
  AxisShift worst;
  for (const double u : {-1.0, 1.0}) {  // the distance is convex along the axis
    const Eigen::MatrixXd at = position_at(point, u);
    const Eigen::VectorXd d = at * change.segment(from, per);
    const Eigen::MatrixXd c = linear::propagated(at, covariance.block(from, from, per, per));
    const double length = d.norm();
    const Eigen::VectorXd along =
        length > 0.0 ? Eigen::VectorXd(d / length) : Eigen::VectorXd::Unit(2, 0);
    if (length >= worst.value_mm) worst = {length, std::sqrt(std::max(0.0, along.dot(c * along)))};
  }
  return worst;
}

Eigen::MatrixXd covariance_of_ends(const LinearisationPoint& point, Eigen::Index base,
                                   double u_mm) {
  const auto per = static_cast<Eigen::Index>(point.base.per_axis());
  Eigen::MatrixXd ends(4, per);
  ends << position_at(point, -1.0), position_at(point, 1.0);
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(base, base);
  out.block(last_axis(point), last_axis(point), per, per) =
      u_mm * u_mm * linear::inverse(linear::gram(ends)) * (per < 4 ? 2.0 : 1.0);
  return out;
}

AxisUncertainty axis_uncertainty(const LinearisationPoint& point,
                                 const Eigen::MatrixXd& base_covariance) {
  const auto per = static_cast<Eigen::Index>(point.base.per_axis());
  const Eigen::Index from = last_axis(point);
  AxisUncertainty worst;
  for (const double u : {-1.0, 1.0}) {
    const Eigen::MatrixXd at = position_at(point, u);
    const Eigen::MatrixXd c = linear::propagated(at, base_covariance.block(from, from, per, per));
    worst.u_mm = std::max(worst.u_mm, std::sqrt(std::max(0.0, linear::spectrum(c).values(1))));
    worst.rms_mm = std::max(worst.rms_mm, std::sqrt(std::max(0.0, c.trace())));
  }
  return worst;
}

}  // namespace trueaxis::diagnose_detail

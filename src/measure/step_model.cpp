// SPDX-License-Identifier: Apache-2.0
#include "measure/step_model.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <cmath>
#include <utility>
#include <vector>

#include "math/linear_algebra.hpp"
#include "math/statistics.hpp"

namespace trueaxis::step_model {
namespace {

/// −1 to 1 over a column; 0 if it is constant.
Eigen::VectorXd scaled(Eigen::VectorXd column) {
  const double low = column.minCoeff(), half = 0.5 * (column.maxCoeff() - low);
  return half > 0.0 ? Eigen::VectorXd((column.array() - low) / half - 1.0)
                    : Eigen::VectorXd::Zero(column.size());
}

}  // namespace

Eigen::MatrixX2d places(std::span<const TurnCentre> run) {
  Eigen::MatrixX2d out(static_cast<Eigen::Index>(run.size()), 2);
  for (Eigen::Index i = 0; i < out.rows(); ++i) {
    const TurnCentre& one = run[static_cast<std::size_t>(i)];
    out.row(i) << one.x_mm, one.y_mm;
  }
  return out;
}

Eigen::MatrixXd line(std::span<const TurnCentre> run) {
  const auto n = static_cast<Eigen::Index>(run.size());
  Eigen::VectorXd z(n);
  for (Eigen::Index i = 0; i < n; ++i) z(i) = run[static_cast<std::size_t>(i)].position_mm;
  Eigen::MatrixXd out(n, 3);
  out << Eigen::VectorXd::Ones(n), scaled(z), Eigen::VectorXd::LinSpaced(n, -1.0, 1.0);
  return out;
}

double squares_about(const Eigen::MatrixXd& columns, const Eigen::MatrixX2d& centres) {
  const Eigen::MatrixXd model = linear::pivoted_least_squares(columns, Eigen::MatrixXd(centres));
  return (centres - linear::product(columns, model)).squaredNorm();
}

double variance(const Eigen::MatrixX2d& centres, double u_mm) {
  const Eigen::Index n = centres.rows() - 2;
  const Eigen::MatrixX2d second =
      centres.topRows(n) - 2.0 * centres.middleRows(1, n) + centres.bottomRows(n);
  std::vector<double> squares;
  for (Eigen::Index i = 0; i < n; ++i) squares.push_back(second.row(i).squaredNorm());
  // median of χ²(2)
  return std::max(u_mm * u_mm, median(std::move(squares)) / (2.0 * std::log(2.0) * 6.0));
}

double enough(double by_chance, std::size_t centres) {
  return quantile(
      complement(boost::math::chi_squared(4.0), by_chance / static_cast<double>(centres)));
}

}  // namespace trueaxis::step_model

// SPDX-License-Identifier: Apache-2.0
#include <Eigen/Dense>
#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "job/mistakes.hpp"
#include "math/linear_algebra.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

using Matrix4 = Eigen::Matrix<double, 4, 4, Eigen::RowMajor>;

constexpr double rounding_mm = 1e-7, rounding_rad = 1e-9;  // of a stream's digits
// How far surfaces of real parts are out of their common axis: a ladder of a factor four.
constexpr double out_of_axis_mm[] = {1e-3, 4e-3, 16e-3, 64e-3};
constexpr double out_of_axis_rad[] = {1e-5, 4e-5, 16e-5, 64e-5};
// And where a part is that was clamped anew.
constexpr double clamped_anew_mm = 1.0, clamped_anew_rad = 0.01;
// A Gaussian with the height of the uniform law over a turn; of a datum of Z the size of a lathe.
constexpr double any_turn_rad = 2.5066282746310002;
constexpr double any_datum_mm = 200.0;

/// (x, y, slope_x, slope_y) at z with covariance.
struct At {
  Eigen::Vector4d value;
  Eigen::Matrix4d covariance;
};

At axis_at(const HeldAxis& held, double z_mm) {
  const AxisEstimate& estimate = held.estimate;
  Eigen::Matrix4d move = Eigen::Matrix4d::Identity();
  move(0, 2) = move(1, 3) = z_mm - estimate.axis.z_ref_mm;
  const auto [x, y] = estimate.axis.at(z_mm);
  At out{{x, y, estimate.axis.slope_x, estimate.axis.slope_y}, Eigen::Matrix4d::Zero()};
  const Eigen::Map<const Matrix4> covariance(estimate.covariance.data());
  if (covariance.allFinite()) out.covariance = move * covariance * move.transpose();
  out.covariance.diagonal() +=
      Eigen::Vector4d(rounding_mm, rounding_mm, rounding_rad, rounding_rad).cwiseAbs2();
  return out;
}

double worse_direction(const Eigen::Matrix2d& covariance) {
  return std::sqrt(std::max(linear::eigenvalues(covariance)(1), 0.0));
}

/// What an open number does to (x, y, slope_x, slope_y), times the width of its law.
Eigen::Vector4d open_direction(OpenNumber number, const Eigen::Vector4d& at) {
  if (number == OpenNumber::c_zero)
    return any_turn_rad * Eigen::Vector4d(-at(1), at(0), -at(3), at(2));
  return any_datum_mm * Eigen::Vector4d(-at(2), -at(3), 0.0, 0.0);
}

double middle_of(std::span<const HeldAxis> axes) {
  double sum = 0.0, count = 0.0;
  for (const HeldAxis& axis : axes) {
    if (!axis.plane) sum += axis.z_mid_mm, count += 1.0;
  }
  return count > 0.0 ? sum / count : 0.0;
}

/// With surfaces that are out of their common axis by these scales, each at its own middle.
double log_likelihood_of(std::span<const HeldAxis> axes, std::optional<OpenMistake> open,
                         double s_mm, double s_rad) {
  const double z_mm = middle_of(axes);
  // A common axis of which nothing is known: a standard deviation of 1 km and 1000 rad.
  Eigen::Matrix4d weight = 1e-6 * Eigen::Matrix4d::Identity();
  Eigen::Vector4d weighted = Eigen::Vector4d::Zero();
  double sum = 0.0;
  for (std::size_t i = 0; i < axes.size(); ++i) {
    const At at = axis_at(axes[i], axes[i].z_mid_mm);
    const Eigen::Index from = axes[i].plane ? 2 : 0, n = 4 - from;
    Eigen::Matrix4d covariance = at.covariance;
    covariance.diagonal() += Eigen::Vector4d(s_mm, s_mm, s_rad, s_rad).cwiseAbs2();
    if (open && open->reference == i) {
      const Eigen::Vector4d direction = open_direction(open->number, at.value);
      covariance += direction * direction.transpose();
    }
    Eigen::Matrix4d place = Eigen::Matrix4d::Identity();
    place(0, 2) = place(1, 3) = axes[i].z_mid_mm - z_mm;
    const Eigen::MatrixXd model = place.bottomRows(n);
    const Eigen::VectorXd value = at.value.tail(n);
    const linear::Cholesky factor(covariance.bottomRightCorner(n, n));
    weight += linear::transposed_product(model, factor.solve(model));
    weighted += linear::transposed_product(model, factor.solve(value));
    sum += value.dot(factor.solve(value)) + factor.log_determinant();
  }
  const linear::Cholesky common(weight);
  sum += common.log_determinant() - weighted.dot(common.solve(Eigen::VectorXd(weighted)));
  return -0.5 * sum;
}

}  // namespace

HeldAxis held_axis(const FitResult& fit) {
  const bool plane = fit.surface == SurfaceKind::plane;
  return {fit.axis, plane ? 0.0 : 0.5 * (fit.position_min_mm + fit.position_max_mm), plane,
          fit.x_convention && fit.x_convention->diameter};
}

Disagreement difference_of(const HeldAxis& first, const HeldAxis& second, double coverage_factor) {
  const HeldAxis pair[] = {first, second};
  const double z_mm = middle_of(pair);
  const At a = axis_at(first, z_mm), b = axis_at(second, z_mm);
  const bool slopes_only = first.plane || second.plane;
  const Eigen::Vector4d apart = a.value - b.value;
  const Eigen::Matrix4d covariance = a.covariance + b.covariance;
  Disagreement out;
  out.tilt_rad = apart.tail<2>().norm();
  out.U_tilt_rad = coverage_factor * worse_direction(covariance.bottomRightCorner<2, 2>());
  double chi2 = 0.0;
  if (slopes_only) {
    chi2 = linear::weighed_square(apart.tail<2>(), covariance.bottomRightCorner<2, 2>());
  } else {
    out.offset_mm = apart.head<2>().norm();
    out.U_offset_mm = coverage_factor * worse_direction(covariance.topLeftCorner<2, 2>());
    out.between_mm = std::abs(first.z_mid_mm - second.z_mid_mm);
    chi2 = linear::weighed_square(apart, covariance);
  }
  const boost::math::chi_squared law(slopes_only ? 2.0 : 4.0);
  out.p_value = std::isfinite(chi2) ? cdf(complement(law, std::max(chi2, 0.0))) : 0.0;
  return out;
}

double log_likelihood(std::span<const HeldAxis> axes, std::optional<OpenMistake> open) {
  std::vector<double> of_scales;
  for (const double s_mm : out_of_axis_mm) {
    for (const double s_rad : out_of_axis_rad)
      of_scales.push_back(log_likelihood_of(axes, open, s_mm, s_rad));
  }
  const double most = *std::ranges::max_element(of_scales);
  double mean = 0.0;
  for (const double l : of_scales)
    mean += std::exp(l - most) / static_cast<double>(of_scales.size());
  const bool datum = open && open->number == OpenNumber::z_zero;
  const double far = datum ? open->value / any_datum_mm : 0.0;
  return most + std::log(mean) - 0.5 * far * far;
}

double log_likelihood_clamped_anew(std::span<const HeldAxis> axes) {
  return log_likelihood_of(axes, {}, clamped_anew_mm, clamped_anew_rad);
}

}  // namespace trueaxis

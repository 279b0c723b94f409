// SPDX-License-Identifier: Apache-2.0
#include "correct/coaxiality_distribution.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <boost/math/special_functions/erf.hpp>
#include <boost/random/sobol.hpp>
#include <cmath>
#include <map>
#include <mutex>
#include <numbers>

#include "math/linear_algebra.hpp"

namespace trueaxis {
namespace {

using Matrix4 = Eigen::Matrix<double, 4, 4, Eigen::RowMajor>;
using Vector4 = Eigen::Vector4d;

constexpr std::size_t draws = 1 << 14;  // Sobol: a quantile of 95 % to 1e-3 of itself
constexpr Eigen::Index dimensions = 5;  // of a reference: four of the axis, one of its σ

double normal_quantile(double probability) {
  return -std::numbers::sqrt2 * boost::math::erfc_inv(2.0 * probability);
}

/// Unit normal variates of all draws, of the Sobol points of so many references. A job asks for
/// several distributions, and the variates of all of them are the same: made once.
const std::vector<double>& normals_of(std::size_t references) {
  static std::mutex mutex;
  static std::map<std::size_t, std::vector<double>> made;
  const std::lock_guard lock(mutex);
  std::vector<double>& normals = made[references];
  if (!normals.empty()) return normals;
  boost::random::sobol points(references * dimensions);
  const double scale = 1.0 / (static_cast<double>(points.max()) + 1.0);
  normals.resize(draws * references * dimensions);
  for (double& n : normals) n = normal_quantile((static_cast<double>(points()) + 0.5) * scale);
  return normals;
}

/// √(ν/χ²) of Student's t, from a normal variate (Wilson and Hilferty 1931).
double student_factor(double normal, double freedom) {
  if (!std::isfinite(freedom)) return 1.0;
  const double c = 2.0 / (9.0 * freedom);
  return 1.0 / std::pow(std::max(1.0 - c + normal * std::sqrt(c), 0.1), 1.5);
}

/// Both ends of the cut as seen from the target axis: value and the factor of unit normal variates.
struct Seen {
  Vector4 offset_mm;       ///< x, y at the start, x, y at the end; a face: R × slopes, twice
  Eigen::Matrix4d factor;  ///< of the covariance
  double freedom;
};

Seen seen_from(const Axis& target, const Reference& reference, double z_start_mm, double z_end_mm) {
  const AxisEstimate& axis = reference.axis;
  Eigen::Matrix4d places = Eigen::Matrix4d::Zero();
  Vector4 of_target;
  for (int end = 0; end < 2; ++end) {
    if (const double R = reference.face_radius_mm; R > 0.0) {
      places(2 * end, 2) = places(2 * end + 1, 3) = R;
      of_target.segment<2>(2 * end) << R * target.slope_x, R * target.slope_y;
      continue;
    }
    const double z_mm = end == 0 ? z_start_mm : z_end_mm;
    places(2 * end, 0) = places(2 * end + 1, 1) = 1.0;
    places(2 * end, 2) = places(2 * end + 1, 3) = z_mm - axis.axis.z_ref_mm;
    const auto [x, y] = target.at(z_mm);
    of_target.segment<2>(2 * end) << x, y;
  }
  const Axis& a = axis.axis;
  Seen out{places * Vector4(a.x_mm, a.y_mm, a.slope_x, a.slope_y) - of_target,
           Eigen::Matrix4d::Zero(), reference.freedom};
  const Eigen::Matrix4d covariance =
      places * Eigen::Map<const Matrix4>(axis.covariance.data()) * places.transpose();
  if (!covariance.allFinite()) {
    out.factor.setConstant(std::nan(""));
    return out;
  }
  const auto [variances, axes] = linear::spectrum(covariance);
  out.factor = linear::scaled_columns(axes, variances.cwiseMax(0.0).cwiseSqrt());
  return out;
}

}  // namespace

CoaxialityDistribution::CoaxialityDistribution(std::span<const Reference> references,
                                               const Axis& target, double z_start_mm,
                                               double z_end_mm) {
  std::vector<Seen> seen;
  for (const Reference& reference : references)
    seen.push_back(seen_from(target, reference, z_start_mm, z_end_mm));
  if (std::ranges::any_of(seen, [](const Seen& s) { return !s.factor.allFinite(); })) return;
  const double* next = normals_of(seen.size()).data();
  sorted_mm_.reserve(draws);
  for (std::size_t draw = 0; draw < draws; ++draw) {
    double worst_mm = 0.0;
    for (const Seen& s : seen) {
      using Normals = Eigen::Matrix<double, dimensions, 1>;
      const Normals normal = Eigen::Map<const Normals>(next);
      next += dimensions;
      const Vector4 off =
          s.offset_mm + s.factor * normal.head<4>() * student_factor(normal[4], s.freedom);
      worst_mm = std::max({worst_mm, off.head<2>().norm(), off.tail<2>().norm()});
    }
    sorted_mm_.push_back(2.0 * worst_mm);
  }
  std::ranges::sort(sorted_mm_);
}

double CoaxialityDistribution::quantile(double probability) const {
  if (sorted_mm_.empty()) return std::nan("");
  const double at = probability * static_cast<double>(draws) - 0.5;
  const auto below = static_cast<std::size_t>(std::clamp(at, 0.0, draws - 2.0));
  return std::lerp(sorted_mm_[below], sorted_mm_[below + 1],
                   std::clamp(at - static_cast<double>(below), 0.0, 1.0));
}

double CoaxialityDistribution::within(double coaxiality_mm) const {
  if (sorted_mm_.empty()) return std::nan("");
  const auto past = std::ranges::upper_bound(sorted_mm_, coaxiality_mm);
  return static_cast<double>(past - sorted_mm_.begin()) / static_cast<double>(draws);
}

}  // namespace trueaxis

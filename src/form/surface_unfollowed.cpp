// SPDX-License-Identifier: Apache-2.0
#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "form/surface_model.hpp"
#include "math/linear_algebra.hpp"

namespace trueaxis::form {

/// Radius and centre of the residuals about each station, over a revolution or a quarter of a
/// degree. Only if all of them together are more than noise leaves: every value is then off by a
/// share of that course with u = 1, as by an amplitude that was subtracted. Eq. 291.
void SurfaceModel::find_unfollowed() {
  constexpr Eigen::Index unknowns = 3;
  constexpr double beyond_noise = 3.0;  // standard deviations of χ²: 0.3 % of surfaces without
  const std::vector<double> left = left_mm();
  find_unfollowed_tops(left);
  const double reach = std::max(0.25 / terms_.degrees, 1.0 / turns_);
  double chi_squared = 0.0, freedom = 0.0;
  for (Station& station : stations_) {
    const double t = (station.z_mm - middle_mm_) / half_mm_;
    Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
    Eigen::Vector3d right = Eigen::Vector3d::Zero();
    for (std::size_t i = 0; i < t_.size(); ++i) {
      if (std::abs(t_[i] - t) > reach) continue;
      const Eigen::Vector3d row(1.0, std::cos(angle_rad_[i]), std::sin(angle_rad_[i]));
      normal += row * row.transpose();
      right += row * left[i];
    }
    const linear::Cholesky solver(normal);
    if (!(normal(0, 0) > 2.0 * unknowns) ||
        !(solver.positive_definite() && solver.reciprocal_condition() > 1e-3))
      continue;
    station.unfollowed_mm = solver.solve(Eigen::VectorXd(right));
    chi_squared += station.unfollowed_mm.dot(right);
    freedom += static_cast<double>(unknowns);
  }
  const double noise_mm2 = noise_mm_ * noise_mm_;
  if (chi_squared > noise_mm2 * (freedom + beyond_noise * std::sqrt(2.0 * freedom))) return;
  for (Station& station : stations_) station.unfollowed_mm.setZero();
}

/// A top that is more pointed or flatter than the form fitted: half as wide and long, where the
/// readings have it with two standard deviations. Every value is off by a share of it with u = 1.
void SurfaceModel::find_unfollowed_tops(const std::vector<double>& left_mm) {
  constexpr double narrower = 0.5, beyond_noise = 2.0;
  for (const LocalForm& form : posterior_.local) {
    const LocalForm top{form.angle_rad, narrower * form.width_rad, form.t, narrower * form.length};
    double square = 0.0, product = 0.0;
    for (std::size_t i = 0; i < t_.size(); ++i) {
      const double g = top.at(angle_rad_[i], t_[i])[0];
      square += g * g, product += g * left_mm[i];
    }
    if (product * product > beyond_noise * beyond_noise * noise_mm_ * noise_mm_ * square)
      unfollowed_tops_.push_back({top, product / square});
  }
}

}  // namespace trueaxis::form

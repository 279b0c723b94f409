// SPDX-License-Identifier: Apache-2.0
#include "spindle/seen_angles.hpp"

#include <algorithm>
#include <cmath>

#include "math/linear_algebra.hpp"

namespace trueaxis {
namespace {

using Eigen::Index;

/// Readings that say as much as these, which follow one another as AR(1) noise does.
double independent(const Eigen::VectorXd& noise) {
  const Index n = noise.size();
  const double square = noise.squaredNorm();
  const double next = noise.head(n - 1).dot(noise.tail(n - 1));
  const double phi = square > 0.0 ? std::clamp(next / square, 0.0, 0.999) : 0.0;
  return static_cast<double>(n) * (1.0 - phi) / (1.0 + phi);
}

/// The noise of each sensor over that of another: of readings against the mean of both neighbours.
Eigen::VectorXd noise_levels(const Eigen::MatrixXd& read_mm) {
  const Index inner = read_mm.rows() - 2;
  const Eigen::MatrixXd off =
      read_mm.middleRows(1, inner) - 0.5 * (read_mm.topRows(inner) + read_mm.bottomRows(inner));
  return off.colwise().squaredNorm().transpose() / static_cast<double>(inner);
}

/// The angles less those that are assumed, by the first order of both, and u.
struct Correction {
  Eigen::VectorXd by_rad, u_rad;
};
Correction correction_of(const Eigen::VectorXd& angles_rad, const Eigen::MatrixXd& read_mm,
                         double free_share) {
  const Eigen::VectorXd levels = noise_levels(read_mm);
  const Index sensors = angles_rad.size(), unknown = sensors - 1, spare = sensors - 2;
  Eigen::MatrixXd along(sensors, 2), across(sensors, 2);
  along << angles_rad.array().cos(), angles_rad.array().sin();
  across << -along.col(1), along.col(0);
  const Eigen::MatrixXd seen = linear::orthonormal_basis(along);
  const Eigen::MatrixXd identity = Eigen::MatrixXd::Identity(sensors, sensors);
  const Eigen::MatrixXd none =
      linear::spectrum(linear::beside(seen, identity)).vectors.rightCols(spare);
  const Eigen::MatrixXd weights = linear::least_squares(Eigen::MatrixXd(along.transpose() * along),
                                                        Eigen::MatrixXd(along.transpose()));
  const Eigen::MatrixXd motion_mm = read_mm * weights.transpose();
  const auto count = static_cast<double>(read_mm.rows());
  const Eigen::Matrix2d square = motion_mm.transpose() * motion_mm / count;
  const Eigen::Matrix2d of_noise = weights * levels.asDiagonal() * weights.transpose();
  Eigen::MatrixXd design(2 * spare, unknown);
  Eigen::VectorXd shares(2 * spare), u(2 * spare);
  for (Index j = 0; j < spare; ++j) {
    const Eigen::VectorXd closed_mm = read_mm * none.col(j);
    const Eigen::Vector2d together = motion_mm.transpose() * closed_mm / count;
    const Eigen::VectorXd noise_mm = closed_mm - motion_mm * square.inverse() * together;
    // The motion without the noise of its readings.
    const double level =
        noise_mm.squaredNorm() / count / none.col(j).cwiseAbs2().dot(levels);  // mm² of a level
    const Eigen::Matrix2d moved = square - level * of_noise;
    if (!(moved(0, 0) > 0.0 && moved.determinant() > 0.0)) return {};  // positive definite
    const Eigen::Matrix2d inverse = moved.inverse();
    const Eigen::Vector2d share = inverse * together;
    const Eigen::Matrix2d by_noise = inverse * square * inverse * noise_mm.squaredNorm() / count /
                                     (free_share * independent(noise_mm));
    // Sensors of unequal noise have a part of it in both, closure and motion.
    const Eigen::Vector2d common = level * inverse * weights * levels.asDiagonal() * none.col(j);
    for (Index k = 0; k < 2; ++k) {
      shares[2 * j + k] = share[k];
      u[2 * j + k] = std::hypot(std::sqrt(by_noise(k, k)), common[k]);
      for (Index s = 0; s < unknown; ++s) design(2 * j + k, s) = none(s + 1, j) * across(s + 1, k);
    }
  }
  const Eigen::MatrixXd gain = linear::pseudo_inverse(design);
  return {gain * shares, (gain.cwiseAbs2() * u.cwiseAbs2()).cwiseSqrt()};
}

}  // namespace

std::vector<SeenAngle> seen_angles(std::span<const double> stated_rad,
                                   const Eigen::MatrixXd& asynchronous_mm, double free_share,
                                   double u_largest_rad) {
  constexpr int most_rounds = 30;
  constexpr double settled = 1e-4;
  const auto sensors = static_cast<Index>(stated_rad.size());
  if (sensors < 3 || asynchronous_mm.rows() < 10) return {};
  Eigen::VectorXd angles = Eigen::Map<const Eigen::VectorXd>(stated_rad.data(), sensors);
  Correction by;
  for (int round = 0; round < most_rounds; ++round) {
    by = correction_of(angles, asynchronous_mm, free_share);
    if (by.by_rad.size() == 0 || !by.by_rad.allFinite() || !by.u_rad.allFinite()) return {};
    constexpr double longest = 0.3;  // of a step, rad: the first order holds so far
    const double scale = std::min(1.0, longest / std::max(1e-12, by.by_rad.cwiseAbs().maxCoeff()));
    angles.tail(sensors - 1) += scale * by.by_rad;
    if (by.by_rad.cwiseAbs().maxCoeff() < settled) break;
  }
  if (!(by.u_rad.maxCoeff() <= u_largest_rad && by.by_rad.cwiseAbs().maxCoeff() < settled))
    return {};
  std::vector<SeenAngle> out(1);
  for (Index s = 1; s < sensors; ++s) out.push_back({angles[s] - angles[0], by.u_rad[s - 1]});
  return out;
}

}  // namespace trueaxis

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <random>
#include <span>
#include <vector>

#include "diagnose/regression/normal_equations.hpp"
#include "support/dense.hpp"
#include "trueaxis/units.hpp"

/// Streams, scenes and explicit matrices for tests of the diagnosis' parts. The matrices are of one
/// row a reading, so that QR on them shares nothing with Gram matrices.
namespace trueaxis::testing {

/// Out along Z, and back at another speed when `passes` is 2; instants are exact.
struct HelixPlan {
  std::size_t readings = 1500;  ///< of a pass
  double per_turn = 23.7, length_mm = 60.0, rpm = 60.0, back_rpm = 151.0;
  int passes = 1;
};

inline ProbeStream arguments(const HelixPlan& plan) {
  ProbeStream stream;
  double t = 0.0, c = 0.0;
  for (int pass = 1; pass <= plan.passes; ++pass) {
    const double rpm = pass == 1 ? plan.rpm : plan.back_rpm;
    for (std::size_t i = 0; i < plan.readings; ++i) {
      const double share = static_cast<double>(i) / static_cast<double>(plan.readings - 1);
      stream.c_rad.push_back(c);
      stream.position_mm.push_back(plan.length_mm * (pass == 1 ? share : 1.0 - share));
      stream.time_s.push_back(t);
      stream.pass.push_back(pass);
      stream.reading_mm.push_back(0.0);
      c += two_pi / plan.per_turn;
      t += 60.0 / (std::abs(rpm) * plan.per_turn);
    }
    t += 2.3, c += 1.234;
  }
  return stream;
}

/// 0.2 mm off, tilted by 1 mrad, radius 40 mm at Z = 0.
inline diagnose_detail::Clamping bench_clamping(double tangent) {
  diagnose_detail::Clamping clamping;
  clamping.shape = {{0.2, -0.1, 1e-3, -5e-4, 0.0}, 40.0, tangent};
  return clamping;
}

inline diagnose_detail::BaseKind bench_base(double tangent) {
  diagnose_detail::BaseKind base;
  base.tapers = tangent != 0.0;
  return base;
}

inline diagnose_detail::LinearisationPoint bench_point(const HelixPlan& plan, double tangent) {
  return linearise_at(arguments(plan), {bench_clamping(tangent)}, bench_base(tangent), false);
}

inline std::vector<double> white_noise(std::size_t count, double sigma_mm, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal(0.0, sigma_mm);
  std::vector<double> out(count);
  for (double& v : out) v = normal(random);
  return out;
}

/// AR(1) of standard deviation sigma, stationary from the first reading on.
inline std::vector<double> correlated_noise(std::size_t count, double sigma_mm, double rho,
                                            std::uint64_t seed) {
  std::vector<double> out = white_noise(count, sigma_mm, seed);
  for (std::size_t i = 1; i < count; ++i)
    out[i] = rho * out[i - 1] + std::sqrt(1.0 - rho * rho) * out[i];
  return out;
}

/// Base and hypotheses, a row a reading.
inline Eigen::MatrixXd explicit_columns(const diagnose_detail::LinearisationPoint& point,
                                        std::span<const diagnose_detail::Hypothesis> list) {
  const std::size_t base = point.base.columns();
  Eigen::MatrixXd out(static_cast<Eigen::Index>(point.size()),
                      static_cast<Eigen::Index>(base + diagnose_detail::columns_of(list)));
  diagnose_detail::PointRoom room;
  const auto fill_side = [&](const diagnose_detail::PointPart& side) {
    std::vector<double*> column;
    for (Eigen::Index j = 0; j < out.cols(); ++j)
      column.push_back(out.col(j).data() + static_cast<long>(side.begin));
    point.fill_base(side, {column.data(), base});
    std::size_t next = base;
    for (const diagnose_detail::Hypothesis& h : list) {
      fill(h, point, side, {column.data() + next, h.columns()});
      next += h.columns();
    }
  };
  for_each_side(point.all(room), fill_side);
  return out;
}

inline Eigen::VectorXd as_vector(std::span<const double> values) {
  return Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
}

/// Residual sum of squares of least squares by QR with pivoting.
inline double explicit_rss(const Eigen::MatrixXd& columns, const Eigen::VectorXd& y) {
  const Eigen::VectorXd solution = dense::least_squares(columns, y);
  return (y - columns * solution).squaredNorm();
}

/// Roundness of an order, constant along Z: cos and sin.
inline diagnose_detail::Hypothesis roundness(double order) {
  return diagnose_detail::of_effect("part.roundness", {.order = order}, {0, 1});
}

}  // namespace trueaxis::testing

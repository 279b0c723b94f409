// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ceres/ceres.h>

#include <array>
#include <cmath>
#include <cstddef>

#include "bench/cone_peer.hpp"
#include "trueaxis/probe_stream.hpp"

/// One residual per reading, as a Ceres tutorial does it: Eq. 12 of Constantin et al. by AutoDiff.
namespace trueaxis::peer {

/// One reading of a lateral stream with its sin and cos.
struct Reading {
  double cos_c, sin_c, z_mm, x_mm;
};

inline Reading reading_of(const ProbeStream& stream, std::size_t i) {
  return {std::cos(stream.c_rad[i]), std::sin(stream.c_rad[i]),
          stream.has_position() ? stream.position_mm[i] : 0.0, stream.reading_mm[i]};
}

/// p: x0, y0, l, m, k, half angle (mm, rad).
struct ConeResidual {
  static constexpr int parameters = 6;
  Reading at;
  template <typename T>
  bool operator()(const T* p, T* residual) const {
    residual[0] = cone_reading(p, at.cos_c, at.sin_c, at.z_mm) - at.x_mm;
    return true;
  }
};

/// p: x0, y0, l, m, radius (mm). |v|² − (v·d)² = r², v = X e + w from (x0, y0, 0).
struct CylinderResidual {
  static constexpr int parameters = 5;
  Reading at;
  template <typename T>
  bool operator()(const T* p, T* residual) const {
    using std::sqrt;
    const T n = sqrt(1.0 - p[2] * p[2] - p[3] * p[3]);
    const T ed = p[2] * at.cos_c + p[3] * at.sin_c;
    const T wd = -p[0] * p[2] - p[1] * p[3] + at.z_mm * n;
    const T a = 1.0 - ed * ed;
    const T b = -p[0] * at.cos_c - p[1] * at.sin_c - ed * wd;
    const T c = p[0] * p[0] + p[1] * p[1] + at.z_mm * at.z_mm - wd * wd - p[4] * p[4];
    residual[0] = (-b + sqrt(b * b - a * c)) / a - at.x_mm;
    return true;
  }
};

/// p: x0, y0, radius (mm): a circle off the spindle axis.
struct SectionResidual {
  static constexpr int parameters = 3;
  Reading at;
  template <typename T>
  bool operator()(const T* p, T* residual) const {
    using std::sqrt;
    const T across = p[1] * at.cos_c - p[0] * at.sin_c;
    residual[0] = p[0] * at.cos_c + p[1] * at.sin_c + sqrt(p[2] * p[2] - across * across) - at.x_mm;
    return true;
  }
};

/// Adds every reading of `stream` as a residual of its own; `loss` (or null) is not taken over.
template <typename Residual>
void add_readings(ceres::Problem& problem, const ProbeStream& stream, double* parameters,
                  ceres::LossFunction* loss = nullptr) {
  using Cost = ceres::AutoDiffCostFunction<Residual, 1, Residual::parameters>;
  for (std::size_t i = 0; i < stream.size(); ++i) {
    // The problem takes over the cost function, and that the functor.
    problem.AddResidualBlock(new Cost(new Residual{reading_of(stream, i)}), loss, parameters);
  }
}

}  // namespace trueaxis::peer

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>

/// The cone as a user of a general solver would write it: no code of the engine, the paper's
/// parameters p = x0, y0, l, m, k, half angle a (mm, rad).
namespace trueaxis::peer {

/// X of the probe line (C, Z) on the cone (v·d)² = cos²a |v|², v = X e + w from the apex,
/// e = (cos C, sin C, 0): the larger root of A X² + 2 B X + C = 0 (Constantin et al. Eqs. 7-11).
template <typename T>
T cone_reading(const T* p, double cos_c, double sin_c, double z_mm) {
  using std::cos;
  using std::sqrt;
  const T &l = p[2], &m = p[3], &k = p[4];
  const T n = sqrt(1.0 - l * l - m * m);
  const T cos_a = cos(p[5]);
  const T cos2 = cos_a * cos_a;
  const T wx = -p[0] - k * l, wy = -p[1] - k * m, wz = z_mm - k * n;
  const T ed = l * cos_c + m * sin_c;
  const T wd = wx * l + wy * m + wz * n;
  const T a = cos2 - ed * ed;
  const T b = cos2 * (wx * cos_c + wy * sin_c) - ed * wd;
  const T c = cos2 * (wx * wx + wy * wy + wz * wz) - wd * wd;
  return (-b + sqrt(b * b - a * c)) / a;
}

/// cone_reading and its derivatives dX/dp = −F_p / F_X of the implicit form
/// F(X, p) = cos²a |v|² − (v·d)²; what depends on p alone is computed once.
class ConeRow {
 public:
  explicit ConeRow(const double* p)
      : x0_(p[0]),
        y0_(p[1]),
        l_(p[2]),
        m_(p[3]),
        k_(p[4]),
        cos_a_(std::cos(p[5])),
        sin_a_(std::sin(p[5])),
        n_(std::sqrt(1.0 - l_ * l_ - m_ * m_)) {}

  double operator()(double cos_c, double sin_c, double z_mm) const {
    return solve(cos_c, sin_c, z_mm).x;
  }

  double operator()(double cos_c, double sin_c, double z_mm, std::array<double, 6>& dx_dp) const {
    const Root root = solve(cos_c, sin_c, z_mm);
    const double vx = root.x * cos_c + root.wx, vy = root.x * sin_c + root.wy;
    const double s = vx * l_ + vy * m_ + root.wz * n_;
    const double cos2 = cos_a_ * cos_a_;
    const double scale = -1.0 / root.half_slope;
    const double turn = -(k_ * cos2 + s);
    dx_dp[0] = scale * (s * l_ - cos2 * vx);
    dx_dp[1] = scale * (s * m_ - cos2 * vy);
    dx_dp[2] = scale * turn * (vx - root.wz * l_ / n_);
    dx_dp[3] = scale * turn * (vy - root.wz * m_ / n_);
    dx_dp[4] = scale * s * sin_a_ * sin_a_;
    dx_dp[5] = -scale * cos_a_ * sin_a_ * (vx * vx + vy * vy + root.wz * root.wz);
    return root.x;
  }

 private:
  struct Root {
    double x, half_slope;  ///< half_slope: F_X / 2 = √(B² − A C)
    double wx, wy, wz;
  };

  Root solve(double cos_c, double sin_c, double z_mm) const {
    const double cos2 = cos_a_ * cos_a_;
    const double wx = -x0_ - k_ * l_, wy = -y0_ - k_ * m_, wz = z_mm - k_ * n_;
    const double ed = l_ * cos_c + m_ * sin_c;
    const double wd = wx * l_ + wy * m_ + wz * n_;
    const double a = cos2 - ed * ed;
    const double b = cos2 * (wx * cos_c + wy * sin_c) - ed * wd;
    const double c = cos2 * (wx * wx + wy * wy + wz * wz) - wd * wd;
    const double half_slope = std::sqrt(b * b - a * c);
    return {(half_slope - b) / a, half_slope, wx, wy, wz};
  }

  double x0_, y0_, l_, m_, k_, cos_a_, sin_a_, n_;
};

}  // namespace trueaxis::peer

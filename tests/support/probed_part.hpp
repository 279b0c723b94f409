// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>

namespace trueaxis::testing {

/// The centre of a ball in the plane of X and Z, and how far the spindle has turned.
struct BallAt {
  double x = 0.0, z = 0.0, c_deg = 0.0;
};

/// How far a ball is from a part in the chuck, mm; negative: inside of it.
using PartGap = std::function<double(const BallAt&)>;

/// Where a ball that goes straight from one place to another first meets a part, found by steps of
/// 5 µm and by halving; where it goes if it does not. C is that of the end.
struct Met {
  BallAt at;
  bool part = false;
};
inline Met first_met(const PartGap& gap, const BallAt& from, const BallAt& to) {
  const auto at = [&](double share) {
    return BallAt{from.x + share * (to.x - from.x), from.z + share * (to.z - from.z), to.c_deg};
  };
  const int steps = 1 + static_cast<int>(std::hypot(to.x - from.x, to.z - from.z) / 0.005);
  for (int k = 0; k <= steps; ++k) {
    double high = static_cast<double>(k) / steps;
    if (gap(at(high)) > 0.0) continue;
    double low = k == 0 ? 0.0 : static_cast<double>(k - 1) / steps;
    for (int halving = 0; halving < 40; ++halving) {
      const double middle = 0.5 * (low + high);
      (gap(at(middle)) > 0.0 ? low : high) = middle;
    }
    return {at(low), true};  // still clear of it, by less than 1e-14 mm
  }
  return {to, false};
}

/// A point or a direction in the part.
struct InPart {
  double x = 0.0, y = 0.0, z = 0.0;
};
inline InPart in_part(const BallAt& ball) {
  const double c = ball.c_deg * std::acos(-1.0) / 180.0;
  return {ball.x * std::cos(c), ball.x * std::sin(c), ball.z};
}

/// A bore, straight or a taper, along a line that is not the spindle's, in a block that ends at Z =
/// 0, and the stylus that goes into it: the ball, the shank and the body from where the shank ends.
/// The block is a disc of 40 mm; the mouth of the bore may be narrower than its inside.
struct BlockWithBore {
  double radius_mm = 30.0, bottom_mm = -60.0, mouth_mm = 1e9;
  double taper = 0.0;  ///< of the radius along the axis
  double x0_mm = 0.12, y0_mm = -0.07, slope_x = 0.002, slope_y = -0.001;
  double ball_mm = 1.0, shank_mm = 0.6, length_mm = 50.0;

  double from_axis(const BallAt& ball) const {
    const InPart p = in_part(ball);
    const double n = std::sqrt(1.0 + slope_x * slope_x + slope_y * slope_y);
    const double x = p.x - x0_mm, y = p.y - y0_mm;
    // |d × (p − p0)| with the direction d = (slope_x, slope_y, 1) / n.
    return std::hypot(slope_y * p.z - y, x - slope_x * p.z, slope_x * y - slope_y * x) / n;
  }
  double operator()(const BallAt& ball) const {
    if (ball.z >= ball_mm) return ball.z - ball_mm;
    if (std::abs(ball.x) >= 40.0) return std::abs(ball.x) - 40.0 - ball_mm;
    const InPart p = in_part(ball);
    const double along = (slope_x * (p.x - x0_mm) + slope_y * (p.y - y0_mm) + p.z) /
                         std::sqrt(1.0 + slope_x * slope_x + slope_y * slope_y);
    const double wall =
        (radius_mm + taper * along - from_axis(ball)) / std::sqrt(1.0 + taper * taper) - ball_mm;
    const double mouth = mouth_mm - shank_mm - from_axis({ball.x, 0.0, ball.c_deg});
    return std::min({wall, mouth, ball.z - ball_mm - bottom_mm, ball.z + length_mm});
  }
};

/// A face that is not square to the spindle, at the end of a disc of 40 mm.
struct TiltedFace {
  double level_mm = 0.0, slope_x = 0.0015, slope_y = -0.0007;  ///< of its height over x and y
  double ball_mm = 1.0;

  double operator()(const BallAt& ball) const {
    const InPart p = in_part(ball);
    const double n = std::sqrt(1.0 + slope_x * slope_x + slope_y * slope_y);
    if (std::abs(ball.x) >= 40.0 + ball_mm) return std::abs(ball.x) - 40.0;
    return (p.z - level_mm - slope_x * p.x - slope_y * p.y) / n - ball_mm;
  }
};

}  // namespace trueaxis::testing

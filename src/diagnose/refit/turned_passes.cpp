// SPDX-License-Identifier: Apache-2.0
#include <Eigen/Dense>
#include <algorithm>
#include <boost/math/tools/minima.hpp>
#include <cmath>
#include <numbers>

#include "diagnose/refit/delay_instead.hpp"
#include "math/linear_algebra.hpp"
#include "math/statistics.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis::diagnose_detail {
namespace {

constexpr double one_speed = 0.01;  // of a speed: what is less is one
constexpr double longest_s =
    2.0;                          // of a delay: two cycles of a recorder that is read once a second
constexpr double as_good = 11.0;  // χ² of one parameter: 1 of 1000
constexpr std::size_t at_change = 2;  // readings on each side that may belong to the other speed

/// [1, z, cos C, sin C, z cos C, z sin C | reading]
using Sums = Eigen::Matrix<double, 7, 7>;

/// The columns at C − angle and z − shift, made of those at C and z, but for a constant.
Sums turning(double angle, double shift) {
  const double c = std::cos(angle), s = std::sin(angle);
  Sums out = Sums::Identity();
  out.block<2, 2>(2, 2) << c, -s, s, c;
  out.block<2, 2>(4, 4) = out.block<2, 2>(2, 2);
  out.block<2, 2>(2, 4) = -shift * out.block<2, 2>(2, 2);
  return out;
}

/// What the six columns leave of the readings.
double squares_left(const Sums& sums) {
  constexpr double none = 1e-12;  // a section has no z
  Eigen::Matrix<double, 6, 6> gram = sums.topLeftCorner<6, 6>();
  gram.diagonal() *= 1.0 + none;
  gram.diagonal().array() += none * sums(0, 0);
  const Eigen::Matrix<double, 6, 1> right = sums.topRightCorner<6, 1>();
  return std::max(sums(6, 6) - linear::weighed_square(right, gram), 0.0);
}

}  // namespace

TurnedPasses::TurnedPasses(const ProbeStream& stream, const LinearisationPoint& point,
                           double onset_s)
    : stream_(stream), point_(point) {
  const auto add = [&](const Pass& pass, std::size_t begin, std::size_t end, double speed) {
    if (begin < end)
      parts_.push_back({begin, end, speed, pass.feed_mm_per_rev * std::abs(speed) / two_pi});
  };
  for (const Pass& pass : point.passes) {
    if (point.has_time) {
      add(pass, pass.begin, pass.end, pass.speed_rad_per_s);
      continue;
    }
    std::size_t change = pass.begin;
    while (change < pass.end && point.time[change] < onset_s) ++change;
    add(pass, pass.begin, change, 0.0);
    add(pass, change, pass.end, pass.c_sign);
  }
}

double TurnedPasses::turned_apart(double delay_s) const {
  const auto [low, high] = std::ranges::minmax(parts_, {}, &Part::speed_rad_per_s);
  return std::abs(delay_s) * (high.speed_rad_per_s - low.speed_rad_per_s);
}

bool TurnedPasses::at_one_speed() const {
  const auto [low, high] = std::ranges::minmax(parts_, {}, &Part::speed_rad_per_s);
  const double slow = low.speed_rad_per_s, fast = high.speed_rad_per_s;
  return turned_apart(1.0) <= one_speed * std::max(std::abs(slow), std::abs(fast));
}

ProbeStream TurnedPasses::without(double delay_s) const {
  ProbeStream out = stream_;
  for (const Part& part : parts_)
    for (std::size_t i = part.begin; i < part.end; ++i) {
      out.c_rad[i] -= delay_s * part.speed_rad_per_s;
      if (out.has_position()) out.position_mm[i] -= delay_s * part.velocity_mm_per_s;
    }
  return out;
}

ObservationMask TurnedPasses::counted(const ObservationMask& mask, double delay_s) const {
  ObservationMask out = mask;
  for (const Part& part : parts_) {
    if (part.begin == 0) continue;
    const double turned = std::abs(delay_s * part.speed_rad_per_s);
    const std::size_t most = part.begin + (part.end - part.begin) / 2;
    for (std::size_t i = part.begin; i < most; ++i)
      if (std::abs(stream_.c_rad[i] - stream_.c_rad[part.begin]) <= turned) out.mask(i);
    const std::size_t first = part.begin - std::min(part.begin, at_change);
    const std::size_t last = std::min(part.begin + at_change, out.used.size());
    for (std::size_t i = first; i < last; ++i) out.mask(i);
  }
  out.find_runs(point_);
  return out;
}

double TurnedPasses::best(const ObservationMask& mask) const {
  const ObservationMask apart = counted(mask, 0.0);
  std::vector<Sums> sums;
  double count = 0.0;
  const double origin_mm = stream_.reading_mm.front();
  for (const Part& part : parts_) {
    Sums& own = sums.emplace_back(Sums::Zero());
    for (std::size_t i = part.begin; i < part.end; ++i) {
      if (!apart.used[i]) continue;
      const double c = std::cos(stream_.c_rad[i]), s = std::sin(stream_.c_rad[i]);
      const double z = (point_.z[i] - point_.z_mid_mm) / point_.z_half_mm;
      Eigen::Matrix<double, 7, 1> row;
      row << 1.0, z, c, s, z * c, z * s, stream_.reading_mm[i] - origin_mm;
      own += row * row.transpose();
      count += 1.0;
    }
    // Each has a zero of its own: a play of the slide between them does not count as a delay.
    if (const double n = own(0, 0); n > 0.0) own -= Sums(own.col(0) * own.row(0) / n);
    own(0, 0) = 1.0;
  }
  const auto left = [&](double delay_s) {
    Sums all = Sums::Zero();
    for (std::size_t p = 0; p < parts_.size(); ++p) {
      const Sums turned = turning(delay_s * parts_[p].speed_rad_per_s,
                                  delay_s * parts_[p].velocity_mm_per_s / point_.z_half_mm);
      all += turned.transpose() * sums[p] * turned;
    }
    return squares_left(all);
  };
  constexpr int per_half_round = 16;  // of a cosine that goes round once
  constexpr int bits = 30;
  const double half_round_s = std::numbers::pi / turned_apart(1.0);
  const double step = half_round_s / per_half_round;
  const double longest = point_.has_time ? std::max(longest_s, half_round_s) : half_round_s;
  const auto steps = static_cast<int>(std::ceil(longest / step));
  struct Low {
    double delay_s, squares;
  };
  std::vector<Low> lows;
  for (int i = -steps; i <= steps; ++i) {
    const double at = i * step, here = left(at);
    if (here > left(at - step) || here > left(at + step)) continue;
    const auto [delay_s, squares] =
        boost::math::tools::brent_find_minima(left, at - step, at + step, bits);
    lows.push_back({delay_s, squares});
  }
  if (lows.empty()) return 0.0;
  const double least = std::ranges::min(lows, {}, &Low::squares).squares;
  std::erase_if(lows, [&](const Low& one) {
    return one.squares > least * (1.0 + as_good / std::max(count, 1.0));
  });
  return std::ranges::min(lows, {}, [](const Low& one) { return std::abs(one.delay_s); }).delay_s;
}

}  // namespace trueaxis::diagnose_detail

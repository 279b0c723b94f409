// SPDX-License-Identifier: Apache-2.0
#include "measure/seat_profile.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "base/angle.hpp"
#include "base/stop.hpp"
#include "math/linear_algebra.hpp"
#include "math/statistics.hpp"
#include "measure/passes.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

constexpr double tukey = 4.685;
constexpr double least_scatter_mm = 1e-4;
constexpr double widest_gap_rad = 2.2;     // of C within a turn that has a radius
constexpr std::size_t most_turns = 400;    // of a profile: several of the stream make one beyond it
constexpr double least_per_section = 8.0;  // readings at one Z that are a section
constexpr double one_z_mm = 0.01;          // a slide at rest stays within it
constexpr std::size_t enough_turns = 8;    // for a noise by their differences

/// The readings in order of Z.
std::vector<std::size_t> along_z(const ProbeStream& stream) {
  std::vector<std::size_t> order(stream.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return stream.position_mm[i]; });
  return order;
}

/// Readings next to each other along Z, over a stretch of Z.
struct Turn {
  double width_mm = 0.0;
  std::vector<std::size_t> readings;
};

/// Readings at one Z each; empty: there are no sections.
std::vector<Turn> sections_of(const ProbeStream& stream, const std::vector<std::size_t>& order) {
  std::vector<Turn> groups;
  for (const std::size_t i : order) {
    if (groups.empty() ||
        stream.position_mm[i] - stream.position_mm[groups.back().readings.front()] > one_z_mm)
      groups.emplace_back();
    groups.back().readings.push_back(i);
  }
  const double each = static_cast<double>(order.size()) / static_cast<double>(groups.size());
  if (each < least_per_section) groups.clear();
  // A fine feed has groups too, each next to the other.
  for (std::size_t g = 1; g < groups.size(); ++g)
    if (stream.position_mm[groups[g].readings.front()] -
            stream.position_mm[groups[g - 1].readings.back()] <
        one_z_mm) {
      return {};
    }
  return groups;
}

/// Feed per revolution at each reading of a whole revolution: the median of it, the one before and
/// the next of the pass, so that a move between two seats does not count. Elsewhere not finite.
std::vector<double> feeds_of(const ProbeStream& stream) {
  std::vector<double> feed_mm(stream.size(), std::numeric_limits<double>::infinity());
  for (const Pass& pass : find_passes(stream)) {
    if (pass.c_sign == 0 || pass.feed_sign == 0) continue;
    std::vector<std::size_t> begins{pass.begin};
    for (std::size_t i = pass.begin; i < pass.end; ++i)
      if (std::abs(stream.c_rad[i] - stream.c_rad[begins.back()]) >= two_pi) begins.push_back(i);
    std::vector<double> feeds;
    for (std::size_t k = 1; k < begins.size(); ++k)
      feeds.push_back(std::abs(stream.position_mm[begins[k]] - stream.position_mm[begins[k - 1]]) *
                      two_pi / std::abs(stream.c_rad[begins[k]] - stream.c_rad[begins[k - 1]]));
    for (std::size_t k = 0; k < feeds.size(); ++k) {
      const auto from = feeds.begin() + static_cast<std::ptrdiff_t>(k > 0 ? k - 1 : 0);
      const auto to = feeds.begin() + static_cast<std::ptrdiff_t>(std::min(k + 2, feeds.size()));
      const double here = median(std::vector<double>(from, to));
      const std::size_t end = k + 1 < feeds.size() ? begins[k + 1] : pass.end;
      for (std::size_t i = begins[k]; here > 0.0 && i < end; ++i) feed_mm[i] = here;
    }
  }
  return feed_mm;
}

/// Each as long as the finest feed of its readings, so many times over.
std::vector<Turn> turns_of(const ProbeStream& stream, const std::vector<std::size_t>& order,
                           const std::vector<double>& feed_mm, double times) {
  std::vector<Turn> turns;
  double from_mm = 0.0;
  for (const std::size_t i : order) {
    const double z_mm = stream.position_mm[i], width_mm = times * feed_mm[i];
    if (turns.empty() || z_mm - from_mm >= std::min(turns.back().width_mm, width_mm)) {
      turns.push_back({width_mm, {}});
      from_mm = z_mm;
    }
    turns.back().width_mm = std::min(turns.back().width_mm, width_mm);
    turns.back().readings.push_back(i);
  }
  return turns;
}

/// The turns of each feed, or of a fiftieth of the length if the spindle is at rest while the slide
/// feeds.
std::vector<Turn> turns_of(const ProbeStream& stream, const std::vector<std::size_t>& order) {
  std::vector<double> feed_mm = feeds_of(stream), known;
  for (const double one : feed_mm)
    if (std::isfinite(one)) known.push_back(one);
  const double length_mm = stream.position_mm[order.back()] - stream.position_mm[order.front()];
  const double otherwise_mm = known.empty() ? length_mm / 50.0 : median(std::move(known));
  for (double& one : feed_mm)
    if (!std::isfinite(one)) one = otherwise_mm;
  std::vector<Turn> turns = turns_of(stream, order, feed_mm, 1.0);
  if (turns.size() <= most_turns) return turns;
  const auto times = std::ceil(static_cast<double>(turns.size()) / most_turns);
  return turns_of(stream, order, feed_mm, times);
}

bool covers_the_turn(const ProbeStream& stream, const std::vector<std::size_t>& readings) {
  if (readings.size() < 3) return false;
  std::vector<double> c;
  for (const std::size_t i : readings) c.push_back(within_turn(stream.c_rad[i]));
  std::ranges::sort(c);
  double widest = c.front() + two_pi - c.back();
  for (std::size_t i = 1; i < c.size(); ++i) widest = std::max(widest, c[i] - c[i - 1]);
  return widest < widest_gap_rad;
}

/// By the second differences of neighbours, which a straight seat leaves at the noise; at least
/// that of a turn by itself.
double noise_of(const SeatProfile& profile) {
  const auto& t = profile.turns;
  std::vector<double> within, second;
  for (const TurnRadius& one : t) within.push_back(one.u_mm);
  for (std::size_t i = 1; i + 1 < t.size(); ++i) {
    const double before = t[i].z_mm - t[i - 1].z_mm, after = t[i + 1].z_mm - t[i].z_mm;
    const double share = before / (before + after);
    const double off =
        t[i].radius_mm - (1.0 - share) * t[i - 1].radius_mm - share * t[i + 1].radius_mm;
    const double variances = 1.0 + share * share + (1.0 - share) * (1.0 - share);
    second.push_back(off / std::sqrt(variances));
  }
  const double own_mm =
      within.empty() ? least_scatter_mm : std::max(least_scatter_mm, median(std::move(within)));
  if (second.size() < enough_turns) return own_mm;
  if (profile.sections) {
    // The ends of seats may be in more than half of the few differences, not in three quarters.
    constexpr double quartile = 0.3186;  // of |normal|
    for (double& one : second) one = std::abs(one);
    const auto at = second.begin() + static_cast<std::ptrdiff_t>(second.size() / 4);
    std::ranges::nth_element(second, at);
    return std::max(own_mm, *at / quartile);
  }
  return std::max(own_mm, mad_sigma(second));
}

}  // namespace

double RobustCircle::at(double c_rad) const {
  return radius_mm + cos_mm * std::cos(c_rad) + sin_mm * std::sin(c_rad);
}

RobustCircle robust_circle(const ProbeStream& stream, const std::vector<std::size_t>& readings) {
  stop_if_asked();
  const auto n = static_cast<Eigen::Index>(readings.size());
  Eigen::MatrixX3d basis(n, 3);
  Eigen::VectorXd reading(n), weight = Eigen::VectorXd::Ones(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const std::size_t at = readings[static_cast<std::size_t>(i)];
    basis.row(i) << 1.0, std::cos(stream.c_rad[at]), std::sin(stream.c_rad[at]);
    reading[i] = stream.reading_mm[at];
  }
  RobustCircle out;
  constexpr int rounds = 12, rounds_of_huber = 6;
  for (int round = 0; round < rounds; ++round) {
    const Eigen::MatrixX3d weighted = weight.asDiagonal() * basis;
    const Eigen::Matrix3d normal = weighted.transpose().lazyProduct(basis);
    const Eigen::Vector3d right = weighted.transpose().lazyProduct(reading);
    const Eigen::Vector3d found = linear::solve_normal(normal, right);
    out.radius_mm = found[0], out.cos_mm = found[1], out.sin_mm = found[2];
    const Eigen::VectorXd off = reading - basis * found;
    out.scatter_mm =
        std::max(least_scatter_mm, mad_sigma({off.data(), static_cast<std::size_t>(n)}));
    for (Eigen::Index i = 0; i < n; ++i) {
      const double r = std::abs(off[i]) / out.scatter_mm;
      const double inside = std::max(0.0, 1.0 - r * r / (tukey * tukey));
      weight[i] = round < rounds_of_huber ? 1.0 / std::max(1.0, r) : inside * inside;
    }
  }
  return out;
}

namespace {

/// The taper of each turn: on a steep one the radius runs within a turn. From the
/// neighbour to which it changes less, as the other may be beyond a shoulder.
std::vector<double> tapers_of(const std::vector<TurnRadius>& turns) {
  std::vector<double> out(turns.size(), 0.0);
  const auto between = [&](std::size_t i, std::size_t j) {
    return (turns[j].radius_mm - turns[i].radius_mm) / (turns[j].z_mm - turns[i].z_mm);
  };
  for (std::size_t i = 1; i + 1 < turns.size(); ++i) {
    const double before = between(i - 1, i), after = between(i, i + 1);
    if (before * after > 0.0) out[i] = std::abs(before) < std::abs(after) ? before : after;
  }
  if (turns.size() > 2) out.front() = out[1], out.back() = out[turns.size() - 2];
  return out;
}

void take_circle(const ProbeStream& stream, TurnRadius& turn, double taper, ProbeStream& level) {
  for (const std::size_t i : turn.readings)
    level.reading_mm[i] = stream.reading_mm[i] - taper * (stream.position_mm[i] - turn.z_mm);
  const RobustCircle circle = robust_circle(level, turn.readings);
  turn.radius_mm = circle.radius_mm;
  turn.u_mm = circle.scatter_mm / std::sqrt(static_cast<double>(turn.readings.size()));
}

}  // namespace

SeatProfile seat_profile(const ProbeStream& stream) {
  SeatProfile profile;
  ProbeStream level = stream;
  const std::vector<std::size_t> order = along_z(stream);
  std::vector<Turn> groups = sections_of(stream, order);
  profile.sections = !groups.empty();
  if (!profile.sections) groups = turns_of(stream, order);
  for (auto& [width_mm, group] : groups) {
    if (!covers_the_turn(stream, group)) continue;
    TurnRadius turn;
    for (const std::size_t i : group) turn.z_mm += stream.position_mm[i];
    turn.z_mm /= static_cast<double>(group.size());
    turn.spacing_mm = width_mm;
    turn.readings = std::move(group);
    take_circle(stream, turn, 0.0, level);
    profile.turns.push_back(std::move(turn));
  }
  constexpr int times_level = 2;  // the first taper is from circles that run
  for (int again = 0; again < times_level && !profile.sections; ++again) {
    const std::vector<double> tapers = tapers_of(profile.turns);
    for (std::size_t i = 0; i < tapers.size(); ++i)
      if (TurnRadius& turn = profile.turns[i]; std::abs(tapers[i]) * turn.spacing_mm > turn.u_mm)
        take_circle(stream, turn, tapers[i], level);
  }
  if (profile.sections && profile.turns.size() > 1) {
    std::vector<double> apart;
    for (std::size_t i = 1; i < profile.turns.size(); ++i)
      apart.push_back(profile.turns[i].z_mm - profile.turns[i - 1].z_mm);
    const double spacing_mm = median(std::move(apart));
    for (TurnRadius& turn : profile.turns) turn.spacing_mm = spacing_mm;
  }
  profile.noise_mm = noise_of(profile);
  return profile;
}

}  // namespace trueaxis

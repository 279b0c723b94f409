// SPDX-License-Identifier: Apache-2.0
#include "measure/seat_profile.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
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

/// Readings at one Z each; empty: there are no sections.
std::vector<std::vector<std::size_t>> sections_of(const ProbeStream& stream,
                                                  const std::vector<std::size_t>& order) {
  std::vector<std::vector<std::size_t>> groups;
  for (const std::size_t i : order) {
    if (groups.empty() ||
        stream.position_mm[i] - stream.position_mm[groups.back().front()] > one_z_mm)
      groups.emplace_back();
    groups.back().push_back(i);
  }
  const double each = static_cast<double>(order.size()) / static_cast<double>(groups.size());
  if (each < least_per_section) groups.clear();
  // A fine feed has groups too, each next to the other.
  for (std::size_t g = 1; g < groups.size(); ++g)
    if (stream.position_mm[groups[g].front()] - stream.position_mm[groups[g - 1].back()] <
        one_z_mm) {
      return {};
    }
  return groups;
}

/// Feed per revolution of the passes, the median by readings; 0: none turns and feeds.
double feed_mm(const ProbeStream& stream) {
  std::vector<double> feeds;
  for (const Pass& pass : find_passes(stream)) {
    const double feed = std::abs(pass.feed_mm_per_rev);
    if (feed > 0.0) feeds.insert(feeds.end(), (pass.end - pass.begin + 15) / 16, feed);
  }
  return feeds.empty() ? 0.0 : median(std::move(feeds));
}

/// Readings of one feed of Z each, or of a fiftieth of the length if the spindle is at rest while
/// the slide feeds.
std::vector<std::vector<std::size_t>> turns_of(const ProbeStream& stream,
                                               const std::vector<std::size_t>& order,
                                               double& width_mm) {
  const double first_mm = stream.position_mm[order.front()];
  const double length_mm = stream.position_mm[order.back()] - first_mm;
  width_mm = feed_mm(stream);
  if (!(width_mm > 0.0)) width_mm = length_mm / 50.0;
  width_mm *= std::max(1.0, std::ceil(length_mm / width_mm / static_cast<double>(most_turns)));
  std::vector<std::vector<std::size_t>> turns(
      static_cast<std::size_t>(std::floor(length_mm / width_mm)) + 1);
  for (const std::size_t i : order)
    turns[static_cast<std::size_t>((stream.position_mm[i] - first_mm) / width_mm)].push_back(i);
  return turns;
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
    const Eigen::Matrix3d normal = basis.transpose() * weight.asDiagonal() * basis;
    const Eigen::Vector3d found = linear::solve_normal(
        normal, Eigen::Vector3d(basis.transpose() * weight.cwiseProduct(reading)));
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

SeatProfile seat_profile(const ProbeStream& stream) {
  SeatProfile profile;
  const std::vector<std::size_t> order = along_z(stream);
  std::vector<std::vector<std::size_t>> groups = sections_of(stream, order);
  profile.sections = !groups.empty();
  if (!profile.sections) groups = turns_of(stream, order, profile.spacing_mm);
  for (std::vector<std::size_t>& group : groups) {
    if (!covers_the_turn(stream, group)) continue;
    const RobustCircle circle = robust_circle(stream, group);
    TurnRadius turn;
    for (const std::size_t i : group) turn.z_mm += stream.position_mm[i];
    turn.z_mm /= static_cast<double>(group.size());
    turn.radius_mm = circle.radius_mm;
    turn.u_mm = circle.scatter_mm / std::sqrt(static_cast<double>(group.size()));
    turn.readings = std::move(group);
    profile.turns.push_back(std::move(turn));
  }
  if (profile.sections && profile.turns.size() > 1) {
    std::vector<double> apart;
    for (std::size_t i = 1; i < profile.turns.size(); ++i)
      apart.push_back(profile.turns[i].z_mm - profile.turns[i - 1].z_mm);
    profile.spacing_mm = median(std::move(apart));
  }
  profile.noise_mm = noise_of(profile);
  return profile;
}

}  // namespace trueaxis

// SPDX-License-Identifier: Apache-2.0
// A step of the centres that a delay of X explains.
#include <Eigen/Dense>
#include <algorithm>
#include <boost/math/tools/minima.hpp>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "math/statistics.hpp"
#include "measure/centre_step.hpp"
#include "measure/step_model.hpp"

namespace trueaxis {
namespace {

using namespace step_model;

constexpr double steady = 0.02;     // of the speed of a turn: its halves
constexpr double other = 0.01;      // of a speed
constexpr double by_chance = 1e-3;  // that a delay is not seen to be one

/// Turns of one run, and what the delay is multiplied by to turn each centre.
struct Turning {
  std::vector<TurnCentre> turns;
  std::vector<double> speed;  ///< rad/s; without times 0 before the step and 1 after it

  void add(const TurnCentre& one, double at) {
    turns.push_back(one);
    speed.push_back(at);
  }
  std::vector<TurnCentre> turned_back(double delay) const {
    std::vector<TurnCentre> out = turns;
    for (std::size_t i = 0; i < out.size(); ++i) {
      const double c = std::cos(delay * speed[i]), s = std::sin(delay * speed[i]);
      out[i].x_mm = c * turns[i].x_mm + s * turns[i].y_mm;
      out[i].y_mm = c * turns[i].y_mm - s * turns[i].x_mm;
    }
    return out;
  }
};

/// rad/s; not a number if it changes within the turn.
double speed_of(const ProbeStream& stream, const TurnCentre& turn) {
  const auto between = [&](std::size_t a, std::size_t b) {
    return (stream.c_rad[b] - stream.c_rad[a]) / (stream.time_s[b] - stream.time_s[a]);
  };
  const std::size_t middle = (turn.begin + turn.end) / 2;
  const double first = between(turn.begin, middle), second = between(middle, turn.end - 1);
  const bool one = std::abs(first - second) <= steady * std::abs(first + second) / 2.0;
  return one ? between(turn.begin, turn.end - 1) : std::nan("");
}

/// Without the turns next to the step: two speeds may mix there, or a slip a reading later.
Turning turning_about(const CentreStep& step, const TurnCentres& centres,
                      const ProbeStream& stream) {
  Turning out;
  const auto at = std::ranges::find(centres.list, step.reading, &TurnCentre::begin);
  if (at == centres.list.end()) return out;
  for (auto one = centres.list.begin(); one != centres.list.end(); ++one) {
    if (one->run != at->run || std::abs(one - at) <= 1) continue;
    const double speed = !stream.time_s.empty() ? speed_of(stream, *one) : one < at ? 0.0 : 1.0;
    if (std::isfinite(speed)) out.add(*one, speed);
  }
  return out;
}

/// Where `cost` is least within ±reach.
template <class Cost>
double least_of(const Cost& cost, double reach) {
  constexpr int looks = 32;  // of a cosine that goes round once
  const double width = reach / looks;
  double best = 0.0;
  for (int i = -looks; i <= looks; ++i)
    if (cost(i * width) < cost(best)) best = i * width;
  constexpr int bits = 30;
  return boost::math::tools::brent_find_minima(cost, best - width, best + width, bits).first;
}

}  // namespace

CentreStep weighed_with_delay(CentreStep step, const ProbeStream& stream,
                              std::span<const double> value_mm) {
  TurnCentres centres = turn_centres(stream, value_mm);
  const Turning run = turning_about(step, centres, stream);
  if (run.turns.size() < least_run) return step;
  const auto [slow, fast] = range_of(run.speed);
  if (fast - slow <= other * std::max(std::abs(slow), std::abs(fast))) return step;
  const bool timed = !stream.time_s.empty();
  const double reach = std::numbers::pi / (fast - slow);  // each angle between two speeds once

  const Eigen::MatrixXd straight = line(run.turns);
  const auto n = static_cast<Eigen::Index>(run.turns.size());
  Eigen::MatrixXd broken(n, 5);
  broken << straight, Eigen::VectorXd::Zero(n), Eigen::VectorXd::Zero(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    if (run.turns[static_cast<std::size_t>(i)].begin < step.reading) continue;
    broken(i, 3) = 1.0, broken(i, 4) = straight(i, 2);
  }
  const auto left = [&](const Eigen::MatrixXd& model) {
    return [&](double delay) { return squares_about(model, places(run.turned_back(delay))); };
  };
  const double delay = least_of(left(straight), reach);
  // A delay alone, against a delay and a part that moved.
  const double better = left(straight)(delay) - left(broken)(least_of(left(broken), reach));
  centres.list = run.turned_back(delay);
  if (better > enough(by_chance, 1) * variance(places(centres.list), centres.u_mm) ||
      find_centre_step(centres, by_chance))
    return step;
  step.may_be_delay = true;
  if (timed) step.delay_s = delay;
  return step;
}

}  // namespace trueaxis

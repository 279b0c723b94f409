// SPDX-License-Identifier: Apache-2.0
#include "simulate/timeline.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "trueaxis/error.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis::virtual_lathe {
namespace {

constexpr double most_readings = 1e9;

void need(bool condition, std::size_t pass, const char* message) {
  if (condition) return;
  throw InputError("scenario", "pass " + std::to_string(pass + 1) + ' ' + message);
}

double count_of(double intervals) { return std::floor(intervals + 1e-9) + 1.0; }

TimedPass timed(const PlannedPass& pass, std::size_t index) {
  TimedPass timed;
  timed.position_mm = pass.start_mm;
  timed.omega_rad_per_s = pass.speed_rpm / 60.0 * two_pi;
  timed.jitter = pass.jitter;
  double count = 0.0;
  if (pass.speed_rpm == 0.0) {
    need(pass.duration_s > 0.0 && pass.rate_hz > 0.0, index,
         "stands still: give a duration and a rate");
    need(pass.start_mm == pass.end_mm, index, "stands still: start and end must be equal");
    timed.interval_s = 1.0 / pass.rate_hz;
    count = count_of(pass.duration_s * pass.rate_hz);
  } else {
    const double travel = pass.end_mm - pass.start_mm;
    const double turns_per_s = std::abs(pass.speed_rpm) / 60.0;
    need(pass.readings_per_revolution > 0.0, index, "needs readings per revolution > 0");
    need(travel == 0.0 || pass.feed_mm_per_rev > 0.0, index, "needs a feed > 0");
    need(travel != 0.0 || pass.revolutions > 0.0, index,
         "dwells (start = end): give its revolutions");
    const double turns = travel == 0.0 ? pass.revolutions : std::abs(travel) / pass.feed_mm_per_rev;
    timed.velocity_mm_per_s =
        travel == 0.0 ? 0.0 : std::copysign(pass.feed_mm_per_rev * turns_per_s, travel);
    timed.interval_s = 1.0 / (pass.readings_per_revolution * turns_per_s);
    count = count_of(turns * pass.readings_per_revolution);
  }
  need(count <= most_readings, index, "has more than 1e9 readings");
  timed.count = static_cast<std::size_t>(count);
  return timed;
}

}  // namespace

Moment TimedPass::at(double time_s) const {
  const double since = time_s - t_s;
  return {time_s, c_rad + omega_rad_per_s * since, position_mm + velocity_mm_per_s * since,
          omega_rad_per_s, velocity_mm_per_s};
}

Chucking find_setup(const Plan& plan, int number) {
  const auto at = std::ranges::find(plan.setups, number, &Chucking::number);
  if (at != plan.setups.end()) return *at;
  Chucking plain;
  plain.number = number;
  return plain;
}

std::vector<TimedPass> make_timeline(const Plan& plan) {
  if (plan.passes.empty()) throw InputError("scenario", "the plan has no pass: add one");
  std::vector<TimedPass> timeline;
  double t = 0.0, c = 0.0;
  for (std::size_t i = 0; i < plan.passes.size(); ++i) {
    const PlannedPass& pass = plan.passes[i];
    need(pass.jitter >= 0.0 && pass.jitter < 1.0, i, "needs a jitter in [0, 1)");
    TimedPass next = timed(pass, i);
    next.setup = find_setup(plan, pass.setup);
    const double pause = timeline.empty() ? 0.0 : pass.pause_s;
    next.t_s = t + pause;
    next.c_rad = pass.c_start_rad.value_or(c + next.omega_rad_per_s * pause);
    const double length_s = static_cast<double>(next.count - 1) * next.interval_s;
    t = next.t_s + length_s;
    c = next.c_rad + next.omega_rad_per_s * length_s;
    timeline.push_back(std::move(next));
  }
  return timeline;
}

}  // namespace trueaxis::virtual_lathe

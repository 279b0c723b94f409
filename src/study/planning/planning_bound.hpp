// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <mutex>
#include <vector>

#include "study/bound/bound.hpp"
#include "study/planning/planning.hpp"

namespace trueaxis::study::planning_detail {

/// Standard deviation of the axis at its worse end in its worse direction, from a covariance of
/// quantities(); with the weights of x_at_min_z … there.
struct WorstOfAxis {
  double sd_mm = 0.0;
  std::array<double, 4> weight{};
};
/// Eq. 127.
WorstOfAxis worst_of_axis(const virtual_lathe::Scenario& scenario, const Bound& bound);
std::size_t place_of_ends(const virtual_lathe::Scenario& scenario);

double measuring_time_s(const virtual_lathe::Scenario& scenario);
std::size_t readings_of(const virtual_lathe::Scenario& scenario);

/// A plan with its passes and turns, and every reading as good as `readings_each` of the plan's.
struct StandIn {
  virtual_lathe::Scenario scenario;
  double readings_each = 1.0;
};

/// Long streams of independent noise are thinned to `most_readings`, or 8.3 a revolution where that
/// is more: what the surface's parameters need of a turn, up to the third order, is in both.
inline constexpr double most_readings = 20'000.0;
StandIn stand_in(const virtual_lathe::Scenario& scenario);

/// worst_of_axis of plans that differ in what may be chosen; each is worked out once, noise in
/// proportion not at all. May be asked on several threads.
class AxisBounds {
 public:
  WorstOfAxis of(const virtual_lathe::Scenario& scenario);

 private:
  std::mutex one_at_a_time_;
  std::map<std::vector<double>, WorstOfAxis> known_;
};

PlannedMeasurement planned(const virtual_lathe::Scenario& scenario, double coverage_factor,
                           AxisBounds& bounds);

}  // namespace trueaxis::study::planning_detail

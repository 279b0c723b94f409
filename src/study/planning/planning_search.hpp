// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <mutex>
#include <vector>

#include "base/threads.hpp"
#include "study/bound/bound.hpp"
#include "study/planning/planning.hpp"

namespace trueaxis::study::planning_detail {

/// Standard deviation of the axis at its worse end in its worse direction, from a covariance of
/// quantities(); with the weights of x_at_min_z … there. For a face that of its height where it
/// is least certain, with the weights of l, m and d.
struct WorstOfAxis {
  double sd_mm = 0.0;
  std::array<double, 4> weight{};
};
/// Eq. 127.
WorstOfAxis worst_of_axis(const virtual_lathe::Scenario& scenario, const Bound& bound);
std::size_t place_of_ends(const virtual_lathe::Scenario& scenario);

double measuring_time_s(const virtual_lathe::Scenario& scenario);
std::size_t readings_of(const virtual_lathe::Scenario& scenario);

/// A plan with its passes and turns, where every reading counts as `readings_each` of the plan's.
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

/// Says how far the planning is; may be called on several threads.
class Steps {
 public:
  explicit Steps(const PlanningProgress& progress) : progress_(progress) {}
  void begin(PlanningStage stage, std::size_t to_do);
  void done(std::size_t count);

 private:
  const PlanningProgress& progress_;
  std::mutex one_at_a_time_;
  PlanningStage stage_ = PlanningStage::search;
  std::size_t done_ = 0, to_do_ = 0;
};

/// Solves for choices by the bound.
class PlanSearch {
 public:
  PlanSearch(const PlanningTask& task, Steps& steps) : task_(task), steps_(steps) {}

  PlannedMeasurement at(const virtual_lathe::Scenario& scenario) const {
    return planned(scenario, task_.coverage_factor, bounds_);
  }
  bool meets(const PlannedMeasurement& plan) const;
  /// Whether time and rate are within what is given.
  bool allowed(const PlannedMeasurement& plan) const;
  bool good(const PlannedMeasurement& plan) const { return meets(plan) && allowed(plan); }

  /// The least demanding value of a choice that meets the goal, rounded to what can be set; or the
  /// most demanding, which does not.
  PlannedMeasurement solve(const virtual_lathe::Scenario& scenario,
                           const DesignVariable& variable) const;

  /// A scenario with a choice between its least (0) and its most demanding end (1), by logarithm.
  static virtual_lathe::Scenario with(const virtual_lathe::Scenario& scenario,
                                      const DesignVariable& variable, double effort);

  /// As above, rounded to what can be set.
  static virtual_lathe::Scenario with_settable(const virtual_lathe::Scenario& scenario,
                                               const DesignVariable& variable, double effort);

  /// Independent pieces of the search on the task's threads; each is a step.
  void each(std::size_t count, const IndexedWork& work) const;
  void skip(std::size_t count) const { steps_.done(count); }

  /// Repeats of a plan, against the bound at a level shared by `among` confirmations.
  Confirmation confirm(const PlannedMeasurement& plan, std::size_t among) const;

 private:
  const PlanningTask& task_;
  Steps& steps_;
  mutable AxisBounds bounds_;
};

/// To three digits, readings per revolution to a tenth, on the demanding side; no whole number of
/// readings inside the range: orders n and M − n would be one column.
double settable(const DesignVariable& variable, double value);
const DesignVariable* find(const std::vector<DesignVariable>& variables, Choice choice);

}  // namespace trueaxis::study::planning_detail

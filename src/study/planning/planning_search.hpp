// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <mutex>
#include <vector>

#include "base/threads.hpp"
#include "study/planning/planning.hpp"
#include "study/planning/planning_bound.hpp"

namespace trueaxis::study::planning_detail {

/// Tells how far the planning is; may be told on several threads.
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

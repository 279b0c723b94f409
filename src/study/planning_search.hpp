// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "trueaxis/study/planning.hpp"

namespace trueaxis::study::planning_detail {

/// Solves for choices by the bound.
class Search {
 public:
  explicit Search(const PlanningTask& task) : task_(task) {}

  PlannedMeasurement at(const virtual_lathe::Scenario& scenario) const {
    return planned(scenario, task_.coverage_factor);
  }
  bool meets(const PlannedMeasurement& plan) const;
  bool in_time(const PlannedMeasurement& plan) const;

  /// The least demanding value of a choice that meets the goal, rounded to what can be set; or the
  /// most demanding, which does not.
  PlannedMeasurement solve(const virtual_lathe::Scenario& scenario, const Freedom& free) const;

  /// A scenario with a choice between its least (0) and its most demanding end (1), by logarithm.
  static virtual_lathe::Scenario with(const virtual_lathe::Scenario& scenario, const Freedom& free,
                                      double effort);

 private:
  const PlanningTask& task_;
};

const Freedom* find(const std::vector<Freedom>& free, Choice choice);
double measuring_time_s(const virtual_lathe::Scenario& scenario);

/// Repeats of a plan, against the bound at a level shared by `among` confirmations.
Confirmation confirm(const PlannedMeasurement& plan, const PlanningTask& task, std::size_t among);

/// Standard deviation of the axis at its worse end in its worse direction, from a covariance of
/// quantities(); with the weights of x_at_min_z … there.
struct WorstOfAxis {
  double sd_mm = 0.0;
  std::array<double, 4> weight{};
};
WorstOfAxis worst_of_axis(const virtual_lathe::Scenario& scenario, const Bound& bound);
std::size_t place_of_ends(const virtual_lathe::Scenario& scenario);

}  // namespace trueaxis::study::planning_detail

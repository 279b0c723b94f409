// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "study/sweep/summary.hpp"
#include "trueaxis/virtual_lathe.hpp"

/// Which length, readings and probe are needed for an uncertainty of the axis: before measuring,
/// from the Cramér-Rao bound, and confirmed by simulation.
namespace trueaxis::study {

/// What may be chosen.
enum class Choice { readings_per_revolution, sigma, feed, length };
inline constexpr std::array choices{Choice::readings_per_revolution, Choice::sigma, Choice::feed,
                                    Choice::length};

struct ChoiceInfo {
  const char* path;         ///< of its number in the scenario (see ScenarioParameter)
  const char *name, *unit;  ///< in results
  const char* words;        ///< "sigma of a reading"
  const char* alone;        ///< what a plan is called that changes nothing else
  bool more_is_better;      ///< whether more of it makes the axis more certain
};
const ChoiceInfo& info_of(Choice choice);

/// A number that may be chosen from a range; units inside, 0 < low ≤ high.
struct DesignVariable {
  Choice choice = Choice::readings_per_revolution;
  double low = 0.0, high = 0.0;
};

struct PlanningTask {
  virtual_lathe::Scenario base;
  std::vector<DesignVariable> variables;  ///< each choice once
  /// Largest U = k u of the axis over the probed length, in its worse direction; of a face that of
  /// its height over the probed radii.
  double goal_mm = 1e-3;
  double coverage_factor = 2.0;
  std::optional<double> rate_hz;  ///< readings a second that the probe gives, at most
  std::optional<double> time_s;   ///< that the measurement may take
  std::size_t repeats = 1000;     ///< of each confirmation
  std::uint64_t seed = 1;
  int threads = 0;  ///< 0: as many as there are
};

/// A plan and what the bound says of it.
struct PlannedMeasurement {
  virtual_lathe::Scenario scenario;
  double u_expanded_mm = 0.0;  ///< U = k u of an efficient fit; inf: nothing is determined
  double time_s = 0.0;         ///< of the passes, with the pauses before them
  double rate_hz = 0.0;        ///< readings a second, of the fastest pass
  std::size_t readings = 0;
  double of(Choice choice) const;
};

/// By the bound. For streams of more than 20 000 readings with independent noise it is that of
/// fewer readings per revolution, scaled by 1/√N, which is within 0.1 % (see stand_in).
PlannedMeasurement planned(const virtual_lathe::Scenario& scenario, double coverage_factor);

/// Repeated simulated measurements of a plan, fitted.
struct Confirmation {
  std::size_t repeats = 0, failures = 0;
  double u_expanded_mm = 0.0;  ///< k × RMSE of the axis at its worse end, in its worse direction
  Ends interval_95_mm;         ///< of the same for infinitely many repeats (χ²)
  double stated_mm = 0.0;      ///< mean of the U that the fits state
  bool at_bound = false;       ///< the bound is within the scatter, at 1 % over all confirmations
  bool misses = false;         ///< the goal, by more than the scatter: the fits are not efficient
  bool states_more = false;    ///< than the goal: the user's fit would not show that it is met

  bool good() const { return !misses && !states_more; }
};

/// A plan that meets the goal; which choices were changed.
struct Recommendation {
  std::string what;  ///< "readings per revolution alone", "quickest", …
  PlannedMeasurement plan;
  Confirmation confirmed;
};

/// One choice changed, all others as they are.
struct Alone {
  Choice choice = Choice::readings_per_revolution;
  bool reached = false;
  PlannedMeasurement plan;  ///< the least that does it; when not reached the nearest of the range
};

/// A row of the table: the other choices on a grid, one solved for.
struct TableRow {
  bool reached = false;
  PlannedMeasurement plan;  ///< as for Alone
};

struct PlanningAnswer {
  PlannedMeasurement as_given;
  bool reached = false;    ///< whether some plan meets the goal, within time and rate
  bool confirmed = false;  ///< and simulated fits of one meet it and state that they do
  PlannedMeasurement
      nearest;               ///< smallest U that the ranges, time and rate allow, if they allow any
  std::vector<Alone> alone;  ///< in the order of `variables`
  Choice solved_for = Choice::readings_per_revolution;
  std::vector<TableRow> table;  ///< by the choices that are not solved for; empty without others
  std::vector<Recommendation> recommended;    ///< each meets the goal by the bound and confirmed
  std::vector<Recommendation> not_confirmed;  ///< by the bound only
  std::vector<std::string> remarks;           ///< what limits the answer
};

enum class PlanningStage {
  search,     ///< a step is a choice, a length or a row
  simulation  ///< a step is a repeat
};
/// Called after each step, one call at a time, on any thread.
using PlanningProgress =
    std::function<void(PlanningStage stage, std::size_t done, std::size_t to_do)>;

/// The same on any number of threads.
/// @throws InputError for a scenario that cannot be probed, noise without a bound, or an invalid
/// goal.
PlanningAnswer plan_measurement(const PlanningTask& task, const PlanningProgress& progress = {});

}  // namespace trueaxis::study

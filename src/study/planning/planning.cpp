// SPDX-License-Identifier: Apache-2.0
#include "study/planning/planning.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "base/number.hpp"
#include "measure/angles_alike.hpp"
#include "simulate/clean_stream.hpp"
#include "study/bound/bound.hpp"
#include "study/bound/quantities.hpp"
#include "study/planning/planning_search.hpp"
#include "study/sweep/scenario_parameters.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis::study {

using namespace planning_detail;

namespace {

using virtual_lathe::Scenario;

constexpr int lengths_tried = 9, lengths_between = 7;

void check(const PlanningTask& task) {
  const auto refuse = [](const char* why) { throw InputError("plan", why); };
  const virtual_lathe::Noise& noise = task.base.noise;
  if (!(task.goal_mm > 0.0) || !(task.coverage_factor > 0.0))
    refuse("the goal and k must be more than 0");
  if (!std::isfinite(task.goal_mm) || !std::isfinite(task.coverage_factor))
    refuse("the goal and k must be finite");
  for (const DesignVariable& variable : task.variables) {
    if (!(variable.low > 0.0) || !(variable.low <= variable.high) || !std::isfinite(variable.high))
      refuse("a range goes from a number above 0 to one that is not smaller");
    if (std::ranges::count(task.variables, variable.choice, &DesignVariable::choice) > 1)
      refuse("a choice has two ranges");
  }
  if (!(noise.sigma_mm > 0.0 || noise.uniform_mm > 0.0) && !find(task.variables, Choice::sigma))
    refuse("without noise every plan is perfect: give the probe's noise");
  const virtual_lathe::Probe& probe = task.base.probe;
  if (probe.relative_zero_mm && !probe.nominal_radius_mm)
    refuse("a relative gauge does not show the radius: give nominal_radius_mm");
  refuse_moving_axis(task.base, virtual_lathe::simulate_clean(task.base).stream, "plan");
}

/// The probe's rate as a limit on the readings per revolution.
void limit_rate(PlanningTask& task, std::vector<std::string>& remarks) {
  if (!task.rate_hz) return;
  double fastest_rpm = 0.0;
  for (const auto& pass : task.base.plan.passes)
    fastest_rpm = std::max(fastest_rpm, std::abs(pass.speed_rpm));
  const double most = *task.rate_hz * 60.0 / fastest_rpm;
  for (const auto& pass : task.base.plan.passes) {
    const double rate = pass.readings_per_revolution * std::abs(pass.speed_rpm) / 60.0;
    if (rate <= *task.rate_hz || find(task.variables, Choice::readings_per_revolution)) continue;
    remarks.push_back(
        fmt::format("the plan needs {:.4g} readings per second, more than the {:g}: use fewer per "
                    "revolution, or a slower spindle",
                    rate, *task.rate_hz));
    break;
  }
  for (DesignVariable& variable : task.variables) {
    if (variable.choice != Choice::readings_per_revolution || variable.high <= most) continue;
    variable.high = most;
    remarks.push_back(
        fmt::format("{:g} readings a second are {:.4g} readings per revolution at {:g}/min",
                    *task.rate_hz, most, fastest_rpm));
    if (variable.low > variable.high)
      throw InputError("plan", remarks.back() + ": less than the range begins with");
  }
}

/// No fewer readings per revolution than an axis is given from.
void limit_angles(PlanningTask& task, std::vector<std::string>& remarks) {
  for (DesignVariable& variable : task.variables) {
    if (variable.choice != Choice::readings_per_revolution || variable.low >= least_angles)
      continue;
    variable.low = least_angles;
    remarks.push_back(fmt::format(
        "the range of readings per revolution begins at {}: with fewer, no axis is given",
        least_angles));
    if (variable.low > variable.high)
      throw InputError("plan", remarks.back() + ", and it ends below that");
  }
}

/// The ranges must be possible: on the part, and readings that can be counted.
void check_ends(const PlanningTask& task) {
  const DesignVariable* length = find(task.variables, Choice::length);
  Scenario most = task.base;
  for (const DesignVariable& variable : task.variables)
    most = PlanSearch::with(most, variable, 1.0);
  try {
    (void)readings_of(most);
  } catch (const InputError& error) {
    throw InputError("plan", std::string("at the demanding ends of the ranges: ") + error.what());
  }
  if (!length) return;
  try {
    (void)virtual_lathe::simulate_clean(
        stand_in(PlanSearch::with(task.base, *length, 1.0)).scenario);
  } catch (const InputError& error) {
    throw InputError("plan", std::string("at the longest length of its range: ") + error.what());
  }
}

/// Everything as demanding as it may be but feed and length; the scenario's own probe, or the best.
Scenario demanding(const PlanningTask& task, bool best_probe) {
  Scenario out = task.base;
  for (const DesignVariable& variable : task.variables) {
    if (variable.choice == Choice::readings_per_revolution ||
        (variable.choice == Choice::sigma && best_probe))
      out = PlanSearch::with(out, variable, 1.0);
  }
  return out;
}

std::size_t lengths_looked_at(const PlanningTask& task) {
  return find(task.variables, Choice::length) ? lengths_tried + lengths_between : 1;
}

using Rated = std::pair<double, PlannedMeasurement>;

/// The best of `rate(scenario of a length)` over the range, smaller is better.
PlannedMeasurement best_over_length(const PlanningTask& task, const PlanSearch& search,
                                    const Scenario& from,
                                    const std::function<Rated(const Scenario&)>& rate) {
  const DesignVariable* length = find(task.variables, Choice::length);
  std::optional<Rated> best;
  double best_effort = 0.0;
  const auto look = [&](const std::vector<double>& efforts) {
    std::vector<Rated> rated(efforts.size());
    search.each(efforts.size(), [&](std::size_t i) {
      rated[i] = rate(length ? PlanSearch::with_settable(from, *length, efforts[i]) : from);
    });
    for (std::size_t i = 0; i < rated.size(); ++i) {
      if (best && !(rated[i].first < best->first)) continue;
      best = std::move(rated[i]), best_effort = efforts[i];
    }
  };
  if (!length) {
    look({0.0});
    return std::move(best->second);
  }
  constexpr double apart = 1.0 / (lengths_tried - 1);
  std::vector<double> efforts;
  for (int i = 0; i < lengths_tried; ++i) efforts.push_back(i * apart);
  look(efforts);
  efforts.clear();
  for (int i = 1; i <= lengths_between; ++i) {
    const double effort = best_effort + apart * (2.0 * i / (lengths_between + 1) - 1.0);
    if (effort > 0.0 && effort < 1.0 && effort != best_effort) efforts.push_back(effort);
  }
  look(efforts);
  search.skip(lengths_between - efforts.size());
  return std::move(best->second);
}

/// Smallest U, within the time if there is one.
PlannedMeasurement smallest_u(const PlanningTask& task, const PlanSearch& search, bool best_probe) {
  const DesignVariable* feed = find(task.variables, Choice::feed);
  const Scenario from = demanding(task, best_probe);
  return best_over_length(task, search, from, [&](const Scenario& scenario) {
    Scenario slow = scenario;
    if (feed) {
      slow = PlanSearch::with(scenario, *feed, 1.0);
      // Passes and turns share the time left after the pauses: time falls as 1/feed.
      if (task.time_s && measuring_time_s(slow) > *task.time_s) {
        double pauses = 0.0;
        for (const auto& pass : slow.plan.passes) pauses += pass.pause_s;
        const double room = *task.time_s - pauses;
        const double exact = feed->low * (measuring_time_s(slow) - pauses) / room;
        const double step = digit_worth(exact, 3);
        const double wanted = std::ceil(exact / step - 1e-9) * step;  // three digits, and in time
        set_parameter(slow, info_of(Choice::feed).path,
                      room > 0.0 ? std::clamp(wanted, feed->low, feed->high) : feed->high);
      }
    }
    PlannedMeasurement plan = search.at(slow);
    const double late = search.allowed(plan) ? 0.0 : 1e6 * plan.time_s;
    const double height = plan.u_expanded_mm + late;
    return Rated{height, std::move(plan)};
  });
}

/// Shortest time that meets the goal, or if none does, the smallest U.
PlannedMeasurement quickest(const PlanningTask& task, const PlanSearch& search, bool best_probe) {
  const DesignVariable* feed = find(task.variables, Choice::feed);
  const DesignVariable* length = find(task.variables, Choice::length);
  const Scenario from = demanding(task, best_probe);
  if (length && !feed) {
    search.skip(lengths_looked_at(task));
    return search.solve(from, *length);
  }
  return best_over_length(task, search, from, [&](const Scenario& scenario) {
    PlannedMeasurement plan = feed ? search.solve(scenario, *feed) : search.at(scenario);
    const double time = search.meets(plan) ? plan.time_s : 1e12 * plan.u_expanded_mm / task.goal_mm;
    return Rated{time, std::move(plan)};
  });
}

/// As many readings as are needed and no more, where they may be chosen.
PlannedMeasurement without_excess(const PlanningTask& task, const PlanSearch& search,
                                  PlannedMeasurement plan) {
  const DesignVariable* readings = find(task.variables, Choice::readings_per_revolution);
  if (!readings) return plan;
  PlannedMeasurement fewer = search.solve(plan.scenario, *readings);
  return search.meets(fewer) ? fewer : plan;
}

/// The other choices on a grid, from least to most demanding.
struct Grid {
  std::vector<DesignVariable> others;
  std::size_t nodes = 0, rows = 0;

  Grid(const PlanningTask& task, Choice solved_for) {
    for (const DesignVariable& variable : task.variables) {
      if (variable.choice != solved_for) others.push_back(variable);
    }
    nodes = others.size() == 1 ? 5 : others.size() == 2 ? 4 : 3;
    rows = others.empty() ? 0 : 1;
    for (std::size_t i = 0; i < others.size(); ++i) rows *= nodes;
  }

  Scenario at(Scenario scenario, std::size_t row) const {
    for (const DesignVariable& other : others) {
      const double effort = static_cast<double>(row % nodes) / static_cast<double>(nodes - 1);
      scenario = PlanSearch::with_settable(scenario, other, effort);
      row /= nodes;
    }
    return scenario;
  }
};

std::vector<TableRow> table_of(const PlanningTask& task, const PlanSearch& search, const Grid& grid,
                               const DesignVariable& solved) {
  std::vector<TableRow> table(grid.rows);
  search.each(grid.rows, [&](std::size_t row) {
    table[row].plan = search.solve(grid.at(task.base, row), solved);
    table[row].reached = search.meets(table[row].plan);
  });
  return table;
}

void recommend(PlanningAnswer& out, const char* what, PlannedMeasurement plan) {
  const bool there = std::ranges::any_of(out.recommended, [&](const Recommendation& one) {
    return std::ranges::all_of(choices, [&](Choice c) { return one.plan.of(c) == plan.of(c); });
  });
  if (!there) out.recommended.push_back({what, std::move(plan), {}});
}

/// What is nearest, with the scenario's own probe where that does.
bool look_for_nearest(const PlanningTask& task, const PlanSearch& search, PlanningAnswer& out) {
  out.nearest = smallest_u(task, search, false);
  const bool better_probe = !search.good(out.nearest) && find(task.variables, Choice::sigma);
  if (better_probe) {
    out.nearest = smallest_u(task, search, true);
    out.remarks.emplace_back(
        "the scenario's probe is not good enough within the ranges: the plan uses the best of its "
        "range");
  } else {
    search.skip(lengths_looked_at(task));
  }
  // If the ranges do not contain what is given, that with one of them may be nearer.
  const auto nearer = [&](const PlannedMeasurement& plan) {
    if (search.allowed(plan) &&
        !(search.allowed(out.nearest) && out.nearest.u_expanded_mm <= plan.u_expanded_mm))
      out.nearest = plan;
  };
  nearer(out.as_given);
  for (const Alone& one : out.alone) nearer(one.plan);
  if (!std::isfinite(out.nearest.u_expanded_mm)) {
    const bool face = task.base.part.kind == virtual_lathe::PartKind::face;
    out.remarks.push_back(
        fmt::format("no plan of the ranges determines the {}: probe more of the length or the "
                    "circumference",
                    face ? "face" : "axis"));
  }
  out.reached = search.good(out.nearest);
  return better_probe;
}

std::vector<Alone> each_alone(const PlanningTask& task, const PlanSearch& search) {
  std::vector<Alone> alone(task.variables.size());
  search.each(alone.size(), [&](std::size_t i) {
    alone[i].choice = task.variables[i].choice;
    alone[i].plan = search.solve(task.base, task.variables[i]);
    alone[i].reached = search.meets(alone[i].plan);
  });
  return alone;
}

/// A plan is recommended where its simulated fits meet the goal and state so: their own U is what a
/// user will see.
void sort_by_confirmation(PlanningAnswer& out) {
  const auto first_not = std::ranges::stable_partition(
      out.recommended, [](const Recommendation& one) { return one.confirmed.good(); });
  out.not_confirmed.assign(first_not.begin(), first_not.end());
  out.recommended.erase(first_not.begin(), first_not.end());
  out.confirmed = !out.recommended.empty();
}

}  // namespace

PlanningAnswer plan_measurement(const PlanningTask& asked, const PlanningProgress& progress) {
  PlanningTask task = asked;
  PlanningAnswer out;
  check(task);
  limit_rate(task, out.remarks);
  limit_angles(task, out.remarks);
  check_ends(task);
  const virtual_lathe::Noise& noise = task.base.noise;
  if (find(task.variables, Choice::readings_per_revolution) &&
      (noise.rho != 0.0 || !noise.autoregression.empty())) {
    out.remarks.emplace_back(
        "the noise is correlated from reading to reading, at any rate alike: if it persists in "
        "time, the correlation grows with the rate of readings");
  }
  for (const Choice choice : choices) {
    if (!find(task.variables, choice)) continue;
    out.solved_for = choice;
    break;
  }
  const DesignVariable* solved = find(task.variables, out.solved_for);
  const Grid grid(task, out.solved_for);
  Steps steps(progress);
  const PlanSearch search(task, steps);
  steps.begin(PlanningStage::search,
              task.variables.size() + grid.rows + 3 * lengths_looked_at(task));
  out.as_given = search.at(task.base);
  const bool good_as_given = search.good(out.as_given);
  if (good_as_given) recommend(out, "as it is", out.as_given);
  out.alone = each_alone(task, search);
  for (const Alone& one : out.alone) {
    const double change = one.plan.of(one.choice) - out.as_given.of(one.choice);
    const bool needless =
        good_as_given && (info_of(one.choice).more_is_better ? change : -change) > 0.0;
    if (search.good(one.plan) && !needless) recommend(out, info_of(one.choice).alone, one.plan);
  }
  const bool best_probe = look_for_nearest(task, search, out);
  if (solved) out.table = table_of(task, search, grid, *solved);
  if (out.reached && solved) {
    const PlannedMeasurement fast = quickest(task, search, best_probe);
    if (search.good(fast)) recommend(out, "quickest", without_excess(task, search, fast));
    if (task.time_s) recommend(out, "most certain in the time", out.nearest);
  }
  steps.begin(PlanningStage::simulation, out.recommended.size() * task.repeats);
  for (Recommendation& one : out.recommended)
    one.confirmed = search.confirm(one.plan, out.recommended.size());
  sort_by_confirmation(out);
  return out;
}

}  // namespace trueaxis::study

// SPDX-License-Identifier: Apache-2.0
#include "study/planning/planning_search.hpp"

#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <cmath>
#include <limits>

#include "base/number.hpp"
#include "study/sweep/block.hpp"
#include "study/sweep/scenario_parameters.hpp"

namespace trueaxis::study {

using namespace planning_detail;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double met = 1.0 + 1e-9;     // of the goal: rounding of the bound
constexpr double close_enough = 1e-3;  // of the goal, before a value is rounded to be set
constexpr double beyond = 1.01, least_step = 0.01;  // of the first steps
constexpr int most_steps = 25;
constexpr double noticeable = 1.05;  // of the goal: more than an estimated sigma scatters by

}  // namespace

const ChoiceInfo& info_of(Choice choice) {
  static constexpr ChoiceInfo all[] = {
      {"pass.readings_per_revolution", "readings_per_revolution", "1", "readings per revolution",
       "other readings per revolution alone", true},
      {"noise.sigma_mm", "sigma", "mm", "sigma of a reading", "another probe alone", false},
      {"pass.feed_mm_per_rev", "feed_per_rev", "mm", "feed", "another feed alone", false},
      {"pass.length_mm", "length", "mm", "length", "another length alone", true}};
  return all[static_cast<std::size_t>(choice)];
}

double PlannedMeasurement::of(Choice choice) const {
  return parameter(scenario, info_of(choice).path);
}

namespace planning_detail {

double settable(const DesignVariable& variable, double value) {
  if (variable.choice == Choice::readings_per_revolution) {
    double tenths = std::ceil(value * 10.0 - 1e-9);
    if (std::fmod(tenths, 10.0) == 0.0) tenths += 1.0;
    return std::clamp(tenths / 10.0, variable.low, variable.high);
  }
  const double step = digit_worth(value, 3);
  const double steps = info_of(variable.choice).more_is_better ? std::ceil(value / step - 1e-9)
                                                               : std::floor(value / step + 1e-9);
  return std::clamp(steps * step, variable.low, variable.high);
}

void Steps::begin(PlanningStage stage, std::size_t to_do) {
  const std::lock_guard lock(one_at_a_time_);
  stage_ = stage, done_ = 0, to_do_ = to_do;
}

void Steps::done(std::size_t count) {
  const std::lock_guard lock(one_at_a_time_);
  done_ += count;
  if (progress_ && count > 0) progress_(stage_, done_, to_do_);
}

const DesignVariable* find(const std::vector<DesignVariable>& variables, Choice choice) {
  const auto at = std::ranges::find(variables, choice, &DesignVariable::choice);
  return at == variables.end() ? nullptr : &*at;
}

void PlanSearch::each(std::size_t count, const IndexedWork& work) const {
  for_each_index(count, task_.threads, [&](std::size_t i) {
    work(i);
    steps_.done(1);
  });
}

bool PlanSearch::meets(const PlannedMeasurement& plan) const {
  return plan.u_expanded_mm <= task_.goal_mm * met;
}

bool PlanSearch::allowed(const PlannedMeasurement& plan) const {
  return (!task_.time_s || plan.time_s <= *task_.time_s * met) &&
         (!task_.rate_hz || plan.rate_hz <= *task_.rate_hz * met);
}

virtual_lathe::Scenario PlanSearch::with(const virtual_lathe::Scenario& scenario,
                                         const DesignVariable& variable, double effort) {
  virtual_lathe::Scenario out = scenario;
  const double share = info_of(variable.choice).more_is_better ? effort : 1.0 - effort;
  const double value = variable.low * std::pow(variable.high / variable.low, share);
  set_parameter(out, info_of(variable.choice).path, std::clamp(value, variable.low, variable.high));
  return out;
}

virtual_lathe::Scenario PlanSearch::with_settable(const virtual_lathe::Scenario& scenario,
                                                  const DesignVariable& variable, double effort) {
  virtual_lathe::Scenario out = with(scenario, variable, effort);
  const char* const path = info_of(variable.choice).path;
  set_parameter(out, path, settable(variable, parameter(out, path)));
  return out;
}

PlannedMeasurement PlanSearch::solve(const virtual_lathe::Scenario& scenario,
                                     const DesignVariable& variable) const {
  PlannedMeasurement least = at(with(scenario, variable, 0.0));
  if (meets(least)) return least;
  // Out by the law of large numbers, back by regula falsi on ln U, which is nearly linear in the
  // logarithm of every choice; halving where it is not, or where nothing is determined.
  const auto height = [&](const PlannedMeasurement& plan) {
    return std::log(plan.u_expanded_mm / task_.goal_mm);
  };
  const double power = variable.choice == Choice::sigma ? 1.0 : 0.5;
  const double fall = power * std::log(variable.high / variable.low);
  PlannedMeasurement most;
  double low = 0.0, high = infinity, at_low = height(least), at_high = 0.0;
  for (int step = 0; step < most_steps && !(at_high < 0.0 && at_high > -close_enough); ++step) {
    double effort = 0.0;
    if (high > 1.0) {
      const double further = std::isfinite(at_low) ? beyond * at_low / fall : 0.5 * (1.0 - low);
      effort = std::min(1.0, low + std::max(further, least_step));
    } else {
      const bool straight = std::isfinite(at_low) && step % 3 != 2;
      const double share = straight ? at_low / (at_low - at_high) : 0.5;
      effort = low + std::clamp(share, 0.02, 0.98) * (high - low);
    }
    PlannedMeasurement now = at(with(scenario, variable, effort));
    if (meets(now)) {
      high = effort, at_high = height(now), most = std::move(now);
    } else if (effort >= 1.0) {
      return now;
    } else {
      low = effort, at_low = height(now);
    }
    if (high - low < 1e-6) break;
  }
  if (high > 1.0) return at(with(scenario, variable, 1.0));
  virtual_lathe::Scenario rounded = scenario;
  set_parameter(rounded, info_of(variable.choice).path,
                settable(variable, most.of(variable.choice)));
  PlannedMeasurement set = at(rounded);
  return meets(set) ? set : most;
}

Confirmation PlanSearch::confirm(const PlannedMeasurement& plan, std::size_t among) const {
  Sweep sweep;
  sweep.base = plan.scenario;
  sweep.repeats = task_.repeats;
  sweep.seed = task_.seed;
  const WorstOfAxis worst = bounds_.of(plan.scenario);
  const std::size_t from = place_of_ends(plan.scenario);
  const std::vector<Block> blocks = blocks_of(sweep);
  std::vector<BlockResult> results(blocks.size());
  run_blocks(sweep, blocks, task_.threads, [&](BlockResult&& result) {
    steps_.done(result.block.count);
    results[static_cast<std::size_t>(std::ranges::find(blocks, result.block) - blocks.begin())] =
        std::move(result);
  });
  double squares = 0.0, stated = 0.0;
  Confirmation out;
  for (const BlockResult& result : results) {
    for (std::size_t repeat = 0; repeat < result.block.count; ++repeat) {
      double error = 0.0, variance = 0.0;
      for (std::size_t i = 0; i < 4; ++i) {
        const std::size_t place = repeat * result.quantities + from + i;
        if (worst.weight[i] == 0.0) continue;
        error += worst.weight[i] * result.error[place];
        variance += std::pow(worst.weight[i] * result.u[place], 2);
      }
      if (!std::isfinite(error)) {
        ++out.failures;
        continue;
      }
      ++out.repeats, squares += error * error, stated += std::sqrt(variance);
    }
  }
  out.misses = out.repeats == 0;
  if (out.misses) return out;
  const auto n = static_cast<double>(out.repeats);
  const double rmse = std::sqrt(squares / n), k = task_.coverage_factor;
  const boost::math::chi_squared law(n);
  const auto ends = [&](double level) {
    return Ends{rmse * std::sqrt(n / quantile(law, 1.0 - 0.5 * level)),
                rmse * std::sqrt(n / quantile(law, 0.5 * level))};
  };
  const Ends of_95 = ends(0.05);
  const Ends of_all = ends(bonferroni_level / static_cast<double>(among));
  out.u_expanded_mm = k * rmse;
  out.interval_95_mm = {k * of_95.low, k * of_95.high};
  out.stated_mm = k * stated / n;
  out.at_bound = worst.sd_mm >= of_all.low && worst.sd_mm <= of_all.high;
  out.misses = !out.at_bound && out.interval_95_mm.low > task_.goal_mm;
  out.states_more = out.stated_mm > noticeable * task_.goal_mm;
  return out;
}

}  // namespace planning_detail
}  // namespace trueaxis::study

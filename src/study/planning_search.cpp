// SPDX-License-Identifier: Apache-2.0
#include "study/planning_search.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <cmath>
#include <limits>

#include "trueaxis/base/error.hpp"
#include "trueaxis/simulate/clean_stream.hpp"
#include "trueaxis/study/block.hpp"
#include "trueaxis/study/quantities.hpp"
#include "trueaxis/study/run.hpp"
#include "trueaxis/study/scenario_parameters.hpp"

namespace trueaxis::study {

using namespace planning_detail;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double met = 1.0 + 1e-9;     // of the goal: rounding of the bound
constexpr double close_enough = 1e-3;  // of the goal, before a value is rounded to be set
constexpr double beyond = 1.01, least_step = 0.01;  // of the first steps
constexpr int most_steps = 25;

/// Whether more of a choice makes the axis more certain.
bool more_is_better(Choice choice) {
  return choice == Choice::readings_per_revolution || choice == Choice::length;
}

/// To three digits, readings per revolution to a tenth, on the demanding side; no whole number of
/// readings inside the range: orders n and M − n would be one column.
double settable(const Freedom& free, double value) {
  if (free.choice == Choice::readings_per_revolution) {
    double tenths = std::ceil(value * 10.0 - 1e-9);
    if (std::fmod(tenths, 10.0) == 0.0) tenths += 1.0;
    return std::clamp(tenths / 10.0, free.low, free.high);
  }
  const double step = std::pow(10.0, std::floor(std::log10(value)) - 2.0);
  const double steps = more_is_better(free.choice) ? std::ceil(value / step - 1e-9)
                                                   : std::floor(value / step + 1e-9);
  return std::clamp(steps * step, free.low, free.high);
}

}  // namespace

const char* path_of(Choice choice) {
  switch (choice) {
    case Choice::readings_per_revolution:
      return "pass.readings_per_revolution";
    case Choice::sigma:
      return "noise.sigma_mm";
    case Choice::feed:
      return "pass.feed_mm_per_rev";
    case Choice::length:
      break;
  }
  return "pass.length_mm";
}

double PlannedMeasurement::of(Choice choice) const { return parameter(scenario, path_of(choice)); }

PlannedMeasurement planned(const virtual_lathe::Scenario& scenario, double coverage_factor) {
  PlannedMeasurement out;
  out.scenario = scenario;
  out.readings = virtual_lathe::simulate_clean(scenario).value_mm.size();
  out.time_s = measuring_time_s(scenario);
  for (const virtual_lathe::PlannedPass& pass : scenario.plan.passes) {
    const double turning = pass.readings_per_revolution * std::abs(pass.speed_rpm) / 60.0;
    out.rate_hz = std::max(out.rate_hz, pass.speed_rpm == 0.0 ? pass.rate_hz : turning);
  }
  const double u =
      worst_of_axis(scenario, bound_of(scenario, surface_of(scenario.part.kind))).sd_mm;
  out.u_expanded_mm = std::isfinite(u) ? coverage_factor * u : infinity;
  return out;
}

namespace planning_detail {

const Freedom* find(const std::vector<Freedom>& free, Choice choice) {
  const auto at = std::ranges::find(free, choice, &Freedom::choice);
  return at == free.end() ? nullptr : &*at;
}

double measuring_time_s(const virtual_lathe::Scenario& scenario) {
  double time = 0.0;
  for (const virtual_lathe::PlannedPass& pass : scenario.plan.passes) {
    const double turns = pass.start_mm == pass.end_mm
                             ? pass.revolutions
                             : std::abs(pass.end_mm - pass.start_mm) / pass.feed_mm_per_rev;
    time += pass.pause_s +
            (pass.speed_rpm == 0.0 ? pass.duration_s : turns * 60.0 / std::abs(pass.speed_rpm));
  }
  return time;
}

std::size_t place_of_ends(const virtual_lathe::Scenario& scenario) {
  const std::vector<Quantity> all = quantities(surface_of(scenario.part.kind));
  const auto at = std::ranges::find(all, "x_at_min_z", &Quantity::name);
  expects(at != all.end(), "a part with an axis");
  return static_cast<std::size_t>(at - all.begin());
}

WorstOfAxis worst_of_axis(const virtual_lathe::Scenario& scenario, const Bound& bound) {
  const std::size_t count = bound.sd.size(), from = place_of_ends(scenario);
  WorstOfAxis worst;
  for (const std::size_t end : {0, 2}) {  // the variance is convex along the axis
    const auto c = [&](std::size_t i, std::size_t j) {
      return bound.covariance[(from + end + i) * count + from + end + j];
    };
    Eigen::Matrix2d covariance;
    covariance << c(0, 0), c(0, 1), c(1, 0), c(1, 1);
    if (!covariance.allFinite()) return {std::numeric_limits<double>::quiet_NaN(), {}};
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> eigen(covariance);
    const double sd = std::sqrt(std::max(0.0, eigen.eigenvalues()(1)));
    if (sd < worst.sd_mm) continue;
    worst = {sd, {}};
    worst.weight[end] = eigen.eigenvectors()(0, 1);
    worst.weight[end + 1] = eigen.eigenvectors()(1, 1);
  }
  return worst;
}

bool Search::meets(const PlannedMeasurement& plan) const {
  return plan.u_expanded_mm <= task_.goal_mm * met;
}

bool Search::in_time(const PlannedMeasurement& plan) const {
  return !task_.time_s || plan.time_s <= *task_.time_s * met;
}

virtual_lathe::Scenario Search::with(const virtual_lathe::Scenario& scenario, const Freedom& free,
                                     double effort) {
  virtual_lathe::Scenario out = scenario;
  const double share = more_is_better(free.choice) ? effort : 1.0 - effort;
  const double value = free.low * std::pow(free.high / free.low, share);
  set_parameter(out, path_of(free.choice), std::clamp(value, free.low, free.high));
  return out;
}

PlannedMeasurement Search::solve(const virtual_lathe::Scenario& scenario,
                                 const Freedom& free) const {
  PlannedMeasurement least = at(with(scenario, free, 0.0));
  if (meets(least)) return least;
  // Out by the law of large numbers, back by regula falsi on ln U, which is nearly linear in the
  // logarithm of every choice; halving where it is not, or where nothing is determined.
  const auto height = [&](const PlannedMeasurement& plan) {
    return std::log(plan.u_expanded_mm / task_.goal_mm);
  };
  const double power = free.choice == Choice::sigma ? 1.0 : 0.5;
  const double fall = power * std::log(free.high / free.low);
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
    PlannedMeasurement now = at(with(scenario, free, effort));
    if (meets(now)) {
      high = effort, at_high = height(now), most = std::move(now);
    } else if (effort >= 1.0) {
      return now;
    } else {
      low = effort, at_low = height(now);
    }
    if (high - low < 1e-6) break;
  }
  if (high > 1.0) return at(with(scenario, free, 1.0));
  virtual_lathe::Scenario rounded = scenario;
  set_parameter(rounded, path_of(free.choice), settable(free, most.of(free.choice)));
  PlannedMeasurement set = at(rounded);
  return meets(set) ? set : most;
}

Confirmation confirm(const PlannedMeasurement& plan, const PlanningTask& task, std::size_t among) {
  Sweep sweep;
  sweep.base = plan.scenario;
  sweep.repeats = task.repeats;
  sweep.seed = task.seed;
  const WorstOfAxis worst =
      worst_of_axis(plan.scenario, bound_of(plan.scenario, surface_of(plan.scenario.part.kind)));
  const std::size_t from = place_of_ends(plan.scenario);
  const std::vector<Block> blocks = blocks_of(sweep);
  std::vector<BlockResult> results(blocks.size());
  run_blocks(sweep, blocks, task.threads, [&](BlockResult&& result) {
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
  if (out.repeats == 0) return out;
  const auto n = static_cast<double>(out.repeats);
  const double rmse = std::sqrt(squares / n), k = task.coverage_factor;
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
  return out;
}

}  // namespace planning_detail
}  // namespace trueaxis::study

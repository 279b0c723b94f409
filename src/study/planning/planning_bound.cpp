// SPDX-License-Identifier: Apache-2.0
#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

#include "math/linear_algebra.hpp"
#include "simulate/timeline.hpp"
#include "study/bound/quantities.hpp"
#include "study/planning/planning_search.hpp"
#include "trueaxis/effect.hpp"
#include "trueaxis/error.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis::study {
namespace planning_detail {
namespace {

using virtual_lathe::Noise;
using virtual_lathe::PlannedPass;
using virtual_lathe::Scenario;

constexpr double least_per_revolution = 8.3;
constexpr double beyond_linear_mm = 10.0;  // a bound of derivatives says nothing so far off
constexpr double sigma_of_reference_mm = 1e-3;
constexpr int directions_tried = 360;  // of a face: within cos 0.5° of the worst

bool is_independent(const Noise& noise) { return noise.rho == 0.0 && noise.autoregression.empty(); }

/// Whether all noise of a reading is in proportion to its sigma.
bool is_in_proportion(const Scenario& scenario) {
  return scenario.noise.uniform_mm == 0.0 && scenario.noise.quantisation_mm == 0.0 &&
         std::ranges::none_of(scenario.effects, [](const virtual_lathe::Effect& effect) {
           return effect.id == entry_of(DataCheck::quantisation).id;
         });
}

/// What may be chosen of a scenario, pass by pass.
std::vector<double> key_of(const Scenario& scenario) {
  std::vector<double> key{scenario.noise.sigma_mm};
  for (const PlannedPass& pass : scenario.plan.passes) {
    key.insert(key.end(),
               {pass.start_mm, pass.end_mm, pass.feed_mm_per_rev, pass.readings_per_revolution});
  }
  return key;
}

/// The height d − l x − m y of a face at its largest radius, where it is least certain.
WorstOfAxis worst_of_face(const Scenario& scenario, const Bound& bound) {
  double radius = 0.0;
  for (const PlannedPass& pass : scenario.plan.passes)
    radius = std::max({radius, std::abs(pass.start_mm), std::abs(pass.end_mm)});
  const Eigen::Matrix3d covariance = Eigen::Map<const Eigen::Matrix3d>(bound.covariance.data());
  if (!covariance.allFinite()) return {std::numeric_limits<double>::quiet_NaN(), {}};
  WorstOfAxis worst;
  for (int k = 0; k < directions_tried; ++k) {
    const double at = two_pi * k / directions_tried;
    const Eigen::Vector3d weight(-radius * std::cos(at), -radius * std::sin(at), 1.0);
    const double sd = std::sqrt(std::max(0.0, weight.dot(covariance * weight)));
    if (sd > worst.sd_mm) worst = {sd, {weight(0), weight(1), weight(2), 0.0}};
  }
  return worst;
}

WorstOfAxis worked_out(const Scenario& scenario) {
  const StandIn fewer = stand_in(scenario);
  const Bound bound = bound_of(fewer.scenario, surface_of(scenario.part.kind));
  WorstOfAxis worst = scenario.part.kind == virtual_lathe::PartKind::face
                          ? worst_of_face(fewer.scenario, bound)
                          : worst_of_axis(fewer.scenario, bound);
  worst.sd_mm /= std::sqrt(fewer.readings_each);
  return worst;
}

}  // namespace

std::size_t place_of_ends(const Scenario& scenario) {
  if (scenario.part.kind == virtual_lathe::PartKind::face) return 0;  // l, m, d
  const std::vector<Quantity> all = quantities(surface_of(scenario.part.kind));
  const auto at = std::ranges::find(all, "x_at_min_z", &Quantity::name);
  expects(at != all.end(), "a part with an axis");
  return static_cast<std::size_t>(at - all.begin());
}

WorstOfAxis worst_of_axis(const Scenario& scenario, const Bound& bound) {
  const std::size_t count = bound.sd.size(), from = place_of_ends(scenario);
  WorstOfAxis worst;
  for (const std::size_t end : {0, 2}) {  // the variance is convex along the axis
    const auto c = [&](std::size_t i, std::size_t j) {
      return bound.covariance[(from + end + i) * count + from + end + j];
    };
    Eigen::Matrix2d covariance;
    covariance << c(0, 0), c(0, 1), c(1, 0), c(1, 1);
    if (!covariance.allFinite()) return {std::numeric_limits<double>::quiet_NaN(), {}};
    const auto [variances, directions] = linear::spectrum(covariance);
    const double sd = std::sqrt(std::max(0.0, variances(1)));
    if (sd < worst.sd_mm) continue;
    worst = {sd, {}};
    worst.weight[end] = directions(0, 1);
    worst.weight[end + 1] = directions(1, 1);
  }
  return worst;
}

double measuring_time_s(const Scenario& scenario) {
  double time = 0.0;
  for (const PlannedPass& pass : scenario.plan.passes) {
    const double turns = pass.start_mm == pass.end_mm
                             ? pass.revolutions
                             : std::abs(pass.end_mm - pass.start_mm) / pass.feed_mm_per_rev;
    time += pass.pause_s +
            (pass.speed_rpm == 0.0 ? pass.duration_s : turns * 60.0 / std::abs(pass.speed_rpm));
  }
  return time;
}

std::size_t readings_of(const Scenario& scenario) {
  std::size_t count = 0;
  for (const virtual_lathe::TimedPass& pass : virtual_lathe::make_timeline(scenario.plan))
    count += pass.count;
  return count;
}

StandIn stand_in(const Scenario& scenario) {
  StandIn out{scenario, 1.0};
  const auto count = static_cast<double>(readings_of(scenario));
  double share = most_readings / count;
  for (const PlannedPass& pass : scenario.plan.passes) {
    if (pass.speed_rpm != 0.0)
      share = std::max(share, least_per_revolution / pass.readings_per_revolution);
  }
  if (!(share < 1.0) || !is_independent(scenario.noise)) return out;
  for (PlannedPass& pass : out.scenario.plan.passes)
    pass.readings_per_revolution *= share, pass.rate_hz *= share;
  out.readings_each = count / static_cast<double>(readings_of(out.scenario));
  return out;
}

WorstOfAxis AxisBounds::of(const Scenario& scenario) {
  const double sigma_mm = scenario.noise.sigma_mm;
  const bool in_proportion = sigma_mm > 0.0 && is_in_proportion(scenario);
  const double scale = in_proportion ? sigma_mm / sigma_of_reference_mm : 1.0;
  Scenario reference = scenario;
  if (in_proportion) reference.noise.sigma_mm = sigma_of_reference_mm;
  const std::vector<double> key = key_of(reference);
  std::unique_lock lock(one_at_a_time_);
  auto at = known_.find(key);
  if (at == known_.end()) {
    lock.unlock();
    const WorstOfAxis worst = worked_out(reference);
    lock.lock();
    at = known_.emplace(key, worst).first;
  }
  WorstOfAxis worst = at->second;
  worst.sd_mm *= scale;
  return worst;
}

PlannedMeasurement planned(const Scenario& scenario, double coverage_factor, AxisBounds& bounds) {
  PlannedMeasurement out;
  out.scenario = scenario;
  out.readings = readings_of(scenario);
  out.time_s = measuring_time_s(scenario);
  for (const PlannedPass& pass : scenario.plan.passes) {
    const double turning = pass.readings_per_revolution * std::abs(pass.speed_rpm) / 60.0;
    out.rate_hz = std::max(out.rate_hz, pass.speed_rpm == 0.0 ? pass.rate_hz : turning);
  }
  const double u = bounds.of(scenario).sd_mm;
  out.u_expanded_mm =
      u < beyond_linear_mm ? coverage_factor * u : std::numeric_limits<double>::infinity();
  return out;
}

}  // namespace planning_detail

PlannedMeasurement planned(const virtual_lathe::Scenario& scenario, double coverage_factor) {
  planning_detail::AxisBounds bounds;
  return planning_detail::planned(scenario, coverage_factor, bounds);
}

}  // namespace trueaxis::study

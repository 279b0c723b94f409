// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <limits>

#include "job/machine/machine_job_steps.hpp"

namespace trueaxis::machine_job {
namespace {

struct Span {
  double low = 0.0, high = 0.0;
  double length() const { return high - low; }
};

/// Measured and used together, within the limits; of a rotary axis one turn at most.
Span span_of(const AxisRange& range, const MachineAxis& axis) {
  Span span{range.measured_low, range.measured_high};
  if (range.program) {
    span.low = std::min(span.low, (*range.program)[0]);
    span.high = std::max(span.high, (*range.program)[1]);
  }
  if (is_rotary(axis.name) && span.length() > two_pi) span = {0.0, two_pi};
  return {std::max(span.low, axis.low), std::min(span.high, axis.high)};
}

std::vector<double> cell_middles(const Span& span) {
  std::vector<double> middles(map_cells);
  for (std::size_t i = 0; i < map_cells; ++i)
    middles[i] = span.low + span.length() * (static_cast<double>(i) + 0.5) / map_cells;
  return middles;
}

/// The planes without their errors: the first two and the first and third linear axis, and the
/// rotary axes, or the one rotary axis against the first linear one.
std::vector<ErrorMap> planes(const std::vector<AxisRange>& ranges, const Machine& machine) {
  std::vector<std::size_t> linear, rotary;  // indices of ranges, which are those of machine.axes
  AxisPositions middle{};
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    (is_rotary(ranges[i].axis) ? rotary : linear).push_back(i);
    const auto& [low, high] =
        ranges[i].program.value_or(std::array{ranges[i].measured_low, ranges[i].measured_high});
    double& at = middle[index_of(ranges[i].axis)];
    at = 0.5 * (low + high);
    if (is_rotary(ranges[i].axis) && high - low > two_pi) at = std::remainder(at, two_pi);
  }
  const auto by_name = [&](std::size_t a, std::size_t b) {
    return ranges[a].axis < ranges[b].axis;
  };
  std::ranges::sort(linear, by_name);
  std::ranges::sort(rotary, by_name);
  std::vector<std::array<std::size_t, 2>> pairs;
  for (std::size_t i = 1; i < linear.size(); ++i) pairs.push_back({linear[0], linear[i]});
  if (rotary.size() > 1) pairs.push_back({rotary[1], rotary[0]});
  if (rotary.size() == 1 && !linear.empty()) pairs.push_back({rotary[0], linear[0]});
  std::vector<ErrorMap> maps;
  for (const auto& [across, up] : pairs) {
    const Span first = span_of(ranges[across], machine.axes[across]),
               second = span_of(ranges[up], machine.axes[up]);
    if (!(first.length() > 0.0) || !(second.length() > 0.0)) continue;
    ErrorMap map{ranges[across].axis,
                 ranges[up].axis,
                 middle,
                 cell_middles(first),
                 cell_middles(second),
                 {},
                 {}};
    maps.push_back(std::move(map));
  }
  return maps;
}

template <class Each>
void each_cell(const ErrorMap& map, const Setting& setting, const Each& each) {
  Stand stand{map.at, setting};
  for (const double up : map.up_positions)
    for (const double across : map.across_positions) {
      stand.axes[index_of(map.up)] = up;
      stand.axes[index_of(map.across)] = across;
      each(stand);
    }
}

}  // namespace

std::vector<Stand> map_stands(const std::vector<AxisRange>& ranges, const Machine& machine,
                              const Setting& setting) {
  std::vector<Stand> stands;
  for (const ErrorMap& map : planes(ranges, machine))
    each_cell(map, setting, [&](const Stand& stand) { stands.push_back(stand); });
  return stands;
}

std::vector<ErrorMap> error_maps(const MachineModel& model, const std::vector<AxisRange>& ranges,
                                 const Setting& setting, const ProbedTipUncertainty& uncertainty,
                                 const RigidFit::Body& part) {
  std::vector<ErrorMap> maps = planes(ranges, model.machine());
  for (ErrorMap& map : maps)
    each_cell(map, setting, [&](const Stand& stand) {
      const Eigen::Vector3d off = displaced_tip(model, stand.axes, stand);
      map.before_mm.push_back((off - part.at(nominal_tip(model, stand))).norm());
      const CompensatedPosition to = compensate_exactly(model, stand.axes, stand.setting);
      const bool reached =
          to.status == CompensationStatus::compensated || to.status == CompensationStatus::singular;
      map.after_mm.push_back(reached ? to.tip_left_mm + 2.0 * uncertainty.u_mm(stand)
                                     : std::numeric_limits<double>::quiet_NaN());
    });
  return maps;
}

}  // namespace trueaxis::machine_job

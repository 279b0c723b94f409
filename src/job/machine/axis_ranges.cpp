// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "calibrate/estimate/geometry.hpp"
#include "job/machine/machine_job_steps.hpp"

namespace trueaxis::machine_job {
namespace {

constexpr double leeway_share = 0.1, leeway_mm = 1.0, leeway_rad = rad_per_deg;

void widen(double& low, double& high, double value, bool first) {
  low = first ? value : std::min(low, value);
  high = first ? value : std::max(high, value);
}

}  // namespace

std::vector<AxisRange> axis_ranges(const MachineJob& job, const std::vector<ProgramEnd>& ends) {
  std::vector<AxisRange> ranges;
  for (const MachineAxis& axis : job.machine.axes) {
    AxisRange range{axis.name, 0.0, 0.0, {}};
    const std::size_t k = index_of(axis.name);
    bool first = true;
    for (const MachineMeasurement& file : job.data) {
      if (file.kind == MeasurementKind::axis && file.axis != axis.name) continue;
      for (const AxisPositions& at : file.axes) {
        widen(range.measured_low, range.measured_high, at[k], first);
        first = false;
      }
    }
    for (const ProgramEnd& end : ends) {
      if (end.rapid) continue;
      if (!range.program) range.program = {end.commanded[k], end.commanded[k]};
      widen((*range.program)[0], (*range.program)[1], end.commanded[k], false);
    }
    ranges.push_back(range);
  }
  return ranges;
}

bool beyond_measured(const AxisRange& range) {
  if (!range.program) return false;
  const double span = range.measured_high - range.measured_low;
  const bool rotary = is_rotary(range.axis);
  if (rotary && span >= calibrate_detail::whole_turn) return false;
  const double leeway = std::max(leeway_share * span, rotary ? leeway_rad : leeway_mm);
  return (*range.program)[0] < range.measured_low - leeway ||
         (*range.program)[1] > range.measured_high + leeway;
}

}  // namespace trueaxis::machine_job

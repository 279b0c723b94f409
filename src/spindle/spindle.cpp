// SPDX-License-Identifier: Apache-2.0
#include "trueaxis/spindle.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "math/statistics.hpp"
#include "spindle/motion.hpp"
#include "spindle/recording.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis {

double SpindleHarmonic::amplitude_mm() const { return std::hypot(cos_mm, sin_mm); }
double SpindleHarmonic::phase_rad() const { return std::atan2(sin_mm, cos_mm); }
bool SpindleHarmonic::determined() const { return std::isfinite(cos_mm); }

SpindleResult separate_spindle(std::span<const ProbeStream> streams,
                               const SpindleOptions& options) {
  expects(!streams.empty(), "a stream");
  expects(options.order_max >= 2 && options.order_max <= 1000, "orders 2 to 1000 at most");
  std::vector<RunReadings> radial, axial;
  for (RunReadings& run : take_runs(streams))
    (run.axial ? axial : radial).push_back(std::move(run));
  SpindleResult result;
  result.coverage_factor = options.coverage_factor;
  for (const ProbeStream& stream : streams) {
    result.sources.push_back(stream.source);
    result.input_hashes.push_back(stream.input_hash);
  }
  if (!radial.empty()) result.radial = error_motion(std::move(radial), options, result.notes);
  if (!axial.empty()) result.axial = error_motion(std::move(axial), options, result.notes);
  const auto leaves_out = [](const std::optional<ErrorMotion>& motion) {
    return motion && std::ranges::any_of(motion->orders, [](const SeparatedOrder& one) {
             return !one.suppressed.empty();
           });
  };
  if (leaves_out(result.radial) || leaves_out(result.axial))
    result.notes.push_back(
        "the values do not include the suppressed orders and may be larger with them");
  return result;
}

}  // namespace trueaxis

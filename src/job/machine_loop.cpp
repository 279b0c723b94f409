// SPDX-License-Identifier: Apache-2.0
#include "job/machine_loop.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>

#include "job/loop_evidence.hpp"
#include "job/machine_motion.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis {
namespace {

/// What χ² with two degrees of freedom exceeds in 1 of 1000 cases: −2 ln 0.001.
constexpr double chi2_of_two = 13.816;

const EffectParameter& size_of(Influence::Kind kind) {
  const auto effect =
      std::ranges::find(effect_catalogue(), std::optional(kind), &Effect::stated_as);
  expects(effect != effect_catalogue().end(), "a cause that may be stated");
  return effect->parameters.front();
}

/// How much the parts scatter beyond their variances; at least 1.
double scatter_of(const MachineLoop& loop) {
  if (loop.parts < 2) return 1.0;
  return std::max(
      1.0, (chi2_about_mean(loop.gain) + chi2_about_mean(loop.lag)) / (2.0 * (loop.parts - 1)));
}

}  // namespace

LoopPrior loop_prior(double probing_rad_per_s, double cutting_rad_per_s) {
  const double delay_s = typical(size_of(Influence::Kind::probe_delay));
  return {size_of(Influence::Kind::probe_gain).most / refuted_by,
          delay_s * (std::abs(probing_rad_per_s) + std::abs(cutting_rad_per_s))};
}

LoopResponse response_of(const MachineLoop& loop, const LoopPrior& prior) {
  if (loop.parts == 0) return {};
  const double scatter = scatter_of(loop);
  const Shrunk gain = shrunk(loop.gain, scatter, prior.u_gain),
               lag = shrunk(loop.lag, scatter, prior.u_lag_rad);
  return {gain.value, lag.value, gain.u, lag.u, motion_response(loop)};
}

LoopTrouble trouble_with(const MachineLoop& before, const LoopResponse& used,
                         const LoopObservation& seen, const LoopPrior& prior) {
  const double scatter = scatter_of(before);
  const auto variance = [&](double u, double u_known) {
    return scatter * u * u + u_known * u_known;
  };
  const double whole_gain = used.gain + seen.gain, whole_lag = used.lag_rad + seen.lag_rad;
  if (std::abs(whole_gain) > refuted_by * std::sqrt(variance(seen.u_gain, prior.u_gain)) ||
      std::abs(whole_lag) > refuted_by * std::sqrt(variance(seen.u_lag_rad, prior.u_lag_rad)))
    return LoopTrouble::beyond_machines;
  if (before.parts == 0) return LoopTrouble::none;
  const double gain2 = variance(seen.u_gain, used.u_gain),
               lag2 = variance(seen.u_lag_rad, used.u_lag_rad);
  // Along what the table was corrected for: an error that the correction shrinks is less than that.
  const double size = std::hypot(used.gain, used.lag_rad);
  const double along = (used.gain * seen.gain + used.lag_rad * seen.lag_rad) / size;
  const double u_along =
      std::sqrt(used.gain * used.gain * gain2 + used.lag_rad * used.lag_rad * lag2) / size;
  if (size > 0.0 && along - size > refuted_by * u_along) return LoopTrouble::wrong_sign;
  if (seen.gain * seen.gain / gain2 + seen.lag_rad * seen.lag_rad / lag2 > chi2_of_two)
    return LoopTrouble::changed;
  return motion_trouble(used, seen);
}

MachineLoop learned(MachineLoop before, const LoopResponse& used, const LoopObservation& seen) {
  ++before.parts;
  add(before.gain, used.gain + seen.gain, seen.u_gain);
  add(before.lag, used.lag_rad + seen.lag_rad, seen.u_lag_rad);
  learn_motion(before, used, seen);
  return before;
}

AxisCovariance covariance_of(const LoopResponse& loop, const Axis& axis) {
  const std::array<double, 4> along{axis.x_mm, axis.y_mm, axis.slope_x, axis.slope_y},
      across{-axis.y_mm, axis.x_mm, -axis.slope_y, axis.slope_x};
  AxisCovariance out;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j)
      out.by_rows[i * 4 + j] = loop.u_gain * loop.u_gain * along[i] * along[j] +
                               loop.u_lag_rad * loop.u_lag_rad * across[i] * across[j];
  return out;
}

}  // namespace trueaxis

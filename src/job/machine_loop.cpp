// SPDX-License-Identifier: Apache-2.0
#include "job/machine_loop.hpp"

#include <algorithm>
#include <array>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "job/loop_evidence.hpp"
#include "job/machine_motion.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis {
namespace {

/// What a machine that stays the same does in fewer cases contradicts it.
constexpr double improbable = 0.001;

const EffectParameter& size_of(Influence::Kind kind) {
  const auto effect =
      std::ranges::find(effect_catalogue(), std::optional(kind), &Effect::stated_as);
  expects(effect != effect_catalogue().end(), "a cause that may be stated");
  return effect->parameters.front();
}

/// Cuts of a lathe repeat within these, one standard deviation of x and of y in mm: R = 4 s of
/// ISO 230-2 is 0.4 to 12 µm.
constexpr double least_scatter_mm = 1e-4, largest_scatter_mm = 3e-3;
constexpr int steps_of_scatter = 40;

/// What the parts tell if cuts scatter by `scatter_mm`, and how probable that is (Eq. 323).
struct Scattering {
  double scatter_mm, weight;
  Shrunk gain, lag;
};

double log_likelihood(const LoopEvidence& e, const Shrunk& found, double u_prior) {
  return 0.5 * (found.value * found.value / (found.u * found.u) - e.squares) +
         std::log(found.u / u_prior);
}

std::vector<Scattering> scatterings(const MachineLoop& loop, const LoopPrior& prior) {
  std::vector<Scattering> out;
  std::vector<double> log_weight;
  for (int k = 0; k <= steps_of_scatter; ++k) {
    const double scatter_mm =
        least_scatter_mm *
        std::pow(largest_scatter_mm / least_scatter_mm, static_cast<double>(k) / steps_of_scatter);
    LoopEvidence gain, lag;
    double log = 0.0;
    for (const LoopObservation& part : loop.parts) {
      const double own = scatter_mm * part.per_mm;
      const double u_gain = std::hypot(part.u_gain, own), u_lag = std::hypot(part.u_lag_rad, own);
      add(gain, part.gain, u_gain), add(lag, part.lag_rad, u_lag);
      log -= std::log(u_gain) + std::log(u_lag);
    }
    const Shrunk g = shrunk(gain, 1.0, prior.u_gain), l = shrunk(lag, 1.0, prior.u_lag_rad);
    log_weight.push_back(log + log_likelihood(gain, g, prior.u_gain) +
                         log_likelihood(lag, l, prior.u_lag_rad));
    out.push_back({scatter_mm, 0.0, g, l});
  }
  const double most = std::ranges::max(log_weight);
  double sum = 0.0;
  for (std::size_t k = 0; k < out.size(); ++k)
    sum += out[k].weight = std::exp(log_weight[k] - most);
  for (Scattering& one : out) one.weight /= sum;
  return out;
}

/// The mean of a number over the scatters by their weights.
template <typename Number>
double mean(const std::vector<Scattering>& all, const Number& number) {
  double sum = 0.0;
  for (const Scattering& one : all) sum += one.weight * number(one);
  return sum;
}

/// Probability that a normal number is beyond ± value.
double beyond(double value, double u) { return std::erfc(value / u / std::sqrt(2.0)); }

/// The mean of the mixture, and half of what holds as much of it about the mean as 2 u of a normal
/// number: its tails are longer (Eq. 324).
Shrunk mixed(const std::vector<Scattering>& all, Shrunk Scattering::*number) {
  const double value = mean(all, [&](const Scattering& one) { return (one.*number).value; });
  const auto outside = [&](double half) {
    return mean(all, [&](const Scattering& one) {
      const Shrunk& n = one.*number;
      const double off = n.value - value;
      return 0.5 * (beyond(half - off, n.u) + beyond(half + off, n.u));
    });
  };
  double within = 0.0;  // 2 u of each component are, about the mean of all
  for (const Scattering& one : all)
    within = std::max(within, std::abs((one.*number).value - value) + 2.0 * (one.*number).u);
  const double left_out = beyond(2.0, 1.0);
  std::uintmax_t rounds = 100;
  const auto [low, high] = boost::math::tools::toms748_solve(
      [&](double half) { return outside(half) - left_out; }, 0.0, 1.01 * within,
      boost::math::tools::eps_tolerance<double>(40), rounds);
  return {value, 0.25 * (low + high)};
}

}  // namespace

LoopPrior loop_prior(double probing_rad_per_s, double cutting_rad_per_s) {
  const double delay_s = typical(size_of(Influence::Kind::probe_delay));
  return {size_of(Influence::Kind::probe_gain).most / refuted_by,
          delay_s * (std::abs(probing_rad_per_s) + std::abs(cutting_rad_per_s))};
}

LoopResponse response_of(const MachineLoop& loop, const LoopPrior& prior) {
  if (loop.parts.empty()) return {};
  const auto all = scatterings(loop, prior);
  const Shrunk gain = mixed(all, &Scattering::gain), lag = mixed(all, &Scattering::lag);
  const double scatter2 =
      mean(all, [](const Scattering& one) { return one.scatter_mm * one.scatter_mm; });
  return {gain.value, lag.value, gain.u, lag.u, std::sqrt(scatter2), motion_response(loop)};
}

LoopTrouble trouble_with(const MachineLoop& before, const LoopResponse& used,
                         const LoopObservation& seen, const LoopPrior& prior) {
  const auto all = scatterings(before, prior);
  const double whole_gain = used.gain + seen.gain, whole_lag = used.lag_rad + seen.lag_rad;
  // Of the probability that what is known allows as much: by scatter, u of this part with it.
  const auto allowed = [&](const auto& probability) {
    return mean(all, [&](const Scattering& one) {
      const double own = one.scatter_mm * seen.per_mm;
      return probability(one, std::hypot(seen.u_gain, own), std::hypot(seen.u_lag_rad, own));
    });
  };
  const double a_machine = allowed([&](const Scattering&, double u_gain, double u_lag) {
    return std::min(beyond(std::abs(whole_gain), std::hypot(u_gain, prior.u_gain)),
                    beyond(std::abs(whole_lag), std::hypot(u_lag, prior.u_lag_rad)));
  });
  if (a_machine < improbable) return LoopTrouble::beyond_machines;
  if (before.parts.empty()) return LoopTrouble::none;
  // Along what the table was corrected for: an error that the correction shrinks is less than that.
  const double size = std::hypot(used.gain, used.lag_rad);
  const double along = (used.gain * seen.gain + used.lag_rad * seen.lag_rad) / size;
  const double right_sign = allowed([&](const Scattering& one, double u_gain, double u_lag) {
    return beyond(along - size, std::hypot(used.gain * std::hypot(u_gain, one.gain.u),
                                           used.lag_rad * std::hypot(u_lag, one.lag.u)) /
                                    size);
  });
  if (size > 0.0 && right_sign < improbable) return LoopTrouble::wrong_sign;
  const double same = allowed([&](const Scattering& one, double u_gain, double u_lag) {
    const double gain = (whole_gain - one.gain.value) / std::hypot(u_gain, one.gain.u),
                 lag = (whole_lag - one.lag.value) / std::hypot(u_lag, one.lag.u);
    return std::exp(-0.5 * (gain * gain + lag * lag));
  });
  return same < improbable ? LoopTrouble::changed : motion_trouble(used, seen);
}

MachineLoop learned(MachineLoop before, const LoopResponse& used, const LoopObservation& seen) {
  LoopObservation whole = seen;
  whole.gain += used.gain, whole.lag_rad += used.lag_rad, whole.motion.clear();
  before.parts.push_back(std::move(whole));
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
  for (const std::size_t place : {0, 1}) out.by_rows[place * 5] += loop.u_cut_mm * loop.u_cut_mm;
  return out;
}

}  // namespace trueaxis

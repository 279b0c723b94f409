// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/angle.hpp"
#include "job/doubts.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

constexpr double matches = 3.0;       // u: of 1000 that are right 3 are farther
constexpr double of_amplitude = 0.1;  // of a radius whose ball is not stated
constexpr double of_phase = rad_per_deg;

/// What the part off its axis leaves if the sign of the gauge is wrong: the axis comes out
/// opposite, where the circle makes the same wave of two undulations with the other sign.
struct SecondWave {
  double amplitude_mm = 0.0, phase_rad = 0.0;
};

SecondWave wave_of_inverted(const FitResult& fit) {
  const double low = fit.position_min_mm, high = fit.position_max_mm, middle = 0.5 * (low + high);
  const auto squared = [&](double z) {
    const auto [x, y] = fit.axis.axis.at(z);
    return x * x + y * y;
  };
  const auto [x, y] = fit.axis.axis.at(middle);
  const double mean = (squared(low) + 4.0 * squared(middle) + squared(high)) / 6.0;
  const Revolved& shape = fit.shape;
  const double radius = shape.radius_mm + shape.tan_half_angle * (middle - shape.axis.z_ref_mm);
  return {mean / (2.0 * radius), 2.0 * std::atan2(y, x) + 0.5 * two_pi};
}

const FitParameter* named(const Finding& finding, const char* name) {
  const auto found = std::ranges::find(finding.parameters, name, &FitParameter::name);
  return found == finding.parameters.end() ? nullptr : &*found;
}

std::optional<Reason> inverted_of(const ProbeStream& stream, const Diagnosis& diagnosis) {
  const FitResult& fit = diagnosis.baseline;
  const double sum = std::accumulate(stream.reading_mm.begin(), stream.reading_mm.end(), 0.0);
  const bool rear = stream.indication == Indication::absolute && sum < 0.0;
  if (stream.kind == StreamKind::face || rear || !fit.axis_known() || fit.set_ups.size() > 1)
    return {};
  const SecondWave expected = wave_of_inverted(fit);
  for (const Finding& finding : diagnosis.findings) {
    const FitParameter *order = named(finding, "order"), *amplitude = named(finding, "amplitude"),
                       *phase = named(finding, "phase");
    if (order == nullptr || amplitude == nullptr || phase == nullptr) continue;
    const Estimate &a = amplitude->estimate, &p = phase->estimate;
    const double unit = p.unit == "rad" ? 1.0 : rad_per_deg;
    const double off_rad = p.value * unit - expected.phase_rad;
    const double turned_rad = off_rad - two_pi * std::round(off_rad / two_pi);
    if (std::abs(order->estimate.value - 2.0) < 1e-3 &&
        std::abs(a.value - expected.amplitude_mm) <=
            matches * a.u + of_amplitude * expected.amplitude_mm &&
        std::abs(turned_rad) <= matches * p.u * unit + of_phase)
      return Reason{ReasonCode::column_reversed,
                    {},
                    {},
                    {{"column", "X_M"}, {"file", stream.source}},
                    {},
                    {{ReasonCode::turn_sign, {}, {}, {{"column", "X_M"}}}}};
  }
  return {};
}

constexpr Threshold of_wave[] = {
    {"two_undulations", matches, "of its u", "of 1000 that match 3 are farther"}};

}  // namespace

constinit const AxisDoubt gauge_inverted{"gauge_inverted", of_wave, inverted_of};

}  // namespace trueaxis

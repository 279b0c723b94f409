// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <vector>

#include "job/doubts.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

constexpr double matches = 3.0;       // u: of 1000 that are right 3 are farther
constexpr double seen = 5.0;          // u: what is nearer to nothing may be noise
constexpr double of_amplitude = 0.1;  // of the wave: a ball that is not stated
constexpr double of_phase = 0.05;     // of the wave, across it: 1.4° of an axis
constexpr double own_motions = 0.05;  // of two undulations that match at random

/// What the part off its axis leaves if the sign of the gauge is wrong: the axis comes out
/// opposite, where the circle makes the same wave of two undulations with the other sign. In one
/// reading, and the same a quarter of a wave on.
struct SecondWave {
  double along_mm = 0.0, across_mm = 0.0;
};

SecondWave wave_of_inverted(const FitResult& fit, double c_rad, double z_mm) {
  const auto [x, y] = fit.axis.axis.at(z_mm);
  const Revolved& shape = fit.shape;
  const double radius = shape.radius_mm + shape.tan_half_angle * (z_mm - shape.axis.z_ref_mm);
  const double amplitude = -(x * x + y * y) / (2.0 * radius);
  const double angle = 2.0 * (c_rad - std::atan2(y, x));
  return {amplitude * std::cos(angle), amplitude * std::sin(angle)};
}

/// The share of motions of two undulations, in any direction, that match to this width along the
/// wave and across it: at most the area at the greatest density, 1/(π e), that normal motions of
/// any size have at the wave.
double matching_at_random(double along, double across) {
  return 4.0 * along * across / (std::numbers::pi * std::numbers::e);
}

/// Whether the ideal fit leaves that wave, and nothing across it. After a slip it leaves much else.
bool leaves_wave(const ProbeStream& stream, const Diagnosis& diagnosis) {
  const std::vector<double>& left_mm = diagnosis.residual_before_mm;
  if (left_mm.size() != stream.size() || diagnosis.slip()) return false;
  std::vector<bool> masked(stream.size(), false);
  for (const Rejected& one : diagnosis.noise.masked)
    if (one.row >= 1 && one.row <= masked.size()) masked[one.row - 1] = true;
  double along2 = 0.0, across2 = 0.0, along = 0.0, across = 0.0, left2 = 0.0, count = 0.0;
  for (std::size_t i = 0; i < stream.size(); ++i) {
    if (masked[i] || !std::isfinite(left_mm[i])) continue;
    const SecondWave wave = wave_of_inverted(diagnosis.baseline, stream.c_rad[i],
                                             stream.has_position() ? stream.position_mm[i] : 0.0);
    along2 += wave.along_mm * wave.along_mm, across2 += wave.across_mm * wave.across_mm;
    along += wave.along_mm * left_mm[i], across += wave.across_mm * left_mm[i];
    left2 += left_mm[i] * left_mm[i], count += 1.0;
  }
  if (!(along2 > 0.0 && across2 > 0.0)) return false;
  const double share = along / along2, beside = across / across2;
  const double u = std::sqrt(left2 / count / std::min(along2, across2));
  const double to_along = matches * u + of_amplitude, to_across = matches * u + of_phase;
  return share > seen * u && matching_at_random(to_along, to_across) <= own_motions &&
         std::abs(share - 1.0) <= to_along && std::abs(beside) <= to_across;
}

std::optional<Reason> inverted_of(const ProbeStream& stream, const Diagnosis& diagnosis) {
  const FitResult& fit = diagnosis.baseline;
  const double sum = std::accumulate(stream.reading_mm.begin(), stream.reading_mm.end(), 0.0);
  const bool rear = stream.indication == Indication::absolute && sum < 0.0;
  if (stream.kind == StreamKind::face || rear || !fit.axis_known() || fit.set_ups.size() > 1)
    return {};
  if (!leaves_wave(stream, diagnosis)) return {};
  // Turned, a position would be one of the rear side, and the axis a mirrored one.
  const Reason remedy = stream.indication == Indication::relative
                            ? Reason{ReasonCode::turn_sign, {}, {}, {{"column", "X_M"}}}
                            : Reason{ReasonCode::probe_again};
  return Reason{ReasonCode::column_reversed,
                {},
                {},
                {{"column", "X_M"}, {"file", stream.source}},
                {},
                {remedy}};
}

constexpr Threshold of_wave[] = {
    {"two_undulations", matches, "of its u", "of 1000 that match 3 are farther"},
    {"seen", seen, "of its u", "what is nearer to nothing may be noise"},
    {"own_motions", own_motions, "of motions of two undulations",
     "of 20 that are the part's own, of the likeliest size, one matches"}};

}  // namespace

constinit const AxisDoubt gauge_inverted{"gauge_inverted", of_wave, inverted_of};

}  // namespace trueaxis

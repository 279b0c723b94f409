// SPDX-License-Identifier: Apache-2.0
#include "live/live_state.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "fit/moved.hpp"
#include "math/statistics.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

constexpr std::size_t most_used = 20000;  // a fit of them takes some 10 ms
constexpr double least_slip = 0.25;  // of the noise of a reading: a long stream's U is far less

void add_picture(LiveState& state, const ProbeStream& stream) {
  std::array<double, LiveState::bins> sum{}, count{};
  for (std::size_t i = 0; i < state.fit.residual_mm.size(); ++i) {
    const double turns = stream.c_rad[i] / two_pi, share = turns - std::floor(turns);
    const auto bin =
        std::min(static_cast<std::size_t>(share * LiveState::bins), LiveState::bins - 1);
    sum[bin] += state.fit.residual_mm[i];
    count[bin] += 1.0;
  }
  for (std::size_t bin = 0; bin < LiveState::bins; ++bin)
    state.left_mm[bin] = sum[bin] / count[bin];  // 0/0 without a reading
}

/// Readings less what the fit reads, about their median: a ball's radius is a constant.
std::vector<double> left_of(const ProbeStream& stream, const IdealReading& ideal) {
  std::vector<double> left = stream.reading_mm;
  for (std::size_t i = 0; i < left.size(); ++i)
    left[i] -= ideal(stream.c_rad[i], stream.has_position() ? stream.position_mm[i] : 0.0);
  const double middle = median(left);
  for (double& one : left) one -= middle;
  return left;
}

}  // namespace

IdealReading ideal_reading(const FitResult& fit) {
  const bool revolved = fit.surface == SurfaceKind::cone || fit.surface == SurfaceKind::cylinder ||
                        fit.surface == SurfaceKind::section;
  if (!revolved || !fit.axis_known()) return {};
  return [shape = fit.shape, side = fit.set_ups.back().side](double c_rad, double z_mm) {
    const Intersection at = intersect(shape, c_rad, z_mm, 0.0, side);
    return at.hit ? at.x_mm : 0.0;
  };
}

bool probe_is_deaf(const ProbeStream& stream, const FitResult& fit, double noise_mm) {
  if (!fit.axis_known()) return false;
  std::vector<double> read, wanted;
  std::size_t i = stream.size();
  const double c_end = stream.c_rad.back();
  while (i > 0 && std::abs(c_end - stream.c_rad[i - 1]) < 0.5 * two_pi) {
    --i;
    const double z = stream.has_position() ? stream.position_mm[i] : 0.0;
    const auto [x, y] = fit.axis.axis.at(z);
    read.push_back(stream.reading_mm[i]);
    wanted.push_back(x * std::cos(stream.c_rad[i]) + y * std::sin(stream.c_rad[i]) +
                     fit.shape.tan_half_angle * z);
  }
  if (i == 0) return false;
  const double moves = range_of(wanted).length();
  return moves > 10.0 * noise_mm && range_of(read).length() < 0.25 * moves;
}

LiveState live_state(const LiveStream& stream, const FitOptions& options, const FitResult& before,
                     std::size_t look) {
  LiveState state;
  const ProbeStream sample = stream.sample(most_used);
  state.readings = stream.readings();
  state.used = sample.size();
  state.stride = stream.stride();
  state.turns = stream.turns();
  state.fit = fit(sample, options);
  state.U_mm =
      state.fit.axis_known() ? U_of_axis_mm(state.fit) : std::numeric_limits<double>::infinity();
  add_picture(state, sample);
  // Means show a slip late: the latest readings show it at once.
  const IdealReading ideal = stream.averages() ? ideal_reading(state.fit) : IdealReading();
  const ProbeStream latest = ideal ? stream.recent(most_used) : sample;
  const std::vector<double> left_mm = ideal ? left_of(latest, ideal) : state.fit.residual_mm;
  // All looks together see a slip in noise once in 1000 streams: 1/2 + 1/6 + 1/12 … is 1.
  const auto looks = static_cast<double>(look);
  state.moved = moved_in_pass(latest, left_mm, state.fit, 1e-3 / (looks * (looks + 1.0)));
  if (state.moved && state.moved->size_mm < least_slip * mad_sigma(left_mm)) state.moved.reset();
  const FitResult& known = before.axis_known() ? before : state.fit;
  state.deaf = probe_is_deaf(stream.last(LiveStream::most_recent), known,
                             mad_sigma(ideal ? left_mm : known.residual_mm));
  return state;
}

}  // namespace trueaxis

// SPDX-License-Identifier: Apache-2.0
#include "diagnose/search/scan_list.hpp"

#include <algorithm>
#include <cmath>

#include "diagnose/search/causes.hpp"
#include "diagnose/search/scan.hpp"
#include "math/statistics.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis::diagnose_detail {
namespace {

constexpr double shortest_mm = 1.0;  // of a length that a wave along Z is seen over
constexpr double fewest_turns = 2.5;
constexpr double fewest_cycles = 0.75;  // fewer are a slope and a curvature, and no line
constexpr double most_cycles = 250.0;   // of a pattern: what 500 means of a long stream resolve

/// From the first reading of a pass to its last.
double travel(const LinearisationPoint& point, PointColumn x, const Pass& pass) {
  return point.at(x, pass.end - 1) - point.at(x, pass.begin);
}

/// Steps of an abscissa within passes: the median is its sampling, for the highest line seen.
double sampling(const LinearisationPoint& point, PointColumn x) {
  double finest = 0.0;
  for (const Pass& pass : point.passes) {
    if (pass.end - pass.begin < 8) continue;
    const double step =
        std::abs(travel(point, x, pass)) / static_cast<double>(pass.end - pass.begin - 1);
    if (step > 0.0 && (finest == 0.0 || step < finest)) finest = step;
  }
  return finest;
}

/// What a stream lets be seen of the lines in one variable.
struct Sampled {
  bool seen = false;
  double extent = 1.0;     ///< cycles are counted over
  double highest = 1e300;  ///< frequency that the sampling tells
  bool another = true;     ///< no other scan has the same lines
};

Sampled sampled(SpectralLine::In in, const LinearisationPoint& point,
                const Resolution& resolution) {
  Sampled out;
  if (resolution.sections && in != SpectralLine::In::time) return out;  // Z stands still
  const bool several = !resolution.one_variable;
  if (in == SpectralLine::In::angle) {
    const double step = sampling(point, &PointPart::c) / two_pi;
    return {resolution.turns > fewest_turns && step > 0.0, resolution.turns, 0.5 / step};
  }
  if (in == SpectralLine::In::time) {
    const double step = point.has_time ? sampling(point, &PointPart::time) : 0.0;
    return {step > 0.0, range_of(point.time).length(), 0.5 / step, several};
  }
  if (in == SpectralLine::In::sensed) {
    const double swing = point.swing_mm;
    return {swing > least_swing_mm, swing, static_cast<double>(point.size()) / (3.0 * swing)};
  }
  out.extent = point.has_position ? point.range(&PointPart::s).length() : 0.0;
  out.seen = out.extent > shortest_mm;
  // A spiral that is finer than the sampling is seen as another, and as none else.
  if (in != SpectralLine::In::spiral) out.highest = 0.5 / sampling(point, &PointPart::s);
  out.another = in == SpectralLine::In::slide ? point.shifted : several;
  return out;
}

Scan scan_of(const Effect& effect, const Sampled& of, const LinearisationPoint& point) {
  const SpectralLine& line = *effect.line;
  const double unit = line.in == SpectralLine::In::angle ? two_pi : 1.0;
  Scan scan;
  scan.x = column_of(line.in);
  scan.low = std::max(line.low, line.least_cycles / of.extent) / unit;
  scan.high = std::min(line.high, of.highest) / unit;
  scan.make = [&effect, &point](double f) {
    return at_frequency(of_effect(effect, typical_shape(effect, point)), f);
  };
  if (const auto* along = std::get_if<PeriodicInZ>(&effect.term)) {
    scan.turns = along->turns;
    scan.form = along->port != TermPort::x;  // ∂X/∂Z too is of the other sign
  }
  scan.counts = of.another;
  return scan;
}

/// Half a cycle in a turn: what turns faster along x is, pass by pass, nearer to another order.
double half_a_cycle(const LinearisationPoint& point, PointColumn x) {
  double most = 0.0;
  for (const Pass& pass : point.passes) {
    const double turns = std::abs(point.c[pass.end - 1] - point.c[pass.begin]) / two_pi;
    const double along = std::abs(travel(point, x, pass));
    if (turns > fewest_turns && along > 0.0) most = std::max(most, 0.5 * turns / along);
  }
  return most;
}

/// Lines of an order n, either way round, from few cycles up to half a cycle in a turn.
void add_patterns(const LinearisationPoint& point, const Sampled& of, bool in_time, bool counts,
                  int harmonics, std::vector<Scan>& list) {
  const PointColumn x = in_time ? &PointPart::time : &PointPart::s;
  const double low = fewest_cycles / of.extent,
               high = std::max((in_time ? 30.0 : 20.0) / of.extent,
                               std::min(half_a_cycle(point, x), most_cycles / of.extent));
  for (int n = 1; n <= harmonics; ++n) {
    for (const double sign : {1.0, -1.0}) {
      list.push_back({x, sign * n, in_time, low, high,
                      [=](double f) { return pattern_line(n, in_time, sign * f); }, true, !in_time,
                      counts});
    }
  }
}

}  // namespace

Hypothesis pattern_line(double order, bool in_time, double frequency) {
  Hypothesis h;
  h.pattern = {.kind = Pattern::Kind::line,
               .order = order,
               .spindle = in_time,
               .in_time = in_time,
               .frequency = frequency};
  return h;
}

PointColumn column_of(SpectralLine::In in) {
  switch (in) {
    case SpectralLine::In::angle:
      return &PointPart::c;
    case SpectralLine::In::time:
      return &PointPart::time;
    case SpectralLine::In::slide:
      return &PointPart::z;
    case SpectralLine::In::sensed:
      return &PointPart::sensed;
    case SpectralLine::In::length:
    case SpectralLine::In::spiral:
      break;
  }
  return &PointPart::s;
}

Extent slow_lines(const Problem& problem, SpectralLine::In in) {
  const LinearisationPoint& point = problem.whole ? problem.whole->point : problem.point;
  if (!problem.resolution.one_variable || in == SpectralLine::In::sensed) return {0.0, 0.0};
  const Pass& pass =
      *std::ranges::max_element(point.passes, {}, [](const Pass& p) { return p.end - p.begin; });
  const double turns = travel(point, &PointPart::c, pass) / two_pi;
  const double along = travel(point, column_of(in), pass);
  const bool other_way = in == SpectralLine::In::spiral && turns * along < 0.0;
  if (other_way || turns == 0.0 || along == 0.0) return {0.0, 0.0};
  const double once_a_turn = std::abs(turns / along),
               slow = problem.fewest_cycles / std::abs(along);
  return {once_a_turn - slow, once_a_turn + slow};
}

std::vector<Scan> scans_of(const Problem& problem) {
  using enum SpectralLine::In;
  const LinearisationPoint& point = problem.whole ? problem.whole->point : problem.point;
  const Resolution& resolution = problem.resolution;
  std::vector<Scan> list;
  for (const SpectralLine::In in : {angle, time, length, slide, spiral, sensed}) {
    const Sampled of = sampled(in, point, resolution);
    for (const Effect* effect : problem.effects) {
      if (!of.seen || !effect->line || effect->line->in != in) continue;
      if (effect->needs.cone && !point.base.face &&
          !(std::abs(point.tan_half_angle) > least_tangent))
        continue;
      list.push_back(scan_of(*effect, of, point));
      list.back().left_out = slow_lines(problem, in);
    }
    // If there is one variable, the lines of C are these too.
    const bool same = resolution.one_variable && !list.empty() && list[0].x == &PointPart::c;
    if (in == spiral && of.seen && !same)
      add_patterns(point, of, false, of.another, resolution.harmonics, list);
  }
  const Sampled of = sampled(time, point, resolution);
  if (of.seen && of.another && !resolution.sections)
    add_patterns(point, of, true, true, resolution.harmonics, list);
  std::erase_if(list, [](const Scan& s) { return !(s.high > s.low); });
  return list;
}

}  // namespace trueaxis::diagnose_detail

// SPDX-License-Identifier: Apache-2.0
#include "diagnose/search/scan.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>

#include "diagnose/search/causes.hpp"
#include "math/fourier_sums.hpp"
#include "math/sincos.hpp"
#include "math/statistics.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis::diagnose_detail {
namespace {

using Column = std::vector<double>;

constexpr double oversampling = 2.5;  // bins a resolution cell: at most 5 % of a peak is missed
constexpr std::size_t peaks_kept = 2, fringes_kept = 5;
constexpr double finer = 4.0;
constexpr double tenth_lost = 0.25;  // cycles a mean: sinc(0.25) = 0.90
constexpr double shortest_mm = 1.0;  // of a length that a wave along Z is seen over
constexpr double fewest_turns = 2.5;

/// One scan: cos, sin (2π f x − turns θ).
struct Scan {
  const Column* x = nullptr;
  double turns = 0.0;
  bool spindle = false;  ///< turns are of C
  double low = 0.0, high = 0.0;
  std::function<Hypothesis(double)> make;
  bool pattern = false;
  bool form = false;    ///< along the surface's normal: of the other sign at the rear
  bool counts = true;   ///< false: the same lines as another scan
  double fast = 1e300;  ///< times the readings of a mean: lines above are weakened by 10 %
};

double variance(const Column& x) {
  double mean = 0.0, sum = 0.0;
  for (const double v : x) mean += v;
  mean /= static_cast<double>(x.size());
  for (const double v : x) sum += (v - mean) * (v - mean);
  return sum / static_cast<double>(x.size());
}

Hypothesis pattern_line(double order, bool in_time, double frequency) {
  Hypothesis h;
  h.pattern = {.kind = Pattern::Kind::line,
               .order = order,
               .spindle = in_time,
               .in_time = in_time,
               .frequency = frequency};
  return h;
}

/// Steps of an abscissa within passes: the median is its sampling, for the highest line seen.
double sampling(const LinearisationPoint& point, const Column& x) {
  double finest = 0.0;
  for (const Pass& pass : point.passes) {
    if (pass.end - pass.begin < 8) continue;
    const double step =
        std::abs(x[pass.end - 1] - x[pass.begin]) / static_cast<double>(pass.end - pass.begin - 1);
    if (step > 0.0 && (finest == 0.0 || step < finest)) finest = step;
  }
  return finest;
}

const Column& column_of(Line::In in, const LinearisationPoint& point) {
  switch (in) {
    case Line::In::angle:
      return point.c;
    case Line::In::time:
      return point.time;
    case Line::In::slide:
      return point.z;
    case Line::In::sensed:
      return point.sensed;
    case Line::In::length:
    case Line::In::spiral:
      break;
  }
  return point.s;
}

/// What a stream lets be seen of the lines in one variable.
struct Sampled {
  bool seen = false;
  double extent = 1.0;     ///< cycles are counted over
  double highest = 1e300;  ///< frequency that the sampling tells
  double fast = 1e300;     ///< see Scan
  bool another = true;     ///< no other scan has the same lines
};

Sampled sampled(Line::In in, const LinearisationPoint& point, const Resolution& resolution) {
  Sampled out;
  if (resolution.sections) return out;
  const bool several = !resolution.one_variable;
  if (in == Line::In::angle) {
    const double step = sampling(point, point.c) / two_pi;
    return {resolution.turns > fewest_turns && step > 0.0, resolution.turns, 0.5 / step};
  }
  if (in == Line::In::time) {
    const double step = point.has_time ? sampling(point, point.time) : 0.0;
    return {step > 0.0, range_of(point.time).length(), 0.5 / step, tenth_lost / step, several};
  }
  if (in == Line::In::sensed) {
    const double swing = sensed_swing(point);
    double fastest = 1e-9;
    for (std::size_t i = 1; i < point.size(); ++i) {
      if (point.rear[i] == point.rear[i - 1])
        fastest = std::max(fastest, std::abs(point.sensed[i] - point.sensed[i - 1]));
    }
    return {swing > least_swing_mm, swing, static_cast<double>(point.size()) / (3.0 * swing),
            tenth_lost / fastest};
  }
  out.extent = point.has_position ? range_of(point.s).length() : 0.0;
  out.seen = out.extent > shortest_mm;
  // A spiral that is finer than the sampling is seen as another, and as none else.
  if (in != Line::In::spiral) out.highest = 0.5 / sampling(point, point.s);
  out.another = in == Line::In::slide ? point.shifted : several;
  return out;
}

Scan scan_of(const Effect& effect, const Sampled& of, const LinearisationPoint& point) {
  const Line& line = *effect.line;
  const double unit = line.in == Line::In::angle ? two_pi : 1.0;
  Scan scan;
  scan.x = &column_of(line.in, point);
  scan.low = std::max(line.low, line.least_cycles / of.extent) / unit;
  scan.high = std::min(line.high, of.highest) / unit;
  scan.make = [&effect, &point](double f) {
    return at_frequency(of_effect(effect, typical_shape(effect, point)), f);
  };
  if (const auto* along = std::get_if<PeriodicInZ>(&effect.term)) {
    scan.turns = along->turns;
    scan.form = along->port != Port::x;  // ∂X/∂Z too is of the other sign
  }
  scan.counts = of.another;
  scan.fast = of.fast;
  return scan;
}

/// Half a cycle in a turn: what turns faster along x is, pass by pass, nearer to another order.
double half_a_cycle(const LinearisationPoint& point, const Column& x) {
  double most = 0.0;
  for (const Pass& pass : point.passes) {
    const double turns = std::abs(point.c[pass.end - 1] - point.c[pass.begin]) / two_pi;
    const double along = std::abs(x[pass.end - 1] - x[pass.begin]);
    if (turns > fewest_turns && along > 0.0) most = std::max(most, 0.5 * turns / along);
  }
  return most;
}

/// Of an order n either way round, of few cycles and more up to half a cycle in a turn.
void add_patterns(const LinearisationPoint& point, const Sampled& of, bool in_time, bool counts,
                  int harmonics, std::vector<Scan>& list) {
  const Column& x = in_time ? point.time : point.s;
  const double low = 0.75 / of.extent;
  const double high = std::max((in_time ? 30.0 : 20.0) / of.extent, half_a_cycle(point, x));
  for (int n = 1; n <= harmonics; ++n) {
    for (const double sign : {1.0, -1.0}) {
      list.push_back({&x, sign * n, in_time, low, high,
                      [=](double f) { return pattern_line(n, in_time, sign * f); }, true, !in_time,
                      counts});
    }
  }
}

std::vector<Scan> scans_of(const Problem& problem) {
  using enum Line::In;
  const LinearisationPoint& point = problem.point;
  const Resolution& resolution = problem.resolution;
  std::vector<Scan> list;
  for (const Line::In in : {angle, time, length, slide, spiral, sensed}) {
    const Sampled of = sampled(in, point, resolution);
    for (const Effect* effect : problem.effects) {
      if (!of.seen || !effect->line || effect->line->in != in) continue;
      if (effect->needs.cone && !point.base.face &&
          !(std::abs(point.tan_half_angle) > least_tangent))
        continue;
      list.push_back(scan_of(*effect, of, point));
    }
    // Of one variable, the lines of C are these too.
    const bool same = resolution.one_variable && !list.empty() && list[0].x == &point.c;
    if (in == spiral && of.seen && !same)
      add_patterns(point, of, false, of.another, resolution.harmonics, list);
  }
  if (const Sampled of = sampled(time, point, resolution); of.seen && of.another)
    add_patterns(point, of, true, true, resolution.harmonics, list);
  std::erase_if(list, [](const Scan& s) { return !(s.high > s.low); });
  return list;
}

/// ½ Σ |A|² over the passes: the square of a whitened line's columns, A the transfer of the filter
/// at the line's angle from reading to reading.
double line_norm2(const NormalEquations& equations, const std::vector<double>& used_of_pass,
                  const std::vector<double>& x_step, const std::vector<double>& turn_step,
                  double frequency, double turns) {
  const auto& phi = equations.autoregression();
  double sum = 0.0;
  for (std::size_t p = 0; p < used_of_pass.size(); ++p) {
    const double angle = two_pi * frequency * x_step[p] - turns * turn_step[p];
    std::complex<double> transfer = 1.0;
    for (std::size_t j = 0; j < phi.size(); ++j)
      transfer -= phi[j] * std::polar(1.0, -angle * static_cast<double>(j + 1));
    sum += 0.5 * used_of_pass[p] * std::norm(transfer);
  }
  return sum;
}

/// Sums of one scan over g cos nθ and g sin nθ, from which those of +n and −n are made.
struct TurnedSums {
  double order = 0.0;
  FourierSums::Sums cosine, sine;
};

TurnedSums turned_sums(const FourierSums& plan, double order, const Column& angle,
                       const Column& g) {
  Column phase(g.size()), sine(g.size()), cosine(g.size());
  for (std::size_t i = 0; i < g.size(); ++i) phase[i] = order * angle[i];
  sincos(phase, sine, cosine);
  for (std::size_t i = 0; i < g.size(); ++i) cosine[i] *= g[i], sine[i] *= g[i];
  const std::span<const double> both[] = {cosine, sine};
  std::vector<FourierSums::Sums> sums = plan.of(both);
  return {order, std::move(sums[0]), std::move(sums[1])};
}

/// Of a single pass at constant feed a line of C is also one of an order along Z.
void pattern_of_line(const LinearisationPoint& point, const Resolution& resolution,
                     const Peak& line, Scans& out) {
  const Pass& pass =
      *std::ranges::max_element(point.passes, {}, [](const Pass& p) { return p.end - p.begin; });
  const double turns = (point.c[pass.end - 1] - point.c[pass.begin]) / two_pi;
  const double lead = (point.s[pass.end - 1] - point.s[pass.begin]) / turns;  // a turn of +C
  const double order = std::round(line.frequency * two_pi);
  const double frequency = (order - line.frequency * two_pi) / lead;
  if (order < 1.0 || order > resolution.harmonics || !(std::abs(frequency * lead * turns) > 0.75))
    return;
  out.patterns.push_back({pattern_line(order, false, frequency), line.gain,
                          line.step * two_pi / std::abs(lead), std::abs(frequency)});
}

}  // namespace

std::vector<double> weighted(const NormalEquations& equations,
                             std::span<const double> remainder_mm) {
  const auto& phi = equations.autoregression();
  const ObservationMask& mask = equations.mask();
  const std::size_t n = remainder_mm.size(), p = phi.size();
  std::vector<double> white(n, 0.0), out(n, 0.0);
  for (std::size_t i = 0; i < n; ++i) {
    if (!mask.used[i] || mask.run[i] < p) continue;
    white[i] = remainder_mm[i];
    for (std::size_t j = 0; j < p; ++j) white[i] -= phi[j] * remainder_mm[i - j - 1];
  }
  for (std::size_t i = 0; i < n; ++i) {
    out[i] += white[i];
    for (std::size_t j = 0; j < p; ++j)
      if (white[i] != 0.0) out[i - j - 1] -= phi[j] * white[i];
  }
  return out;
}

Scans scan_lines(const Problem& problem, const NormalEquations& equations,
                 std::span<const double> remainder_mm, std::size_t means) {
  const LinearisationPoint& point = problem.point;
  const ObservationMask& mask = problem.mask;
  const std::vector<double> plain = weighted(equations, remainder_mm);
  std::vector<double> outward = plain;  // of what lies along the normal
  for (std::size_t i = 0; i < outward.size(); ++i)
    if (point.rear[i]) outward[i] = -outward[i];
  std::vector<double> used_of_pass;
  for (const Pass& pass : point.passes) {
    double used = 0.0;
    for (std::size_t i = pass.begin; i < pass.end; ++i)
      used += mask.used[i] && mask.run[i] >= equations.autoregression().size();
    used_of_pass.push_back(used);
  }
  const auto steps = [&](const Column& x) {
    std::vector<double> out;
    for (const Pass& pass : point.passes)
      out.push_back(pass.end - pass.begin > 1 ? (x[pass.end - 1] - x[pass.begin]) /
                                                    static_cast<double>(pass.end - pass.begin - 1)
                                              : 0.0);
    return out;
  };
  const std::vector<double> c_step = steps(point.c);

  Scans out;
  const Column* planned = nullptr;
  double planned_low = 0.0, planned_high = 0.0;
  std::unique_ptr<FourierSums> plan;
  TurnedSums turned;
  std::size_t bins = 0;
  double df = 0.0;
  bool fringes = false;
  std::vector<Scan> list = scans_of(problem);
  if (means > 1) {
    for (Scan& scan : list) scan.low = std::max(scan.low, scan.fast / static_cast<double>(means));
    std::erase_if(list, [](const Scan& s) { return !(s.high > s.low); });
  }
  for (const Scan& scan : list) {
    const auto [x_low, x_high] = range_of(*scan.x);
    if (!plan || planned != scan.x || planned_low != scan.low || planned_high != scan.high) {
      // From both sides a period of the scale makes fringes, told apart only by a fine scan.
      fringes = scan.x == &point.sensed && point.two_sided;
      df = 1.0 / ((fringes ? finer : 1.0) * oversampling * (x_high - x_low));
      bins = static_cast<std::size_t>((scan.high - scan.low) / df) + 1;
      plan = std::make_unique<FourierSums>(*scan.x, two_pi * scan.low, two_pi * df, bins);
      planned = scan.x, planned_low = scan.low, planned_high = scan.high;
      turned = {};
    }
    const std::vector<double>& g = scan.form ? outward : plain;
    const std::vector<double> x_step = steps(*scan.x);
    std::vector<std::complex<double>> sums;
    if (scan.turns == 0.0) {
      sums = plan->of(g);
    } else {
      const double n = std::abs(scan.turns);
      if (turned.order != n)
        turned = turned_sums(*plan, n, scan.spindle ? point.c : point.theta, g);
      // Σ g exp(−i(2πfx − turns θ))
      sums = turned.cosine;
      const std::complex<double> turn(0.0, scan.turns > 0.0 ? 1.0 : -1.0);
      for (std::size_t k = 0; k < bins; ++k) sums[k] += turn * turned.sine[k];
    }
    std::vector<double> gain(bins);
    const bool white = equations.autoregression().empty();
    const double flat = line_norm2(equations, used_of_pass, x_step, c_step, scan.low, scan.turns);
    for (std::size_t k = 0; k < bins; ++k) {
      const double f = scan.low + df * static_cast<double>(k);
      const double norm2 =
          white ? flat : line_norm2(equations, used_of_pass, x_step, c_step, f, scan.turns);
      gain[k] = std::norm(sums[k]) / norm2;  // of cos and of sin: norm2 each
    }
    for (std::size_t taken = 0; taken < (fringes ? fringes_kept : peaks_kept); ++taken) {
      const auto top = std::ranges::max_element(gain);
      if (!(*top > 0.0)) break;
      const auto k = static_cast<std::size_t>(top - gain.begin());
      const double f = scan.low + df * static_cast<double>(k);
      Peak peak{scan.make(f), *top, df, f};
      if (problem.resolution.one_variable && scan.x == &point.c)
        pattern_of_line(point, problem.resolution, peak, out);
      (scan.pattern ? out.patterns : out.causes).push_back(std::move(peak));
      const std::size_t near = static_cast<std::size_t>(2.0 * oversampling);
      std::fill(gain.begin() + static_cast<long>(k - std::min(k, near)),
                gain.begin() + static_cast<long>(std::min(bins, k + near + 1)), 0.0);
    }
    if (scan.counts)
      out.bandwidth += (scan.high - scan.low) * std::sqrt(2.0 * two_pi * variance(*scan.x));
  }
  return out;
}

bool is_line(const Hypothesis& h) {
  return h.effect ? h.effect->line.has_value() : h.pattern.kind == Pattern::Kind::line;
}

const std::vector<double>& variable_of(const Hypothesis& line, const LinearisationPoint& point) {
  if (!line.effect) return line.pattern.in_time ? point.time : point.s;
  return column_of(line.effect->line->in, point);
}

Hypothesis at_frequency(const Hypothesis& hypothesis, double frequency) {
  Hypothesis h = hypothesis;
  if (!h.effect) {
    h.pattern.frequency = std::copysign(frequency, h.pattern.frequency);
  } else if (h.effect->line->in == Line::In::angle) {
    h.shape.order = frequency * two_pi;
  } else if (h.effect->line->in == Line::In::time) {
    h.shape.frequency_hz = frequency;
  } else {
    h.shape.period_mm = 1.0 / frequency;
  }
  return h;
}

double frequency_of(const Hypothesis& h) {
  if (!h.effect) return std::abs(h.pattern.frequency);
  if (h.effect->line->in == Line::In::angle) return h.shape.order / two_pi;
  if (h.effect->line->in == Line::In::time) return h.shape.frequency_hz;
  return 1.0 / h.shape.period_mm;
}

}  // namespace trueaxis::diagnose_detail

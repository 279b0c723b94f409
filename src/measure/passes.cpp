// SPDX-License-Identifier: Apache-2.0
#include "measure/passes.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "measure/passes_motion.hpp"
#include "trueaxis/error.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

// If a pass column cuts, its net travel gives the senses, if it is more than this.
constexpr double least_turn_rad = 1e-3 * two_pi;
constexpr double least_feed_mm = 5e-3;

int sign_of(double travel, double least) { return travel > least ? 1 : travel < -least ? -1 : 0; }

/// Slope of the position over C by least squares.
double slope_mm_per_rad(const ProbeStream& stream, const Pass& pass) {
  const double c0 = stream.c_rad[pass.begin], z0 = stream.position_mm[pass.begin];
  const double n = static_cast<double>(pass.end - pass.begin);
  double sc = 0.0, sz = 0.0, scc = 0.0, scz = 0.0;
  for (std::size_t i = pass.begin; i < pass.end; ++i) {
    const double c = stream.c_rad[i] - c0, z = stream.position_mm[i] - z0;
    sc += c;
    sz += z;
    scc += c * c;
    scz += c * z;
  }
  const double spread = scc - sc * sc / n;
  return spread > 0.0 ? (scz - sc * sz / n) / spread : 0.0;
}

/// Mean speed while the spindle turns, rad/s; 0 where time stands still. An eighth of a revolution
/// does not count if it takes more than twice the median: it has a pause in it, such as that before
/// the next pass.
double speed_rad_per_s(const ProbeStream& stream, const Pass& pass) {
  struct Eighth {
    double turned_rad, took_s;
  };
  std::vector<Eighth> eighths;
  for (std::size_t from = pass.begin, i = from + 1; i < pass.end; ++i) {
    const double turned = stream.c_rad[i] - stream.c_rad[from];
    if (std::abs(turned) < two_pi / 8.0 && i + 1 < pass.end) continue;
    eighths.push_back({turned, stream.time_s[i] - stream.time_s[from]});
    from = i;
  }
  std::vector<double> slowness;  // s/rad
  for (const Eighth& one : eighths)
    if (one.turned_rad != 0.0) slowness.push_back(one.took_s / std::abs(one.turned_rad));
  if (slowness.empty()) return 0.0;
  const auto middle = slowness.begin() + static_cast<std::ptrdiff_t>(slowness.size() / 2);
  std::nth_element(slowness.begin(), middle, slowness.end());
  const std::size_t last = pass.end - 1;
  double turned_rad = stream.c_rad[last] - stream.c_rad[pass.begin];
  double took_s = stream.time_s[last] - stream.time_s[pass.begin];
  for (const Eighth& one : eighths) {
    if (*middle <= 0.0 || one.took_s <= 2.0 * *middle * std::abs(one.turned_rad)) continue;
    turned_rad -= one.turned_rad;
    took_s -= one.took_s;
  }
  return took_s > 0.0 ? turned_rad / took_s : 0.0;
}

/// Fills what follows from the readings of a pass and its senses.
void describe(const ProbeStream& stream, Pass& pass) {
  const std::size_t last = pass.end - 1;
  const double turned_rad = stream.c_rad[last] - stream.c_rad[pass.begin];
  if (!stream.setup.empty()) pass.setup = stream.setup[pass.begin];
  if (pass.c_sign == 0 || turned_rad == 0.0) return;
  pass.readings_per_revolution =
      static_cast<double>(last - pass.begin) * two_pi / std::abs(turned_rad);
  if (!stream.time_s.empty()) pass.speed_rad_per_s = speed_rad_per_s(stream, pass);
  if (pass.feed_sign != 0) {
    pass.feed_mm_per_rev = slope_mm_per_rad(stream, pass) * two_pi * (turned_rad > 0 ? 1 : -1);
  }
}

/// A pass of readings [begin, end) whose senses are those of its net travel.
Pass net_pass(const ProbeStream& stream, std::size_t begin, std::size_t end) {
  Pass pass;
  pass.begin = begin;
  pass.end = end;
  pass.c_sign = sign_of(stream.c_rad[end - 1] - stream.c_rad[begin], least_turn_rad);
  if (stream.has_position()) {
    pass.feed_sign =
        sign_of(stream.position_mm[end - 1] - stream.position_mm[begin], least_feed_mm);
  }
  return pass;
}

/// Whether the reading where two runs meet is the first of the second: the step to it, in time or
/// C, is not as the one before it, while the step from it is as the next. The probe stood still
/// before it, or the spindle turned on.
bool begins_the_next(const ProbeStream& stream, std::size_t begin, std::size_t meet,
                     std::size_t end) {
  constexpr double of_a_clock = 1.5;  // steps of one run differ by less
  if (meet < begin + 2 || meet + 2 >= end) return false;
  for (const std::vector<double>* clock : {&stream.time_s, &stream.c_rad}) {
    if (clock->empty()) continue;
    const auto step = [&](std::size_t to) { return std::abs((*clock)[to] - (*clock)[to - 1]); };
    const auto apart = [](double a, double b) { return std::abs(std::log(a / b)); };
    const double into = apart(step(meet), step(meet - 1));
    const double from = apart(step(meet + 1), step(meet + 2));
    if (into > from + std::log(of_a_clock)) return true;
  }
  return false;
}

/// Passes of one set-up by the senses of motion; readings [begin, end).
void passes_by_senses(const ProbeStream& stream, std::size_t begin, std::size_t end,
                      std::vector<Pass>& passes) {
  const std::size_t before = passes.size();
  if (end - begin > 2) {
    const StepSigns signs = find_step_signs(stream, begin, end);
    const std::size_t steps = end - begin - 1;
    std::size_t next_reading = begin;
    for (std::size_t a = 0; a < steps;) {
      std::size_t b = a + 1;
      while (b < steps && signs.c[b] == signs.c[a] && signs.feed[b] == signs.feed[a]) ++b;
      const bool single = b - a == 1;
      if (!single) {
        Pass pass;
        pass.begin = next_reading;
        const std::size_t meet = begin + b;
        pass.end = begins_the_next(stream, begin, meet, end) ? meet : meet + 1;
        pass.c_sign = sign_of(signs.c[a], 0.0);
        pass.feed_sign = sign_of(signs.feed[a], 0.0);
        if (pass.end - pass.begin == 1 && passes.size() > before)
          passes.back().end = pass.end;
        else
          passes.push_back(pass);
        next_reading = pass.end;
      } else if (passes.size() > before) {
        passes.back().end = next_reading = begin + a + 1;
      }
      a = b;
    }
  }
  if (passes.size() == before) {
    passes.push_back(net_pass(stream, begin, end));
  } else {
    passes.back().end = end;
  }
}

/// Cuts passes where the spindle changes its speed.
std::vector<Pass> cut_by_speed(const ProbeStream& stream, const std::vector<Pass>& passes) {
  if (stream.time_s.empty()) return passes;
  std::vector<Pass> out;
  for (Pass pass : passes) {
    if (pass.c_sign != 0) {
      const std::size_t begin = pass.begin, count = pass.end - pass.begin;
      const auto c = std::span(stream.c_rad).subspan(begin, count);
      const auto t = std::span(stream.time_s).subspan(begin, count);
      for (const std::size_t change : find_speed_changes(c, t)) {
        if (begin + change <= pass.begin || begin + change >= pass.end) continue;
        Pass first = pass;
        first.end = pass.begin = begin + change;
        out.push_back(first);
      }
    }
    out.push_back(pass);
  }
  return out;
}

}  // namespace

std::vector<Pass> find_passes(const ProbeStream& stream) {
  const std::size_t size = stream.size();
  const auto fits = [&](std::size_t column) { return column == 0 || column == size; };
  expects(stream.c_rad.size() == size && fits(stream.position_mm.size()) &&
              fits(stream.time_s.size()) && fits(stream.pass.size()) && fits(stream.setup.size()),
          "columns of one length");
  std::vector<Pass> passes;
  const auto same = [](const std::vector<int>& column, std::size_t a, std::size_t b) {
    return column.empty() || column[a] == column[b];
  };
  for (std::size_t begin = 0; begin < size;) {
    std::size_t end = begin + 1;
    while (end < size && same(stream.setup, begin, end) && same(stream.pass, begin, end)) ++end;
    if (stream.pass.empty()) {
      passes_by_senses(stream, begin, end, passes);
    } else {
      passes.push_back(net_pass(stream, begin, end));
    }
    begin = end;
  }
  if (stream.pass.empty()) passes = cut_by_speed(stream, passes);
  for (Pass& pass : passes) describe(stream, pass);
  return passes;
}

namespace {

/// Times at which c has turned by 0, 1, 2 … whole turns from its first reading; none where there
/// are more turns than readings, so nothing to compare.
std::vector<double> turn_times(std::span<const double> c, std::span<const double> t) {
  std::vector<double> times{t[0]};
  const double sense = c.back() > c.front() ? 1.0 : -1.0;
  for (std::size_t i = 1; i < c.size(); ++i) {
    const double turned = sense * (c[i] - c[0]);
    for (;;) {
      const double goal = two_pi * static_cast<double>(times.size());
      if (turned < goal) break;
      if (times.size() > c.size()) return {};
      const double step = sense * (c[i] - c[i - 1]);
      const double part = step > 0.0 ? std::clamp(1.0 - (turned - goal) / step, 0.0, 1.0) : 1.0;
      times.push_back(t[i - 1] + part * (t[i] - t[i - 1]));
    }
  }
  return times;
}

/// Splits of a row of speeds where its mean changes (binary segmentation).
class MeanChanges {
 public:
  explicit MeanChanges(const std::vector<double>& speeds)
      : sums_(speeds.size() + 1, 0.0), squares_(speeds.size() + 1, 0.0) {
    const double reference = speeds.front();
    for (std::size_t k = 0; k < speeds.size(); ++k) {
      const double d = speeds[k] / reference - 1.0;
      sums_[k + 1] = sums_[k] + d;
      squares_[k + 1] = squares_[k] + d * d;
    }
    std::vector<std::pair<std::size_t, std::size_t>> open{{0, speeds.size()}};
    while (!open.empty()) {
      const auto [begin, end] = open.back();
      open.pop_back();
      const std::size_t at = split(begin, end);
      if (at == 0) continue;
      splits.push_back(at);
      open.emplace_back(begin, at);
      open.emplace_back(at, end);
    }
    std::sort(splits.begin(), splits.end());
  }

  std::vector<std::size_t> splits;

 private:
  double mean(std::size_t begin, std::size_t end) const {
    return (sums_[end] - sums_[begin]) / static_cast<double>(end - begin);
  }
  double scatter(std::size_t begin, std::size_t end) const {
    const double sum = sums_[end] - sums_[begin];
    return squares_[end] - squares_[begin] - sum * sum / static_cast<double>(end - begin);
  }

  /// The best split of [begin, end), or 0 if it is not a change.
  std::size_t split(std::size_t begin, std::size_t end) const {
    if (end - begin < 3) return 0;
    std::size_t best = 0;
    double most = -1.0;
    for (std::size_t at = begin + 1; at < end; ++at) {
      const double left = static_cast<double>(at - begin), right = static_cast<double>(end - at);
      const double difference = mean(begin, at) - mean(at, end);
      const double gain = left * right / (left + right) * difference * difference;
      if (gain > most) {
        most = gain;
        best = at;
      }
    }
    const double freedom = static_cast<double>(end - begin - 2);
    const double variance = std::max(0.0, scatter(begin, best) + scatter(best, end)) / freedom;
    const double error = std::sqrt(variance * (1.0 / static_cast<double>(best - begin) +
                                               1.0 / static_cast<double>(end - best)));
    const double difference = std::abs(mean(begin, best) - mean(best, end));
    const double level = 1.0 + std::min(mean(begin, best), mean(best, end));
    // With few revolutions the scatter itself is uncertain: ask for more.
    const double errors = 5.0 * (1.0 + 4.0 / freedom);
    return difference > 0.01 * std::abs(level) && difference > errors * error ? best : 0;
  }

  std::vector<double> sums_, squares_;
};

/// Revolutions [begin, end) at one speed.
struct SpeedRun {
  std::size_t begin, end;
  std::size_t size() const { return end - begin; }
};

/// Runs between splits; single revolutions in a row are one run. A single one at either end of the
/// pass is the run-up from the pass before, cut off a few readings early or late: no speed of its
/// own.
std::vector<SpeedRun> speed_runs(const std::vector<std::size_t>& splits, std::size_t count) {
  std::vector<SpeedRun> runs;
  std::size_t begin = 0;
  bool row_of_singles = false;
  for (std::size_t k = 0; k <= splits.size(); ++k) {
    const std::size_t end = k < splits.size() ? splits[k] : count;
    const bool single = end - begin == 1;
    if (single && row_of_singles) {
      runs.back().end = end;
    } else {
      runs.push_back({begin, end});
    }
    row_of_singles = single;
    begin = end;
  }
  if (runs.size() > 1 && runs.front().size() == 1) {
    runs[1].begin = runs[0].begin;
    runs.erase(runs.begin());
  }
  if (runs.size() > 1 && runs.back().size() == 1) {
    runs[runs.size() - 2].end = runs.back().end;
    runs.pop_back();
  }
  return runs;
}

/// Time at which the line through the first run's whole turns meets that of the second. The
/// revolution next to the change does not count if there are more.
double meeting_time(const std::vector<double>& times, const SpeedRun& before,
                    const SpeedRun& after) {
  const std::size_t b1 = before.size() > 1 ? before.end - 1 : before.end;
  const std::size_t a0 = after.size() > 1 ? after.begin + 1 : after.begin;
  const auto turns = [](std::size_t from, std::size_t to) {
    return static_cast<double>(to - from);
  };
  const double w1 = turns(before.begin, b1) / (times[b1] - times[before.begin]);
  const double w2 = turns(a0, after.end) / (times[after.end] - times[a0]);
  // turns(b1) + w1 (t - t_b1) = turns(a0) + w2 (t - t_a0)
  const double t = (turns(b1, a0) + w1 * times[b1] - w2 * times[a0]) / (w1 - w2);
  return std::clamp(t, times[b1], times[a0]);
}

}  // namespace

std::vector<std::size_t> find_speed_changes(std::span<const double> c_rad,
                                            std::span<const double> time_s) {
  const std::vector<double> times = turn_times(c_rad, time_s);
  std::vector<double> speeds;
  for (std::size_t k = 0; k + 1 < times.size(); ++k) {
    if (!(times[k + 1] > times[k])) return {};
    speeds.push_back(1.0 / (times[k + 1] - times[k]));
  }
  if (speeds.size() < 3) return {};
  const std::vector<SpeedRun> runs = speed_runs(MeanChanges(speeds).splits, speeds.size());
  std::vector<std::size_t> changes;
  for (std::size_t k = 0; k + 1 < runs.size(); ++k) {
    const bool mixed = runs[k + 1].size() == 1 && k + 2 < runs.size();
    const SpeedRun& after = runs[mixed ? k + 2 : k + 1];
    const double t = meeting_time(times, runs[k], after);
    const auto at = std::lower_bound(time_s.begin(), time_s.end(), t);
    changes.push_back(static_cast<std::size_t>(at - time_s.begin()));
    if (mixed) ++k;
  }
  return changes;
}

}  // namespace trueaxis

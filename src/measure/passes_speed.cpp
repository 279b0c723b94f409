// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "measure/passes_motion.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {
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

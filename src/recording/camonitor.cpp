// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>

#include "base/counted.hpp"
#include "base/text.hpp"
#include "format/csv_text.hpp"
#include "math/statistics.hpp"
#include "recording/columns.hpp"
#include "recording/recording.hpp"

namespace trueaxis {
namespace {

struct Sample {
  double time_s = 0.0, value = 0.0;
  std::string_view text;
  std::size_t line = 0;
};
using Channels = std::map<std::string, std::vector<Sample>, std::less<>>;

/// "PV date time value": false for any other line.
bool read_sample(std::string_view line, std::size_t number, Channels& channels) {
  const auto field = csv_fields(line, ' ');
  if (field.size() < 4) return false;
  const auto time_s = instant_s(std::string(field[1]) + " " + std::string(field[2]));
  double value = 0.0;
  if (!time_s || !recorded_number(field[3], '.', value)) return false;
  channels[std::string(field[0])].push_back({*time_s, value, field[3], number});
  return true;
}

/// The value of a channel at an instant, by linear interpolation; NaN outside of its samples, but
/// for one that stays.
double value_at(const std::vector<Sample>& samples, double time_s, bool stays, std::size_t& from) {
  while (from + 1 < samples.size() && samples[from + 1].time_s <= time_s) ++from;
  const Sample& a = samples[from];
  if (time_s == a.time_s) return a.value;
  if (time_s < a.time_s) return std::nan("");
  if (from + 1 == samples.size()) return stays ? a.value : std::nan("");
  const Sample& b = samples[from + 1];
  return a.value + (b.value - a.value) * (time_s - a.time_s) / (b.time_s - a.time_s);
}

/// An angle that jumps back by about a turn at the end of each becomes a running one. What lies
/// between two samples is then on the way of the spindle.
bool unwrap_degrees(std::vector<Sample>& samples) {
  const auto [low, high] = std::ranges::minmax(samples, {}, &Sample::value);
  if (high.value - low.value > 361.0 || high.value - low.value < 180.0) return false;
  double turns = 0.0, before = samples.front().value;
  bool any = false;
  for (Sample& sample : samples) {
    const double step = sample.value - before;
    before = sample.value;
    if (std::abs(step) > 180.0) {
      turns -= std::round(step / 360.0);
      any = true;
    }
    sample.value += 360.0 * turns;
  }
  return any;
}

/// The speed of an angle that was made to run on, as most of its steps show it.
double deg_per_s_of(const std::vector<Sample>& samples) {
  std::vector<double> speeds;
  for (std::size_t i = 1; i < samples.size(); ++i)
    if (const double took_s = samples[i].time_s - samples[i - 1].time_s; took_s > 0.0)
      speeds.push_back(std::abs(samples[i].value - samples[i - 1].value) / took_s);
  return speeds.empty() ? 0.0 : median(std::move(speeds));
}

/// Of an angle that was made to run on: steps of a third of a turn may have been two thirds, and a
/// gap in which the spindle makes more than half a turn may hide a whole one. At rest a control
/// sends no samples, and C then goes on from where it was.
void refuse_long_steps(const std::string& name, const std::vector<Sample>& samples,
                       double usual_deg_per_s, Recording& out) {
  constexpr double at_rest_deg = 1.8;  // one gap of whole turns in a hundred shows less
  for (std::size_t i = 1; i < samples.size(); ++i) {
    const double step_deg = std::abs(samples[i].value - samples[i - 1].value);
    const double took_s = samples[i].time_s - samples[i - 1].time_s;
    const double expected_deg = usual_deg_per_s * took_s;
    if (step_deg > 120.0)
      out.wrong.push_back({"", samples[i].line, 0,
                           name + " goes on by more than 120° between two samples, so that its "
                                  "sense is not sure: record it more often"});
    else if (expected_deg > 180.0 && step_deg > at_rest_deg)
      out.wrong.push_back(
          {"", samples[i].line, 0,
           fmt::format("{} has no sample for {:.3g} s, in which the spindle makes {:.2g} "
                       "revolutions at its usual speed: record it without a gap",
                       name, took_s, expected_deg / 360.0)});
    else
      continue;
    return;
  }
}

/// Samples of a channel come in the order of its clock.
void refuse_falling_clock(const std::string& name, const std::vector<Sample>& samples,
                          Recording& out) {
  const auto falls = std::ranges::adjacent_find(
      samples, [](const Sample& a, const Sample& b) { return b.time_s < a.time_s; });
  if (falls == samples.end()) return;
  out.wrong.push_back({"", std::next(falls)->line, 0,
                       fmt::format("the clock of {} goes back by {:.3g} s: cut the log here, or "
                                   "record again",
                                   name, falls->time_s - std::next(falls)->time_s)});
}

}  // namespace

bool read_camonitor(const RecordedText& text, const ColumnsSaid& said, Recording& out) {
  Channels channels;
  std::size_t others = 0, samples = 0;
  for (std::size_t i = 0; i < text.lines.size(); ++i) {
    const std::string_view line = trimmed(text.lines[i]);
    if (line.starts_with('#')) take_comment(line, i + 1, out);
    if (line.empty() || line.starts_with('#')) continue;
    (read_sample(line, i + 1, channels) ? samples : others) += 1;
  }
  if (samples < 4 || others > samples / 10) return false;
  for (const auto& [name, of] : channels) out.columns.push_back({name, "", name, true});
  // The readings are never interpolated: what lies between two of them is not known. Without a
  // channel of readings the log is refused, whatever the instants.
  const std::size_t reading = column_of_readings(out, said).value_or(0);
  const auto base = std::next(channels.begin(), static_cast<std::ptrdiff_t>(reading));
  std::string joined;
  // A channel that does not change sends nothing. One that ran on as an angle, or of a log with
  // other lines (disconnected), may have ended.
  std::vector<char> stays(channels.size(), others == 0);
  std::size_t channel = 0;
  for (auto& [name, of] : channels) {
    char& stays_now = stays[channel++];
    refuse_falling_clock(name, of, out);
    std::ranges::stable_sort(of, {}, &Sample::time_s);
    if (&of != &base->second) add_to_list(joined, name);
    if (!unwrap_degrees(of)) {
      if (stays_now && of.back().time_s < base->second.back().time_s)
        out.notes.push_back(
            fmt::format("{} sends nothing for the last {:.3g} s: read as at rest at {:.6g}", name,
                        base->second.back().time_s - of.back().time_s, of.back().value));
      continue;
    }
    stays_now = false;
    const double deg_per_s = deg_per_s_of(of);
    refuse_long_steps(name, of, deg_per_s, out);
    out.notes.push_back(
        fmt::format("{} jumps by a revolution: read as an angle in degrees that "
                    "runs on, at {:.4g} rpm if no turn is missed between samples",
                    name, deg_per_s / 6.0));
  }
  out.columns.push_back({"t", "s", "t", true});

  std::vector<std::size_t> from(channels.size(), 0);
  std::size_t outside = 0;
  const double start_s = base->second.front().time_s;
  for (const Sample& sample : base->second) {
    std::vector<double> row;
    std::size_t k = 0;
    for (const auto& [name, of] : channels) {
      row.push_back(value_at(of, sample.time_s, stays[k] != 0, from[k]));
      ++k;
    }
    if (std::ranges::any_of(row, [](double value) { return std::isnan(value); })) {
      ++outside;
      continue;
    }
    row.push_back(sample.time_s - start_s);
    for (const double value : row)
      out.cells.push_back(out.made.emplace_back(fmt::format("{:.17g}", value)));
    out.lines.push_back(sample.line);
  }
  if (!joined.empty())
    out.notes.push_back(joined + " interpolated linearly in time at the instants of " +
                        base->first);
  if (outside > 0)
    out.notes.push_back(
        fmt::format("{} samples of {} lie before the first or after the last of another "
                    "channel and are excluded",
                    outside, base->first));
  if (others > 0)
    out.notes.push_back(counted(others, "line without a number (disconnected, alarms) is",
                                "lines without a number (disconnected, alarms) are") +
                        " passed over");
  out.producer = "an EPICS camonitor log";
  return true;
}

}  // namespace trueaxis

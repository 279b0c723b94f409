// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "base/counted.hpp"
#include "base/text.hpp"
#include "format/csv_text.hpp"
#include "recording/column_names.hpp"
#include "recording/instant.hpp"
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

/// The value of a channel at an instant, by linear interpolation; NaN outside of its samples.
double value_at(const std::vector<Sample>& samples, double time_s, std::size_t& from) {
  while (from + 1 < samples.size() && samples[from + 1].time_s <= time_s) ++from;
  const Sample& a = samples[from];
  if (time_s == a.time_s) return a.value;
  if (time_s < a.time_s || from + 1 == samples.size()) return std::nan("");
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

/// Of an angle that was made to run on: steps of a third of a turn may have been two thirds.
void refuse_long_steps(const std::string& name, const std::vector<Sample>& samples, bool runs_on,
                       Recording& out) {
  if (!runs_on) return;
  for (std::size_t i = 1; i < samples.size(); ++i) {
    if (std::abs(samples[i].value - samples[i - 1].value) <= 120.0) continue;
    out.wrong.push_back({"", samples[i].line, 0,
                         name + " goes on by more than 120° between two samples, so that its sense "
                                "is not sure: record it more often"});
    return;
  }
}

}  // namespace

bool read_camonitor(const RecordedText& text, Recording& out) {
  Channels channels;
  std::size_t others = 0, samples = 0;
  for (std::size_t i = 0; i < text.lines.size(); ++i) {
    const std::string_view line = trimmed(text.lines[i]);
    if (line.empty() || line.starts_with('#')) continue;
    (read_sample(line, i + 1, channels) ? samples : others) += 1;
  }
  if (samples < 4 || others > samples / 10) return false;
  // The readings are never interpolated: what lies between two of them is not known.
  const auto reading = std::ranges::find_if(channels, [](const auto& channel) {
    const auto named = role_of_name(channel.first);
    return named && (named->role == RecordedRole::x || named->role == RecordedRole::face);
  });
  const auto fastest = reading != channels.end()
                           ? reading
                           : std::ranges::max_element(channels, {}, [](const auto& channel) {
                               return channel.second.size();
                             });
  std::string joined;
  for (auto& [name, of] : channels) {
    std::ranges::stable_sort(of, {}, &Sample::time_s);
    if (&of != &fastest->second) add_to_list(joined, name);
    const bool runs_on = unwrap_degrees(of);
    refuse_long_steps(name, of, runs_on, out);
    if (runs_on)
      out.notes.push_back(name +
                          " jumps by a revolution: read as an angle in degrees that runs on");
    out.columns.push_back({name, "", name, true});
  }
  out.columns.push_back({"t", "s", "t", true});

  std::vector<std::size_t> from(channels.size(), 0);
  std::size_t outside = 0;
  const double start_s = fastest->second.front().time_s;
  for (const Sample& sample : fastest->second) {
    std::vector<double> row;
    std::size_t k = 0;
    for (const auto& [name, of] : channels) row.push_back(value_at(of, sample.time_s, from[k++]));
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
                        fastest->first);
  if (outside > 0)
    out.notes.push_back(
        fmt::format("{} samples of {} lie before the first or after the last of another "
                    "channel and are excluded",
                    outside, fastest->first));
  if (others > 0)
    out.notes.push_back(counted(others, "line without a number (disconnected, alarms) is",
                                "lines without a number (disconnected, alarms) are") +
                        " passed over");
  out.producer = "an EPICS camonitor log";
  return true;
}

}  // namespace trueaxis

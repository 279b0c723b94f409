// SPDX-License-Identifier: Apache-2.0
#include "spindle/recording.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <sstream>

#include "math/statistics.hpp"
#include "measure/column_checks.hpp"
#include "measure/passes.hpp"
#include "spindle/synchronous.hpp"
#include "trueaxis/error.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

constexpr double one_place_mm = 0.1;  // readings of one section
constexpr double on_axis_mm = 0.1;    // |X| of an axial sensor at the spindle axis
constexpr double least_turns = 4.0;   // fewer show nothing of what does not repeat
constexpr double same_speed = 0.01;   // as for a pass
constexpr double one_line_rad = 1e-6;

std::string text_of(double value) {
  std::ostringstream text;
  text.precision(4);
  text << value;
  return text.str();
}

double mean_of(const std::vector<double>& column) {
  return std::accumulate(column.begin(), column.end(), 0.0) / static_cast<double>(column.size());
}

/// Collects what is wrong with the streams, and what they must have in common.
class StreamChecks {
 public:
  void columns(const ProbeStream& stream) {
    if (std::string why = column_objection(stream); !why.empty()) add(stream, std::move(why));
  }

  void one_place(const ProbeStream& stream) {
    if (!stream.has_position()) return;
    const bool face = stream.kind == StreamKind::face;
    const Extent extent = range_of(stream.position_mm);
    const std::string axis = face ? "X" : "Z";
    std::optional<double>& place = face ? face_at_mm_ : section_at_mm_;
    if (extent.length() > one_place_mm)
      add(stream, axis + " runs from " + text_of(extent.low) + " to " + text_of(extent.high) +
                      " mm: record the motion of the spindle at one " + axis);
    else if (place && std::abs(*place - extent.low) > one_place_mm)
      add(stream, axis + " is " + text_of(extent.low) + " mm here and " + text_of(*place) +
                      " mm in a previous stream: one estimate needs one " + axis);
    if (!place) place = extent.low;
  }

  void one_speed(const ProbeStream& stream) {
    for (const Pass& pass : find_passes(stream)) {
      if (pass.c_sign == 0) {
        add(stream, "the spindle stands still in rows " + std::to_string(pass.begin + 1) + " to " +
                        std::to_string(pass.end) + ": take them out");
        continue;
      }
      double speed = pass.speed_rad_per_s;
      if (speed == 0.0 && stream.spindle_rpm) speed = *stream.spindle_rpm / 60.0 * two_pi;
      if (sign_ != 0 && pass.c_sign != sign_)
        return add(stream,
                   "C runs in the opposite direction to the previous stream: error motion depends "
                   "on the sense of rotation, so separate each sense alone");
      sign_ = pass.c_sign;
      if (speed == 0.0) continue;
      if (speed_ && std::abs(speed / *speed_ - 1.0) > same_speed)
        return add(stream,
                   "the spindle turns at " + text_of(std::abs(speed) / two_pi * 60.0) +
                       " rpm here and at " + text_of(std::abs(*speed_) / two_pi * 60.0) +
                       " before: error motion depends on the speed, so separate each speed alone");
      if (!speed_) speed_ = speed;
    }
  }

  void one_part(const ProbeStream& stream, const SetUp& set_up) {
    const std::string name = "setup." + std::to_string(set_up.number);
    if (set_up.z_shift_mm != 0.0)
      add(stream, name + " is shifted along Z, so that another section is read: separate it alone");
    if (set_up.clamp_force_ratio != 1.0)
      add(stream,
          name + " is clamped with another force, which changes the form: separate it alone");
    if (set_up.rear && stream.kind == StreamKind::face)
      add(stream, name + " is probed from the rear: a face does not have a rear side");
  }

  /// If readings are positions, their sign tells the sensor's side of the axis.
  void one_side(const ProbeStream& stream, const SetUp& set_up, const RunReadings& run) {
    if (run.axial || stream.indication == Indication::relative) return;
    const std::string name = "set-up " + std::to_string(set_up.number);
    std::size_t outside = 0;
    for (const auto& column : run.columns_mm) outside += mean_of(column) > 0.0;
    if (outside == run.columns_mm.size()) return;
    add(stream, outside > 0 ? "in " + name +
                                  " some sensors read more than 0 and others less: each must read "
                                  "outwards from the spindle axis at its own angle"
                            : name +
                                  " is stated as probed from the rear, but X_M is more than 0: on "
                                  "the rear side X_M is negative, counted along +X. Correct X_M, "
                                  "or remove the side if the part is only turned");
  }

  void enough(const ProbeStream& stream, const RunReadings& run) {
    if (run.c_rad.size() < 2 || run.turns() < least_turns)
      add(stream, "set-up " + std::to_string(run.set_up.number) + " has " +
                      text_of(run.c_rad.size() < 2 ? 0.0 : run.turns()) +
                      " turns: record at least 4 (20 and more are usual) to determine the motion "
                      "that does not repeat");
  }

  /// A recording that is given twice would count as two.
  void different(const std::vector<RunReadings>& runs) {
    struct Column {
      const RunReadings* run;
      std::size_t sensor;
    };
    std::vector<Column> seen;
    const auto name_of = [](const Column& one) {
      return "sensor " + std::to_string(one.sensor + 1) + " of set-up " +
             std::to_string(one.run->set_up.number) + " of " + one.run->stream;
    };
    for (const RunReadings& run : runs) {
      for (std::size_t s = 0; s < run.columns_mm.size(); ++s) {
        const Column one{&run, s};
        const auto same = std::ranges::find_if(seen, [&](const Column& other) {
          return other.run->columns_mm[other.sensor] == run.columns_mm[s] &&
                 other.run->c_rad == run.c_rad;
        });
        if (same != seen.end()) {
          wrong_.push_back({run.stream, 0, 0,
                            name_of(one) + " has the same readings as " + name_of(*same) +
                                ": give each recording once"});
          return;
        }
        seen.push_back(one);
      }
    }
  }

  void throw_if_any() {
    if (!wrong_.empty()) throw InputError(std::move(wrong_));
  }

 private:
  void add(const ProbeStream& stream, std::string message) {
    wrong_.push_back({stream.source, 0, 0, std::move(message)});
  }

  std::vector<Diagnostic> wrong_;
  std::optional<double> section_at_mm_, face_at_mm_, speed_;
  int sign_ = 0;
};

RunReadings take_run(const ProbeStream& stream, const SetUp& set_up) {
  RunReadings run;
  run.stream = stream.source;
  run.set_up = set_up;
  run.axial = stream.kind == StreamKind::face;
  run.angles_rad = stream.sensor_angles_rad;
  if (run.angles_rad.empty()) run.angles_rad = {0.0};
  run.columns_mm.resize(run.angles_rad.size());
  for (std::size_t i = 0; i < stream.size(); ++i) {
    if (!stream.setup.empty() && stream.setup[i] != set_up.number) continue;
    run.c_rad.push_back(stream.c_rad[i]);
    run.columns_mm[0].push_back(stream.reading_mm[i]);
    for (std::size_t s = 1; s < run.columns_mm.size(); ++s)
      run.columns_mm[s].push_back(stream.more_reading_mm[s - 1][i]);
  }
  if (run.axial) {
    run.on_axis = stream.has_position() && std::abs(stream.position_mm.front()) <= on_axis_mm;
    return run;
  }
  const bool absolute = stream.indication == Indication::absolute;
  double sum_mm = 0.0;
  for (const auto& column : run.columns_mm) sum_mm += mean_of(column);
  run.rear = set_up.rear || (absolute && sum_mm < 0.0);
  if (run.rear) {
    for (double& angle : run.angles_rad) angle += std::numbers::pi;
    for (auto& column : run.columns_mm)
      for (double& reading : column) reading = -reading;
  }
  run.radius_mm = absolute ? std::abs(sum_mm) / static_cast<double>(run.columns_mm.size())
                           : stream.nominal_radius_mm.value_or(0.0);
  return run;
}

}  // namespace

double RunReadings::turns() const {
  const double readings = static_cast<double>(c_rad.size());
  return range_of(c_rad).length() / two_pi * readings / (readings - 1.0);
}

std::vector<RunReadings> take_runs(std::span<const ProbeStream> streams) {
  StreamChecks checks;
  std::vector<RunReadings> runs;
  for (const ProbeStream& stream : streams) {
    checks.columns(stream);
    checks.one_place(stream);
    checks.one_speed(stream);
    for (const SetUp& set_up : list_set_ups(stream)) {
      checks.one_part(stream, set_up);
      runs.push_back(take_run(stream, set_up));
      checks.one_side(stream, set_up, runs.back());
      checks.enough(stream, runs.back());
    }
  }
  checks.different(runs);
  checks.throw_if_any();
  return runs;
}

double sensitive_direction(std::span<const RunReadings> runs, std::optional<double> wanted_rad) {
  const double first = runs.front().angles_rad.front();
  const auto off_line = [](double a, double b) { return std::abs(std::sin(a - b)) > one_line_rad; };
  const bool one_line = std::ranges::none_of(runs, [&](const RunReadings& run) {
    return std::ranges::any_of(run.angles_rad, [&](double a) { return off_line(a, first); });
  });
  if (!one_line) return wanted_rad.value_or(0.0);
  const double line = off_line(first, 0.0) ? first : 0.0;
  if (wanted_rad && off_line(*wanted_rad, first))
    throw InputError(runs.front().stream,
                     "all sensors are on the line at " + text_of(first / rad_per_deg) +
                         " deg and do not measure motion along " +
                         text_of(*wanted_rad / rad_per_deg) +
                         " deg: place one there, or choose their own direction");
  return wanted_rad.value_or(line);
}

Layout layout_of(std::span<const RunReadings> runs, double sensitive_rad) {
  std::vector<Channel> channels;
  std::vector<double> brackets;
  for (std::size_t r = 0; r < runs.size(); ++r) {
    const RunReadings& run = runs[r];
    for (std::size_t s = 0; s < run.angles_rad.size(); ++s) {
      const double angle = run.angles_rad[s];
      const double bracket = run.rear ? angle - std::numbers::pi : angle;
      const auto known = std::ranges::find_if(
          brackets, [&](double other) { return std::abs(other - bracket) < one_line_rad; });
      channels.push_back({.run = r,
                          .sensor = s,
                          .bracket = static_cast<std::size_t>(known - brackets.begin()),
                          .form_angle_rad = angle + run.set_up.reindex_rad,
                          .along = run.axial ? 1.0 : std::cos(angle - sensitive_rad),
                          .across = run.axial ? 0.0 : std::sin(angle - sensitive_rad),
                          .sees_form = !run.on_axis});
      if (known == brackets.end()) brackets.push_back(bracket);
    }
  }
  // A face in one set-up alone shows motion and form as one.
  if (runs.front().axial && channels.size() == 1) channels.front().sees_form = false;
  Layout layout(std::move(channels));
  const auto count = static_cast<Eigen::Index>(layout.channels().size());
  if (count < layout.unknowns())
    throw InputError(
        runs.front().stream,
        count == 1
            ? "one sensor in one set-up cannot separate form and motion: add sensors (`trueaxis "
              "spindle --advise`), a reversal or re-indexed set-ups"
            : std::to_string(count) + " sensors in all, and form, motion along X and along Y are " +
                  std::to_string(layout.unknowns()) +
                  " unknowns: add a sensor, or a re-indexed set-up");
  return layout;
}

void expect_no_gap(const RunReadings& run, const SynchronousFit& fit, const SynchronousPart& part) {
  if (!fit.cut() || !fit.leaves_what_repeats(part)) return;
  throw InputError(
      run.stream, fmt::format("set-up {} has no readings {}: the others carry orders up to {}, and "
                              "what repeats has higher ones. Measure a section without an "
                              "interruption",
                              run.set_up.number, gap_words(fit.gap()), fit.order_max()));
}

void leave_out(RunReadings& run, const std::vector<bool>& marks) {
  const auto without = [&](std::vector<double>& column) {
    std::size_t i = 0;
    std::erase_if(column, [&](double) { return marks[i++]; });
  };
  without(run.c_rad);
  for (auto& column : run.columns_mm) without(column);
  run.left_out += static_cast<std::size_t>(std::ranges::count(marks, true));
}

}  // namespace trueaxis

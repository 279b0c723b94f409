// SPDX-License-Identifier: Apache-2.0
#include "trueaxis/virtual_lathe.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "measure/passes.hpp"
#include "simulate/recorder.hpp"
#include "trueaxis/error.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis::virtual_lathe {
namespace {

/// When and how fast the recorded readings were made.
class RecordedMotion {
 public:
  explicit RecordedMotion(const ProbeStream& stream)
      : stream_(stream), passes_(find_passes(stream)) {
    if (!stream.time_s.empty() || !stream.spindle_rpm || passes_.size() != 1) return;
    // Without a clock the stated speed is one, while C runs one way.
    const double stated = std::abs(*stream.spindle_rpm) / 60.0 * two_pi;
    if (passes_.front().c_sign != 0)
      passes_.front().speed_rad_per_s = stated * passes_.front().c_sign;
  }

  const std::vector<Pass>& passes() const { return passes_; }

  Moment at(const Pass& pass, std::size_t i) const {
    Moment now;
    now.c_rad = stream_.c_rad[i];
    now.position_mm = stream_.has_position() ? stream_.position_mm[i] : 0.0;
    now.omega_rad_per_s = pass.speed_rad_per_s;
    now.velocity_mm_per_s = pass.feed_mm_per_rev * std::abs(pass.speed_rad_per_s) / two_pi;
    if (!stream_.time_s.empty()) {
      now.t_s = stream_.time_s[i];
      const double lasted = stream_.time_s[pass.end - 1] - stream_.time_s[pass.begin];
      if (pass.c_sign == 0 && lasted > 0.0 && stream_.has_position()) {
        now.velocity_mm_per_s =
            (stream_.position_mm[pass.end - 1] - stream_.position_mm[pass.begin]) / lasted;
      }
    } else if (pass.speed_rad_per_s != 0.0) {
      now.t_s = (stream_.c_rad[i] - stream_.c_rad.front()) / pass.speed_rad_per_s;
    } else {
      now.t_s = static_cast<double>(i);  // the order of the readings is all that is known
    }
    return now;
  }

  /// Between two readings, and before the first as between the first two: a row with a fraction.
  Moment between(const Pass& pass, double row) const {
    if (pass.end - pass.begin < 2) return at(pass, pass.begin);
    const auto last = static_cast<double>(pass.end - 2);
    const double from = std::clamp(std::floor(row), static_cast<double>(pass.begin), last);
    const auto i = static_cast<std::size_t>(from);
    Moment now = at(pass, i);
    const Moment next = at(pass, i + 1);
    const double share = row - from;
    now.t_s = std::lerp(now.t_s, next.t_s, share);
    now.c_rad = std::lerp(now.c_rad, next.c_rad, share);
    now.position_mm = std::lerp(now.position_mm, next.position_mm, share);
    return now;
  }

 private:
  const ProbeStream& stream_;
  std::vector<Pass> passes_;
};

/// The same motion a little earlier or later.
Moment moved_on(const Moment& now, double time_s) {
  Moment then = now;
  then.t_s = time_s;
  then.c_rad += now.omega_rad_per_s * (time_s - now.t_s);
  then.position_mm += now.velocity_mm_per_s * (time_s - now.t_s);
  return then;
}

std::map<int, Prober> make_probers(const Scenario& scenario, const Chain& chain, const Body& body,
                                   const ProbeStream& recorded) {
  std::map<int, Prober> probers;
  for (const SetUp& stated : list_set_ups(recorded)) {
    const Chucking setup = find_setup(scenario.plan, stated.number);
    probers.emplace(stated.number, Prober(scenario, chain, body, setup));
  }
  return probers;
}

}  // namespace

Simulation simulate_with_truth(const Scenario& scenario) {
  validate(scenario.part);
  if (scenario.part.kind == PartKind::face) need_one_sensor(scenario);
  const std::vector<TimedPass> timeline = make_timeline(scenario.plan);
  const Chain chain = make_chain(scenario.effects);
  const Body body(scenario, chain);
  const std::vector<double>& angles = scenario.probe.sensor_angles_rad;
  const auto of_sensor = [&](std::size_t sensor) {
    const double angle_rad = angles.empty() ? 0.0 : angles[sensor];
    const auto make = [&](const Chucking& setup) {
      return Prober(scenario, chain, body, setup, angle_rad);
    };
    return record(timeline, recording_of(scenario, chain), make, sensor);
  };
  Simulation out = of_sensor(0);
  for (std::size_t sensor = 1; sensor < angles.size(); ++sensor)
    out.stream.more_reading_mm.push_back(std::move(of_sensor(sensor).stream.reading_mm));
  describe(scenario, out.stream);
  out.truth.scenario = scenario;
  return out;
}

ProbeStream simulate(const Scenario& scenario) {
  return std::move(simulate_with_truth(scenario).stream);
}

Simulation simulate_at(const Scenario& scenario, const ProbeStream& recorded) {
  const bool face = scenario.part.kind == PartKind::face;
  if (face != (recorded.kind == StreamKind::face))
    throw InputError("scenario", "a face is probed along Z, a lateral surface along X");
  need_one_sensor(scenario);
  expects(scenario.u_start_mm.has_value() && scenario.u_end_mm.has_value(), "the ends of u");
  validate(scenario.part);
  const Chain chain = make_chain(scenario.effects);
  const Body body(scenario, chain);
  const std::map<int, Prober> probers = make_probers(scenario, chain, body, recorded);
  const Recording how = recording_of(scenario, chain);
  Recorder recorder(how);

  Simulation out;
  out.stream = recorded;
  out.stream.reading_mm.clear();
  out.stream.reading_mm.reserve(recorded.size());
  out.truth.clean_mm.reserve(recorded.size());
  out.stream.source = out.stream.input_hash = "";
  const RecordedMotion motion(recorded);
  for (const Pass& pass : motion.passes()) {
    LagFilter lag(how.lag_s, pass.speed_rad_per_s);
    const bool lags = how.lag_s > 0.0 && pass.speed_rad_per_s != 0.0;
    const double per_turn = pass.readings_per_revolution;
    PlayFilter play(how.play_mm, per_turn > 0.0 ? two_pi / per_turn : 0.0);
    for (std::size_t i = pass.begin; i < pass.end; ++i) {
      const Prober& prober =
          probers.at(recorded.setup.empty() ? probers.begin()->first : recorded.setup[i]);
      const Moment now = motion.at(pass, i);
      const auto met = [&](const Moment& then) { return prober.read(then, false).value_mm; };
      const auto lagged = [&](const Moment& then) {
        return lags ? lag.at(then.t_s, [&](double time) { return met(moved_on(then, time)); })
                    : met(then);
      };
      CleanReading reading = prober.read(now, recorder.wants_incidence());
      if (how.play_mm > 0.0) {
        reading.value_mm = play.at(static_cast<double>(i),
                                   [&](double row) { return lagged(motion.between(pass, row)); });
      } else if (lags) {
        reading.value_mm = lagged(now);
      }
      recorder.add(reading, prober.away(), out);
    }
  }
  out.truth.scenario = scenario;
  return out;
}

}  // namespace trueaxis::virtual_lathe

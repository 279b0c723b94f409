// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <utility>
#include <vector>

#include "simulate/clean_stream.hpp"
#include "simulate/noise.hpp"
#include "simulate/prober.hpp"
#include "simulate/sensor_dynamics.hpp"
#include "simulate/timeline.hpp"
#include "trueaxis/virtual_lathe.hpp"

namespace trueaxis::virtual_lathe {

/// What happens to a reading between the sensor's head and the file.
struct Recording {
  Noise noise;
  std::uint64_t seed = 1;
  double lag_s = 0.0, play_mm = 0.0;
  SensorLimits sensor;
};

/// A sensor's indication: clipped to its limits, a gauge's zero subtracted, rounded.
struct Shown {
  double value_mm = 0.0;
  bool clipped = false;
};
inline Shown shown(const SensorLimits& sensor, double value_mm) {
  Shown out{value_mm, value_mm < sensor.low_mm || value_mm > sensor.high_mm};
  if (out.clipped) out.value_mm = value_mm < sensor.low_mm ? sensor.low_mm : sensor.high_mm;
  out.value_mm -= sensor.zero_mm;
  if (sensor.quantisation_mm > 0.0) {
    out.value_mm = std::round(out.value_mm / sensor.quantisation_mm) * sensor.quantisation_mm;
  }
  return out;
}

/// Turns clean readings into recorded ones, in their order.
class Recorder {
 public:
  /// Sensors of one recording differ by their number alone; the first has the scenario's noise.
  explicit Recorder(const Recording& how, std::size_t sensor = 0)
      : how_(how), noise_(how.noise, how.seed + 0x9E3779B97F4A7C15U * sensor) {}

  bool wants_incidence() const { return noise_.wants_incidence(); }

  void add(const CleanReading& reading, double away, Simulation& out) {
    const std::size_t row = out.stream.reading_mm.size();
    const NoiseDraw draw = noise_.draw(reading.tan_incidence, away);
    if (draw.outlier) out.truth.outlier_rows.push_back(row);
    const Shown recorded = shown(how_.sensor, reading.value_mm + draw.error_mm);
    if (recorded.clipped) out.truth.clipped_rows.push_back(row);
    out.stream.reading_mm.push_back(recorded.value_mm);
    out.truth.clean_mm.push_back(reading.value_mm - how_.sensor.zero_mm);
  }

 private:
  Recording how_;
  NoiseSource noise_;
};

/// What a scenario's chain and noise do between the sensor's head and the file.
Recording recording_of(const Scenario& scenario, const Chain& chain);

/// @throws InputError for a scenario with several sensors.
void need_one_sensor(const Scenario& scenario);

/// @throws InputError for a part that contradicts itself.
void validate(const Part& part);

/// Runs the timeline; `make_reader(setup)` gives an object with read(Moment, bool) and away().
template <class MakeReader>
CleanStream record_clean(const std::vector<TimedPass>& timeline, const Recording& how,
                         const MakeReader& make_reader) {
  CleanStream out;
  out.sensor = how.sensor;
  ProbeStream& stream = out.stream;
  std::mt19937_64 jitter = engine_for(how.seed, 4);
  const bool with_incidence = how.noise.incidence > 0.0;
  std::size_t total = 0;
  for (const TimedPass& pass : timeline) total += pass.count;
  for (auto* column : {&out.value_mm, &stream.c_rad, &stream.position_mm, &stream.time_s}) {
    column->reserve(total);
  }
  for (std::size_t p = 0; p < timeline.size(); ++p) {
    const TimedPass& pass = timeline[p];
    const auto reader = make_reader(pass.setup);
    LagFilter lag(how.lag_s, pass.omega_rad_per_s);
    PlayFilter play(how.play_mm, pass.omega_rad_per_s);
    const auto met = [&](double time) { return reader.read(pass.at(time), false).value_mm; };
    const auto lagged = [&](double time) {
      return how.lag_s > 0.0 ? lag.at(time, met) : met(time);
    };
    for (std::size_t i = 0; i < pass.count; ++i) {
      double t = pass.t_s + static_cast<double>(i) * pass.interval_s;
      if (pass.jitter > 0.0) t += pass.jitter * pass.interval_s * (uniform_01(jitter) - 0.5);
      const Moment moment = pass.at(t);
      CleanReading reading = reader.read(moment, with_incidence);
      if (how.play_mm > 0.0)
        reading.value_mm = play.at(t, lagged);
      else if (how.lag_s > 0.0)
        reading.value_mm = lagged(t);
      out.value_mm.push_back(reading.value_mm);
      if (with_incidence) out.tan_incidence.push_back(reading.tan_incidence);
      stream.c_rad.push_back(moment.c_rad);
      stream.position_mm.push_back(moment.position_mm);
      stream.time_s.push_back(moment.t_s);
    }
    out.away.insert(out.away.end(), pass.count, static_cast<signed char>(reader.away()));
    stream.pass.insert(stream.pass.end(), pass.count, static_cast<int>(p) + 1);
    stream.setup.insert(stream.setup.end(), pass.count, pass.setup.number);
  }
  return out;
}

/// The stream of a timeline with the noise of a scenario.
template <class MakeReader>
Simulation record(const std::vector<TimedPass>& timeline, const Recording& how,
                  const MakeReader& make_reader, std::size_t sensor = 0) {
  Recorder recorder(how, sensor);
  CleanStream clean = record_clean(timeline, how, make_reader);
  Simulation out{std::move(clean.stream), {}};
  for (std::size_t row = 0; row < clean.value_mm.size(); ++row) {
    const double tangent = clean.tan_incidence.empty() ? 0.0 : clean.tan_incidence[row];
    recorder.add({clean.value_mm[row], tangent}, clean.away[row], out);
  }
  return out;
}

/// What the stream states about itself: kind, gauge, noise, speed, set-ups.
void describe(const Scenario& scenario, ProbeStream& stream);

}  // namespace trueaxis::virtual_lathe

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

#include "simulate/lag_filter.hpp"
#include "simulate/noise_source.hpp"
#include "simulate/prober.hpp"
#include "simulate/timeline.hpp"
#include "trueaxis/simulate/simulate.hpp"

namespace trueaxis::virtual_lathe {

/// What happens to a reading between the sensor's head and the file.
struct Recording {
  Noise noise;
  Probe probe;
  std::uint64_t seed = 1;
  double lag_s = 0.0;
  double low_mm = -std::numeric_limits<double>::infinity();
  double high_mm = std::numeric_limits<double>::infinity();
  double quantisation_mm = 0.0;
};

/// Turns clean readings into recorded ones, in their order.
class Recorder {
 public:
  explicit Recorder(const Recording& how)
      : how_(how),
        noise_(how.noise, how.seed),
        zero_mm_(how.probe.relative_zero_mm.value_or(0.0)) {}

  bool wants_incidence() const { return noise_.wants_incidence(); }

  void add(const CleanReading& reading, double away, Simulation& out) {
    const std::size_t row = out.stream.reading_mm.size();
    const NoiseDraw draw = noise_.draw(reading.tan_incidence, away);
    if (draw.outlier) out.truth.outlier_rows.push_back(row);
    double value = reading.value_mm + draw.error_mm;
    if (value < how_.low_mm || value > how_.high_mm) {
      value = value < how_.low_mm ? how_.low_mm : how_.high_mm;
      out.truth.clipped_rows.push_back(row);
    }
    value -= zero_mm_;
    if (how_.quantisation_mm > 0.0) {
      value = std::round(value / how_.quantisation_mm) * how_.quantisation_mm;
    }
    out.stream.reading_mm.push_back(value);
    out.truth.clean_mm.push_back(reading.value_mm - zero_mm_);
  }

 private:
  Recording how_;
  NoiseSource noise_;
  double zero_mm_;
};

/// What a scenario's chain and noise do between the sensor's head and the file.
Recording recording_of(const Scenario& scenario, const Chain& chain);

/// @throws InputError for a part that contradicts itself.
void validate(const Part& part);

/// Runs the timeline; `make_reader(setup)` gives an object with read(Moment, bool) and away().
template <class MakeReader>
Simulation record(const std::vector<TimedPass>& timeline, const Recording& how,
                  const MakeReader& make_reader) {
  Simulation out;
  ProbeStream& stream = out.stream;
  Recorder recorder(how);
  std::mt19937_64 jitter = engine_for(how.seed, 4);
  std::size_t total = 0;
  for (const TimedPass& pass : timeline) total += pass.count;
  for (auto* column : {&stream.reading_mm, &stream.c_rad, &stream.position_mm, &stream.time_s,
                       &out.truth.clean_mm}) {
    column->reserve(total);
  }
  for (std::size_t p = 0; p < timeline.size(); ++p) {
    const TimedPass& pass = timeline[p];
    const auto reader = make_reader(pass.setup);
    LagFilter lag(how.lag_s, pass.omega_rad_per_s);
    for (std::size_t i = 0; i < pass.count; ++i) {
      double t = pass.t_s + static_cast<double>(i) * pass.interval_s;
      if (pass.jitter > 0.0) t += pass.jitter * pass.interval_s * (uniform_01(jitter) - 0.5);
      const Moment moment = pass.at(t);
      CleanReading reading = reader.read(moment, recorder.wants_incidence());
      if (how.lag_s > 0.0) {
        reading.value_mm =
            lag.at(t, [&](double time) { return reader.read(pass.at(time), false).value_mm; });
      }
      recorder.add(reading, reader.away(), out);
      stream.c_rad.push_back(moment.c_rad);
      stream.position_mm.push_back(moment.position_mm);
      stream.time_s.push_back(moment.t_s);
    }
    stream.pass.insert(stream.pass.end(), pass.count, static_cast<int>(p) + 1);
    stream.setup.insert(stream.setup.end(), pass.count, pass.setup.number);
  }
  return out;
}

/// What the stream states about itself: kind, gauge, noise, speed, set-ups.
void describe(const Scenario& scenario, ProbeStream& stream);

}  // namespace trueaxis::virtual_lathe

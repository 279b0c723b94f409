// SPDX-License-Identifier: Apache-2.0
#include "simulate/clean_stream.hpp"

#include "simulate/recorder.hpp"

namespace trueaxis::virtual_lathe {

CleanStream simulate_clean(const Scenario& scenario) {
  validate(scenario.part);
  validate(scenario.noise);
  const std::vector<TimedPass> timeline = make_timeline(scenario.plan);
  const Chain chain = make_chain(scenario.effects);
  const Body body(scenario, chain);
  CleanStream out =
      record_clean(timeline, recording_of(scenario, chain),
                   [&](const Chucking& setup) { return Prober(scenario, chain, body, setup); });
  for (const double value_mm : out.value_mm)
    out.stream.reading_mm.push_back(shown(out.sensor, value_mm).value_mm);
  describe(scenario, out.stream);
  return out;
}

}  // namespace trueaxis::virtual_lathe

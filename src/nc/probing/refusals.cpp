// SPDX-License-Identifier: Apache-2.0
#include "nc/probing/refusals.hpp"

#include <algorithm>
#include <cmath>

#include "nc/probing/refusal_list.hpp"

namespace trueaxis::nc {
namespace {

constexpr double least_turns = 1.0;  // of a run-in

void about_the_probe(const ProbingPlan& plan, const ProbingLimits& limits, ProbingControl control,
                     RefusalList& refusals) {
  if (limits.kind == ProbeKind::analogue) {
    refusals.unless(control == ProbingControl::linuxcnc,
                    "an analogue probe is read by LinuxCNC's sampler only: write the program "
                    "for it, or use a probe of kind = \"touch\"");
    for (std::size_t k = 0; k < plan.passes.size(); ++k) {
      const ProbingPass& pass = plan.passes[k];
      const double rate = (static_cast<double>(pass.readings) - 1.0) / pass.seconds;
      refusals.unless(rate <= limits.rate_hz * (1.0 + 1e-9),
                      "pass {} needs {:.4g} readings per second and the probe gives {:.4g}: "
                      "plan fewer readings per revolution, or a lower speed",
                      k + 1, rate, limits.rate_hz);
      refusals.unless(std::abs(pass.rpm()) <= limits.speed_rpm,
                      "pass {} turns at {:.4g} rpm and the limit is {:.4g} rpm", k + 1,
                      std::abs(pass.rpm()), limits.speed_rpm);
    }
    return;
  }
  // Touch points are taken at standstill: a second speed would be no other measurement.
  double slowest = 0.0, fastest = 0.0;
  for (const ProbingPass& pass : plan.passes) {
    if (pass.turns == 0.0) continue;
    const double rpm = std::abs(pass.rpm());
    slowest = slowest == 0.0 ? rpm : std::min(slowest, rpm);
    fastest = std::max(fastest, rpm);
  }
  refusals.unless(fastest <= slowest * (1.0 + 1e-6),
                  "the plan compares {:.4g} and {:.4g} rpm, and a touch probe measures at "
                  "standstill: it needs a probe of kind = \"analogue\"",
                  slowest, fastest);
}

}  // namespace

double run_in(const ProbingPass& pass, const ProbingLimits& limits) {
  if (limits.kind == ProbeKind::touch || pass.turns == 0.0) return 0.0;
  return std::max(least_turns / std::abs(pass.turns), limits.spin_up_s / pass.seconds);
}

void expect_drivable(std::span<const ProbingPlan> plans, const ProbingLimits& limits,
                     ProbingControl control, const std::string& file) {
  RefusalList refusals(file);
  for (const ProbingPlan& plan : plans) {
    refusals.about(plan.log);
    expect_room(plan, limits, refusals);
    about_the_probe(plan, limits, control, refusals);
  }
  refusals.about("");
  refusals.unless(control != ProbingControl::fanuc || plans.size() == 1,
                  "DPRNT of a FANUC control writes one log: write a program for each reference, by "
                  "the name of its stream");
  refusals.unless(limits.kind == ProbeKind::touch || plans.size() == 1,
                  "halsampler writes one file: with an analogue probe, write a program for each "
                  "reference, by the name of its stream");
  refusals.unless(control == ProbingControl::fanuc || !limits.x_diameter,
                  "x = \"diameter\" is for FANUC: the programs of other controls measure radii");
  refusals.unless(control != ProbingControl::heidenhain || limits.work_offset.empty(),
                  "a HEIDENHAIN control has presets: activate one at the control and take "
                  "work_offset out");
  refusals.unless(control != ProbingControl::fanuc || limits.gcode_system != 0,
                  "a FANUC lathe needs gcode_system = \"A\", \"B\" or \"C\" in [control]: G90 and "
                  "G94 are cycles in system A");
  refusals.throw_if_any();
}

}  // namespace trueaxis::nc

// SPDX-License-Identifier: Apache-2.0
#include "nc/probing/refusals.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "trueaxis/error.hpp"

namespace trueaxis::nc {
namespace {

class Refusals {
 public:
  explicit Refusals(std::string file) : file_(std::move(file)) {}
  template <class... Values>
  void unless(bool fine, fmt::format_string<Values...> text, Values&&... values) {
    if (!fine) list_.push_back({file_, 0, 0, fmt::format(text, std::forward<Values>(values)...)});
  }
  void throw_if_any() {
    if (!list_.empty()) throw InputError(std::move(list_));
  }

 private:
  std::string file_;
  std::vector<Diagnostic> list_;
};

constexpr double least_turns = 1.0;  // of a run-in

/// Z that a pass reaches, its run-in and run-out included.
std::pair<double, double> z_of(const ProbingPass& pass, const ProbingLimits& limits) {
  const double before = run_in(pass, limits) * (pass.end_mm - pass.start_mm);
  return std::minmax({pass.start_mm - before, pass.end_mm + before});
}

void about_the_probe(const ProbingPlan& plan, const ProbingLimits& limits, ProbingControl control,
                     Refusals& refusals) {
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

void expect_drivable(const ProbingPlan& plan, const ProbingLimits& limits, ProbingControl control,
                     const std::string& file) {
  Refusals refusals(file);
  const double clear_x = limits.clear_x_mm(), clear_z = limits.clear_z_mm();
  refusals.unless(clear_x <= limits.x_high_mm,
                  "rapid moves need X {:.4g} mm (reach, ball and clearance) and X ends at {:.4g} "
                  "mm",
                  clear_x, limits.x_high_mm);
  refusals.unless(
      clear_z <= limits.z_high_mm,
      "the probe leaves at Z {:.4g} mm (front, ball and clearance) and Z ends at {:.4g} "
      "mm",
      clear_z, limits.z_high_mm);
  const bool rear = std::ranges::any_of(plan.passes, &ProbingPass::rear);
  refusals.unless(!rear || -clear_x >= limits.x_low_mm,
                  "the rear side needs X {:.4g} mm and X begins at {:.4g} mm: probe from the "
                  "front only, or state what the slide can do",
                  -clear_x, limits.x_low_mm);
  for (std::size_t k = 0; k < plan.passes.size(); ++k) {
    const auto [low, high] = z_of(plan.passes[k], limits);
    refusals.unless(low >= limits.z_low_mm && high <= limits.z_high_mm,
                    "pass {} runs from Z {:.4g} to {:.4g} mm with run-in and run-out, and Z goes "
                    "from {:.4g} to {:.4g} mm",
                    k + 1, low, high, limits.z_low_mm, limits.z_high_mm);
    const double free_end = std::max(plan.passes[k].start_mm, plan.passes[k].end_mm);
    refusals.unless(
        free_end <= limits.front_mm,
        "pass {} probes up to Z {:.4g} mm and the part ends at front_mm = {:.4g}: rapid "
        "moves in front of it would meet what is probed",
        k + 1, free_end, limits.front_mm);
    const double thick = plan.slope > 0.0 ? high : low, thin = plan.slope > 0.0 ? low : high;
    refusals.unless(plan.radius_at(thick) <= limits.reach_mm,
                    "the part has a radius of {:.4g} mm at Z {:.4g} mm and reach_mm is {:.4g}: "
                    "state how far part and chuck reach",
                    plan.radius_at(thick), thick, limits.reach_mm);
    refusals.unless(plan.radius_at(thin) + limits.ball_radius_mm > limits.search_mm,
                    "the part has a radius of {:.4g} mm at Z {:.4g} mm: a probe that searches "
                    "{:.4g} mm farther would pass the axis",
                    plan.radius_at(thin), thin, limits.search_mm);
  }
  about_the_probe(plan, limits, control, refusals);
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

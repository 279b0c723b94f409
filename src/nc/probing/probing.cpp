// SPDX-License-Identifier: Apache-2.0
#include "nc/probing/probing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "nc/number_text.hpp"
#include "nc/probing/dialect.hpp"
#include "nc/probing/refusals.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis::nc {
namespace {

constexpr double seconds_beside = 1.5;  // of a touch: rapid moves and indexing, about

/// Where a dry run turns back: half of the clearance away.
double dry_mm(const Approach& way, const ProbingLimits& limits) {
  return way.clear_mm + 0.5 * way.sense * limits.clearance_mm;
}

TouchRun touch_run(const ProbingPlan& plan, const ProbingPass& pass, int number,
                   const ProbingLimits& limits, bool dry_run) {
  TouchRun run;
  run.pass = number, run.approach = approach_of(plan, pass, limits), run.count = pass.readings;
  const Approach& way = run.approach;
  const double steps = static_cast<double>(std::max<std::size_t>(pass.readings, 2) - 1);
  run.c_deg = pass.c_rad / rad_per_deg, run.c_step_deg = 360.0 * pass.turns / steps;
  run.along_mm = pass.start_mm, run.along_step_mm = (pass.end_mm - pass.start_mm) / steps;
  run.stop_mm =
      dry_run ? dry_mm(way, limits) : way.met_at(pass.start_mm) + way.sense * limits.search_mm;
  run.stop_step_mm = dry_run ? 0.0 : way.slope * run.along_step_mm;
  return run;
}

ScanRun scan_run(const ProbingPlan& plan, const ProbingPass& pass, int number,
                 const ProbingLimits& limits, bool dry_run) {
  ScanRun run;
  run.pass = number, run.approach = approach_of(plan, pass, limits);
  run.rpm = std::abs(pass.rpm()), run.seconds = pass.seconds;
  const double before = run_in(pass, limits);
  const auto at = [&](double share) {
    const double along = pass.start_mm + share * (pass.end_mm - pass.start_mm);
    return ScanPoint{360.0 * pass.turns * (share + before), along,
                     dry_run ? dry_mm(run.approach, limits) : run.approach.met_at(along)};
  };
  run.begin = at(-before), run.end = at(1.0 + before);
  return run;
}

double seconds_of(const ProbingPass& pass, const ProbingPlan& plan, const ProbingLimits& limits) {
  if (limits.kind == ProbeKind::analogue) return pass.seconds;
  const Approach way = approach_of(plan, pass, limits);
  return static_cast<double>(pass.readings) *
         (std::abs(way.clear_mm - way.met_at(pass.start_mm)) / limits.feed_mm_per_s +
          seconds_beside);
}

/// What is to be known of a program before it is run; `out` gets its readings and time.
std::vector<std::string> head_of(std::span<const ProbingPlan> plans, const ProbingLimits& limits,
                                 bool dry_run, ProbingProgram& out) {
  std::vector<std::string> remarks, ways;
  for (const ProbingPlan& plan : plans) {
    remarks.push_back(plain_words(plan.what));
    for (const ProbingPass& pass : plan.passes) {
      out.readings += pass.readings;
      out.minutes += seconds_of(pass, plan, limits) / 60.0;
    }
    if (plan.surface == ProbedSurface::bore)
      ways.push_back(fmt::format(
          "inside a bore that is free to X {} and Z {}, by a stylus along Z of {} mm",
          short_number(*limits.bore_radius_mm, 3), short_number(*limits.bore_bottom_mm, 3),
          short_number(*limits.stylus_length_mm, 3)));
    if (plan.surface == ProbedSurface::face)
      ways.emplace_back("Z is that of the centre of the ball: so must the length of the probe be");
  }
  remarks.push_back(fmt::format("{} {}, about {:.1f} min", out.readings,
                                limits.kind == ProbeKind::touch ? "touch points" : "readings",
                                out.minutes));
  remarks.insert(remarks.end(), ways.begin(), ways.end());
  if (dry_run) remarks.emplace_back("dry run: the probe stays off the part and nothing is logged");
  return remarks;
}

std::string described(const ProbingPass& pass, int number, char along, ProbeKind kind) {
  std::string text = fmt::format("pass {}: {} {} to {} mm, {} turns", number, along,
                                 short_number(pass.start_mm, 3), short_number(pass.end_mm, 3),
                                 short_number(pass.turns, 2));
  if (kind == ProbeKind::analogue)
    text += fmt::format(" at {} rpm", short_number(std::abs(pass.rpm()), 1));
  return text + fmt::format(", {} readings{}", pass.readings, pass.rear ? ", rear side" : "");
}

}  // namespace

std::string short_number(double value, int decimals) {
  std::string text;
  append_number(text, rounded(value, decimals), decimals);
  if (decimals > 0) {
    text.erase(text.find_last_not_of('0') + 1);
    if (text.ends_with('.')) text.pop_back();
  }
  return text;
}

std::string plain_words(std::string words) {
  for (char& c : words) {
    if (c == '(') c = '[';
    if (c == ')') c = ']';
    if (c < ' ' || c > '~') c = '?';
  }
  return words;
}

int set_up_of(const ProbingPass& pass) { return pass.rear ? 2 : 1; }

/// Samples before the pass is at its start with its speed, for any acceleration that reaches it in
/// the time stated; as many are after its end.
static std::size_t lead(const ProbingPass& pass, const ProbingLimits& limits) {
  if (pass.turns == 0.0) return 0;
  const double seconds = run_in(pass, limits) * pass.seconds + 0.5 * limits.spin_up_s;
  return static_cast<std::size_t>(std::ceil(seconds * limits.rate_hz));
}

std::vector<std::string> log_head(const ProbingPlan& plan, const ProbingLimits& limits) {
  const bool touch = limits.kind == ProbeKind::touch;
  std::vector<std::string> lines{"TRUEAXIS PROBE LOG 1", touch ? "ROWS TOUCH" : "ROWS SAMPLES",
                                 "UNIT MM", limits.x_diameter ? "X DIAMETER" : "X RADIUS",
                                 "BALL NM " + short_number(1e6 * limits.ball_radius_mm, 0)};
  if (plan.surface == ProbedSurface::bore) lines.emplace_back("FEATURE BORE");
  if (plan.surface == ProbedSurface::face) lines.emplace_back("READS Z");
  if (!touch) lines.push_back("PERIOD NS " + short_number(1e9 / limits.rate_hz, 0));
  for (std::size_t k = 0; k < plan.passes.size(); ++k) {
    const ProbingPass& pass = plan.passes[k];
    const double taken = limits.rate_hz * pass.seconds / static_cast<double>(pass.readings);
    std::string line =
        fmt::format("PASS {} SETUP {} {} ", k + 1, set_up_of(pass), pass.rear ? "REAR" : "FRONT");
    if (touch)
      line += fmt::format("COUNT {}", pass.readings);
    else
      line += fmt::format("EVERY {} LEAD {}", static_cast<std::size_t>(std::max(taken, 1.0)),
                          lead(pass, limits));
    lines.push_back(std::move(line));
  }
  lines.emplace_back("START");
  return lines;
}

/// To the side that a pass probes, from that of the one before; none: from where the probe is
/// clear.
static void come_to(Dialect& words, const ProbingPlan& plan, const ProbingPass& pass,
                    const ProbingPass* before, const ProbingLimits& limits) {
  const double clear = approach_of(plan, pass, limits).clear_mm;
  switch (plan.surface) {
    case ProbedSurface::shaft:
      if (pass.rear == (before != nullptr && before->rear)) return;
      words.rapid('Z', limits.clear_z_mm());  // around the free end of the part
      return words.rapid('X', clear);
    case ProbedSurface::bore:
      if (before != nullptr && pass.rear == before->rear) return;
      words.rapid('X', clear);
      if (before == nullptr) words.feed('Z', pass.start_mm);
      return;
    case ProbedSurface::face:
      return;
  }
}

/// The passes of a plan, from a clear position, and back to in front of the part.
static void drive(Dialect& words, const ProbingPlan& plan, const ProbingLimits& limits,
                  bool dry_run) {
  if (plan.surface == ProbedSurface::shaft)
    words.rapid('X', limits.clear_x_mm());
  else
    words.rapid('Z', limits.clear_z_mm());
  const ProbingPass* before = nullptr;
  for (std::size_t k = 0; k < plan.passes.size(); ++k) {
    const ProbingPass& pass = plan.passes[k];
    const int number = static_cast<int>(k + 1);
    const Approach way = approach_of(plan, pass, limits);
    words.remark(described(pass, number, way.along(), limits.kind));
    come_to(words, plan, pass, std::exchange(before, &pass), limits);
    if (limits.kind == ProbeKind::touch)
      words.touch(touch_run(plan, pass, number, limits, dry_run));
    else
      words.scan(scan_run(plan, pass, number, limits, dry_run));
    words.rapid(way.axis, way.clear_mm);
  }
  words.rapid('Z', limits.clear_z_mm());
}

ProbingProgram write_probing(std::span<const ProbingPlan> plans, const ProbingLimits& limits,
                             ProbingControl control, const std::string& name, bool dry_run,
                             const std::string& file) {
  expect_drivable(plans, limits, control, file);
  const auto make = control == ProbingControl::fanuc        ? fanuc_dialect
                    : control == ProbingControl::siemens    ? siemens_dialect
                    : control == ProbingControl::heidenhain ? heidenhain_dialect
                                                            : linuxcnc_dialect;
  const std::unique_ptr<Dialect> words = make(limits, name, dry_run);
  ProbingProgram out;
  words->begin(head_of(plans, limits, dry_run, out));
  for (const ProbingPlan& plan : plans) {
    if (plans.size() > 1) words->remark(plain_words(plan.what));
    if (!dry_run)
      words->open_log(plan.log.empty() ? name : name + "_" + plan.log, log_head(plan, limits));
    drive(*words, plan, limits, dry_run);
    if (!dry_run) words->close_log();
  }
  words->end();
  out.text = words->text();
  return out;
}

}  // namespace trueaxis::nc

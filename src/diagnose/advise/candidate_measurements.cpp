// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "base/number.hpp"
#include "diagnose/advise/advise.hpp"
#include "math/golden_section.hpp"
#include "math/statistics.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis::diagnose_detail {
namespace {

constexpr std::size_t thinned_to = 600;        // readings of what was measured
constexpr double most_readings = 2000.0;       // of a plan, thinned likewise
constexpr double second_speed = 151.0 / 60.0;  // no simple ratio: no order meets a line
constexpr double least_per_turn = 8.3;         // readings that a faster turn must still have
constexpr double jog_mm = 0.1, reindex_rad = 70.0 * rad_per_deg, less_force = 0.5;
constexpr double minutes_to_clamp = 5.0, minutes_to_turn_probe = 2.0, minutes_between = 0.2;

/// How the longest pass ran.
struct Manner {
  double z_start = 0.0, z_end = 0.0, feed = 1.0, speed = two_pi, per_turn = 24.0, seconds = 60.0;
  int sign = 1;
  double dwelt = 0.0;  ///< turns of a dwell

  double turns() const {
    return sign * (z_start != z_end ? std::abs(z_end - z_start) / feed : dwelt);
  }
};
Manner manner_of(const LinearisationPoint& point) {
  const Pass* best = nullptr;
  for (const Pass& p : point.passes)
    if (p.c_sign != 0 && (!best || p.end - p.begin > best->end - best->begin)) best = &p;
  Manner m;
  const auto [low, high] = std::ranges::minmax(point.z);
  m.z_start = low, m.z_end = high;
  if (!best) return m;
  m.sign = best->c_sign;
  if (best->feed_sign != 0) {
    m.z_start = point.z[best->begin], m.z_end = point.z[best->end - 1];
    m.feed = std::max(std::abs(best->feed_mm_per_rev), 1e-6);
  } else {
    m.feed = std::max((high - low) / 30.0, 1e-6);
  }
  if (point.has_time && best->speed_rad_per_s != 0.0) m.speed = std::abs(best->speed_rad_per_s);
  if (best->readings_per_revolution > 1.0) m.per_turn = best->readings_per_revolution;
  m.dwelt = static_cast<double>(best->end - best->begin) / m.per_turn;
  m.seconds = std::abs(m.turns()) * two_pi / m.speed;
  return m;
}

/// A run of the probe, C and Z linear in time.
struct Motion {
  double z_from, z_to, turns, seconds;
  double turned = 0.37;  ///< C from the run before, rad
};
void append(ProbeStream& stream, const Motion& motion, double readings, int pass, int setup) {
  const auto count = static_cast<std::size_t>(std::clamp(std::round(readings), 2.0, most_readings));
  const double t0 = stream.time_s.empty() ? 0.0 : stream.time_s.back() + 2.0;
  const double c0 = stream.c_rad.empty() ? 0.0 : stream.c_rad.back() + motion.turned;
  for (std::size_t k = 0; k < count; ++k) {
    // A golden sequence, sorted within its own cell: dense, and no order an alias of another.
    const double part = (static_cast<double>(k) + golden_share(k)) / static_cast<double>(count);
    stream.reading_mm.push_back(0.0);
    stream.c_rad.push_back(c0 + two_pi * motion.turns * part);
    stream.position_mm.push_back(motion.z_from + (motion.z_to - motion.z_from) * part);
    stream.time_s.push_back(t0 + motion.seconds * part);
    stream.pass.push_back(pass);
    stream.setup.push_back(setup);
  }
}

ProbeStream thinned(const ProbeStream& stream, const LinearisationPoint& point) {
  ProbeStream out;
  out.kind = stream.kind, out.indication = stream.indication;
  int number = 0;
  for (const Pass& pass : point.passes) {
    ++number;
    const auto size = pass.end - pass.begin;
    const std::size_t share = std::max<std::size_t>(4, thinned_to * size / point.size());
    const std::size_t count = std::min(size, share);
    std::size_t last = point.size();
    for (std::size_t k = 0; k < count; ++k) {
      const auto i =
          std::min(size - 1, static_cast<std::size_t>((static_cast<double>(k) + golden_share(k)) *
                                                      static_cast<double>(size) /
                                                      static_cast<double>(count)));
      if (pass.begin + i == last) continue;
      last = pass.begin + i;
      out.reading_mm.push_back(0.0);
      out.c_rad.push_back(point.c[last]);
      out.position_mm.push_back(point.z[last]);
      out.time_s.push_back(point.time[last]);
      out.pass.push_back(number);
      out.setup.push_back(stream.setup.empty() ? 1 : stream.setup[last]);
    }
  }
  return out;
}

/// What was measured, before anything is added.
CandidateMeasurement measured(const ProbeStream& stream, const LinearisationPoint& point,
                              const std::vector<Clamping>& clampings) {
  CandidateMeasurement out;
  out.stream = thinned(stream, point), out.clampings = clampings;
  out.weight = static_cast<double>(point.size()) / static_cast<double>(out.stream.size());
  return out;
}

/// Whether the control can bring one clamping about from another: at most from the other side.
bool same_place(const Clamping& a, const Clamping& b) {
  return a.reindex_rad == b.reindex_rad && a.z_shift_mm == b.z_shift_mm &&
         a.x_jog_mm == b.x_jog_mm && a.clamp_force_ratio == b.clamp_force_ratio && a.axis == b.axis;
}

/// The passes that were measured; none: the control cannot make them again.
std::vector<ProbingRun> runs_measured(const LinearisationPoint& point,
                                      const std::vector<Clamping>& clampings, const Manner& m) {
  std::vector<ProbingRun> runs;
  if (!point.has_position) return runs;
  for (const Pass& pass : point.passes) {
    const auto found = std::ranges::find(clampings, pass.setup, &Clamping::number);
    const Clamping& clamping = found == clampings.end() ? clampings.back() : *found;
    if (!same_place(clamping, clampings.back())) return {};
    const std::size_t last = pass.end - 1;
    ProbingRun run{point.z[pass.begin], point.z[last]};
    run.turns = pass.c_sign == 0 ? 0.0 : (point.c[last] - point.c[pass.begin]) / two_pi;
    run.seconds = point.has_time ? point.time[last] - point.time[pass.begin]
                                 : std::abs(run.turns) * two_pi / m.speed;
    run.readings = static_cast<double>(pass.end - pass.begin);
    run.rear = clamping.root == Root::rear;
    if (run.seconds > 0.0) runs.push_back(run);
  }
  return runs;
}

ProbingRun run_of(const Motion& motion, double readings, bool rear) {
  return {motion.z_from, motion.z_to, motion.turns, motion.seconds, readings, rear, motion.turned};
}

int last_number(const std::vector<Clamping>& clampings) {
  return std::ranges::max_element(clampings, {}, &Clamping::number)->number;
}

}  // namespace

CandidateMeasurement measurement_at_hand(const ProbeStream& stream, const LinearisationPoint& point,
                                         const std::vector<Clamping>& clampings) {
  return measured(stream, point, clampings);
}

double fastest_ratio(const LinearisationPoint& point) {
  return std::max(second_speed, manner_of(point).per_turn / least_per_turn);
}

CandidateMeasurement faster_measurement(const ProbeStream& stream, const LinearisationPoint& point,
                                        const std::vector<Clamping>& clampings, double ratio,
                                        double off_centre_mm) {
  const Manner m = manner_of(point);
  CandidateMeasurement p = measured(stream, point, clampings);
  p.code = "2W";
  const double rpm = m.speed * 60.0 / two_pi;
  const double readings = std::abs(m.turns()) * m.per_turn / p.weight;
  int pass = p.stream.pass.back() + 1, number = clampings.back().number;
  std::string first = fmt::format("probe back at {:.4g} rpm", ratio * rpm);
  p.minutes = minutes_between + m.seconds / 60.0;
  if (off_centre_mm > 0.0) {
    Clamping next = clampings.back();
    next.number = number = last_number(clampings) + 1;
    next.axis += 1;
    next.shape.axis.x_mm = off_centre_mm, next.shape.axis.y_mm = 0.0;
    p.clampings.push_back(next);
    append(p.stream, {m.z_start, m.z_end, m.turns(), m.seconds}, readings, pass++, number);
    first = fmt::format(
        "clamp the part {:.2g} mm off-centre, probe it at {:.4g} and back at {:.4g} rpm",
        off_centre_mm, rpm, ratio * rpm);
    p.minutes += minutes_to_clamp + m.seconds / 60.0 + minutes_between;
  }
  const Motion back{m.z_end, m.z_start, ratio * m.turns(), m.seconds};
  append(p.stream, back, readings, pass, number);
  if (off_centre_mm == 0.0) p.runs = runs_measured(point, clampings, m);
  if (!p.runs.empty())
    p.runs.push_back(run_of(back, readings * p.weight, clampings.back().root == Root::rear));
  p.what = first + ", in the same time: this separates delay and lag by their second orders";
  return p;
}

std::vector<CandidateMeasurement> candidate_measurements(const ProbeStream& stream,
                                                         const LinearisationPoint& point,
                                                         const std::vector<Clamping>& clampings,
                                                         double wave_mm) {
  const Manner m = manner_of(point);
  const CandidateMeasurement hand = measured(stream, point, clampings);
  const ProbeStream& before = hand.stream;
  const double weight = hand.weight;
  const int pass = before.pass.back() + 1;
  const Clamping& now = clampings.back();
  const int setup = last_number(clampings);
  const double turns = m.turns();
  const double rpm = m.speed * 60.0 / two_pi;
  const std::vector<ProbingRun> runs = runs_measured(point, clampings, m);
  std::vector<CandidateMeasurement> list;

  const auto add = [&](const char* code, const std::string& what, double minutes,
                       const std::vector<Motion>& motions,
                       const std::function<void(Clamping&)>& change) {
    CandidateMeasurement p{code, what, minutes + minutes_between, before, clampings, weight};
    int number = now.number;
    if (change) {
      Clamping next = now;
      next.number = number = setup + 1;
      change(next);
      p.clampings.push_back(next);
    }
    const Clamping& then = p.clampings.back();
    const bool driven = !runs.empty() && same_place(then, now);
    if (driven) p.runs = runs;
    int own = pass;
    for (const Motion& motion : motions) {
      const double run =
          motion.turns != 0.0 ? std::abs(motion.turns) : motion.seconds * m.speed / two_pi;
      append(p.stream, motion, run * m.per_turn / weight, own++, number);
      if (driven) p.runs.push_back(run_of(motion, run * m.per_turn, then.root == Root::rear));
    }
    list.push_back(std::move(p));
  };
  const std::vector<Motion> same{{m.z_start, m.z_end, turns, m.seconds}};
  const double pass_minutes = m.seconds / 60.0;
  const bool timed = point.has_time;
  const bool along = point.has_position && m.z_start != m.z_end, face = point.base.face;
  const char* feed = face ? "X" : "Z";
  if (along) {
    add("RZ",
        fmt::format("probe back from {} {:.6g} to {:.6g} mm at {:.4g} rpm", feed,
                    hundredths(m.z_end), hundredths(m.z_start), rpm),
        pass_minutes, {{m.z_end, m.z_start, turns, m.seconds}}, nullptr);
  }
  if (timed) {
    add("2W",
        fmt::format("probe back at {:.4g} rpm, the same feed per revolution", rpm * second_speed),
        pass_minutes / second_speed, {{m.z_end, m.z_start, turns, m.seconds / second_speed}},
        nullptr);
    add("RV", fmt::format("probe again with the spindle reversed, {:.4g} rpm", -rpm * m.sign),
        pass_minutes, {{m.z_start, m.z_end, -turns, m.seconds}}, nullptr);
  }
  const double middle = 0.5 * (m.z_start + m.z_end),
               dwell = std::max(10.0, std::min(60.0, m.seconds));
  add("DW",
      fmt::format("dwell {:.3g} s at {} {:.6g} mm, {:.4g} rpm", dwell, feed, hundredths(middle),
                  rpm),
      dwell / 60.0, {{middle, middle, m.sign * dwell * m.speed / two_pi, dwell}}, nullptr);
  if (timed) {
    add("ST",
        fmt::format(
            "10 s at {} {:.6g} mm with the spindle at standstill, and 10 s a quarter turn further",
            feed, hundredths(middle)),
        20.0 / 60.0, {{middle, middle, 0.0, 10.0}, {middle, middle, 0.0, 10.0, 0.25 * two_pi}},
        nullptr);
  }
  add("RC", "turn the part by 70° against the spindle, clamp it again and probe it again",
      pass_minutes + minutes_to_clamp, same, [&](Clamping& c) {
        c.reindex_rad += reindex_rad, c.axis += 1;
        // Clamped again the part runs out otherwise: what goes with the eccentricity shows.
        c.shape.axis.x_mm = -c.shape.axis.x_mm + 0.05;
        if (!face) return;
        Axis& axis = c.shape.axis;
        axis = {0.0, 0.0, -axis.slope_x + 5e-4, -axis.slope_y, axis.z_ref_mm};
      });
  if (face && !point.two_sided) {
    add("RE",
        fmt::format("probe the other side of the axis, from X {:.6g} to {:.6g} mm",
                    hundredths(-m.z_end), hundredths(-m.z_start)),
        pass_minutes, {{-m.z_end, -m.z_start, turns, m.seconds}}, nullptr);
  }
  if (!face) {
    // The same way along Z, a drift is a slide out of parallel; only back, it is a taper.
    const char* side = now.root == Root::rear ? "front" : "rear";
    std::vector<Motion> motions = same;
    std::string what = fmt::format("probe again from the {} side", side);
    if (along) {
      motions.insert(motions.begin(), {m.z_end, m.z_start, turns, m.seconds});
      what = fmt::format("probe from the {} side, from Z {:.6g} to {:.6g} mm and back", side,
                         hundredths(m.z_end), hundredths(m.z_start));
    }
    add("RE", what, static_cast<double>(motions.size()) * pass_minutes + minutes_to_turn_probe,
        motions, [](Clamping& c) { c.root = c.root == Root::front ? Root::rear : Root::front; });
  }
  if (along && !face) {
    double shift = wave_mm > 0.0 ? 0.5 * wave_mm : 0.4 * point.z_half_mm;
    // The other way where a cone's apex would come near the probed length.
    const auto [least_x, most_x] = point.x_mm;
    const double thinnest = std::min(std::abs(least_x), std::abs(most_x));
    if (now.shape.tan_half_angle * shift > 0.5 * thinnest) shift = -shift;
    add("OZ",
        fmt::format("shift the part by {:.3g} mm along Z, clamp it again and probe it again",
                    shift),
        pass_minutes + minutes_to_clamp, same, [&](Clamping& c) {
          c.z_shift_mm += shift, c.axis += 1;
          c.shape.axis.z_ref_mm += shift;
        });
  }
  add("RM", "clamp the part again with half the force and probe it again",
      pass_minutes + minutes_to_clamp, same,
      [&](Clamping& c) { c.clamp_force_ratio *= less_force, c.axis += 1; });
  if (!face) {
    add("XJ", "jog X by +100 µm (x_jog) and probe again", pass_minutes + minutes_between, same,
        [&](Clamping& c) { c.x_jog_mm += jog_mm; });
  }
  std::erase_if(
      list, [](const CandidateMeasurement& m) { return !every_line_meets(m.stream, m.clampings); });
  return list;
}

}  // namespace trueaxis::diagnose_detail

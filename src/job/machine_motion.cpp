// SPDX-License-Identifier: Apache-2.0
#include "job/machine_motion.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "form/harmonics.hpp"
#include "job/loop_evidence.hpp"
#include "math/statistics.hpp"
#include "trueaxis/diagnosis.hpp"
#include "trueaxis/effect.hpp"
#include "trueaxis/error.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

constexpr double agree_by_chance = 0.01;  // that the forms of parts agree as a motion does
constexpr double changed_by = 0.001;      // probability of a false change
constexpr std::size_t per_order = 4;      // readings of a revolution

const Effect& spindle_motion() {
  const auto effect =
      std::ranges::find(effect_catalogue(), SeparatedAs::motion, &Effect::separated_as);
  expects(effect != effect_catalogue().end(), "the motion of a spindle in the catalogue");
  return *effect;
}

/// Highest order that a spindle may have.
int highest_order() { return static_cast<int>(spindle_motion().parameters[1].high); }

const LearnedMotion* of_order(const std::vector<LearnedMotion>& motion, int order) {
  const auto found = std::ranges::find(motion, order, &LearnedMotion::order);
  return found == motion.end() ? nullptr : &*found;
}

/// Readings about the fitted surface by angle.
form::Trace trace_of(const ProbeStream& stream, const FitResult& fit) {
  std::vector<std::size_t> order(stream.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::vector<double> angle(stream.size());
  for (std::size_t i = 0; i < angle.size(); ++i) {
    const double turns = stream.c_rad[i] / two_pi;
    angle[i] = two_pi * (turns - std::floor(turns));
  }
  std::ranges::sort(order, {}, [&](std::size_t i) { return angle[i]; });
  form::Trace trace;
  trace.period = two_pi;
  for (const std::size_t i : order)
    trace.at.push_back(angle[i]), trace.value_mm.push_back(fit.residual_mm[i]);
  return trace;
}

}  // namespace

std::vector<LearnedMotion> motion_of_form(const ProbeStream& stream, const FitOptions& options) {
  FitOptions of_cut = options;
  if (!stream.has_position()) of_cut.surface = SurfaceKind::section;
  const FitResult found = fit(stream, of_cut);
  const int highest = highest_order();
  const double turned = range_of(stream.c_rad).length();
  const bool dense = static_cast<double>(stream.size()) * two_pi >=
                     static_cast<double>(per_order) * highest * turned;
  if (!found.axis_known() || !dense || turned < 0.98 * two_pi)
    throw Refusal(
        "does not show the form of the cut: measure whole revolutions with 48 readings or more");
  const form::Trace trace = trace_of(stream, found);
  const std::vector<form::Order> orders = form::harmonics_of(trace, highest);
  double squares = 0.0;
  for (std::size_t i = 0; i < trace.size(); ++i) {
    double left = trace.value_mm[i];
    for (const form::Order& one : orders)
      left -= one.cos_mm * std::cos(one.order * trace.at[i]) +
              one.sin_mm * std::sin(one.order * trace.at[i]);
    squares += left * left;
  }
  const double freedom = static_cast<double>(trace.size()) - 2.0 * highest - 1.0;
  const double sigma_mm = std::sqrt(squares / std::max(1.0, freedom));
  std::vector<LearnedMotion> out;
  for (const form::Order& one : orders)
    if (one.order >= 2)
      out.push_back({one.order, -one.cos_mm, -one.sin_mm, sigma_mm * one.u_per_sigma});
  return out;
}

std::vector<LearnedMotion> motion_response(const MachineLoop& loop) {
  std::vector<LearnedMotion> out;
  if (loop.forms < 2) return out;
  const double freedom = loop.forms - 1.0;  // complex numbers
  const double u_prior = typical(spindle_motion().parameters[0]) / std::sqrt(2.0);
  for (const MotionEvidence& e : loop.motion) {
    const double scatter =
        std::max(1.0, (chi2_about_mean(e.cos) + chi2_about_mean(e.sin)) / (2.0 * freedom));
    const double mean2 = (e.cos.sum * e.cos.sum + e.sin.sum * e.sin.sum) / e.cos.information;
    const double ratio = mean2 / 2.0 / scatter;
    if (std::pow(1.0 + ratio / freedom, -freedom) > agree_by_chance) continue;
    const Shrunk cos = shrunk(e.cos, scatter, u_prior), sin = shrunk(e.sin, scatter, u_prior);
    out.push_back({e.order, cos.value, sin.value, cos.u});
  }
  return out;
}

LoopTrouble motion_trouble(const LoopResponse& used, const LoopObservation& seen) {
  if (seen.motion.empty()) return LoopTrouble::none;
  double size2 = 0.0, along = 0.0, u2_along = 0.0;
  bool changed = false;
  for (const LearnedMotion& q : used.motion) {
    const LearnedMotion* left = of_order(seen.motion, q.order);
    if (left == nullptr) continue;
    const double q2 = q.cos_mm * q.cos_mm + q.sin_mm * q.sin_mm;
    const double u2 = left->u_mm * left->u_mm + q.u_mm * q.u_mm;
    size2 += q2, u2_along += q2 * u2;
    along += q.cos_mm * left->cos_mm + q.sin_mm * left->sin_mm;
    const double late =
        std::hypot(used.gain, used.u_gain, q.order * std::hypot(used.lag_rad, used.u_lag_rad));
    const double chi2 =
        (left->cos_mm * left->cos_mm + left->sin_mm * left->sin_mm) / (u2 + q2 * late * late);
    changed =
        changed || chi2 > -2.0 * std::log(changed_by / static_cast<double>(used.motion.size()));
  }
  if (size2 > 0.0 && along - size2 > refuted_by * std::sqrt(u2_along))
    return LoopTrouble::wrong_sign;
  return changed ? LoopTrouble::changed : LoopTrouble::none;
}

void learn_motion(MachineLoop& loop, const LoopResponse& used, const LoopObservation& seen) {
  if (seen.motion.empty()) return;
  ++loop.forms;
  for (const LearnedMotion& left : seen.motion) {
    auto e = std::ranges::find(loop.motion, left.order, &MotionEvidence::order);
    if (e == loop.motion.end()) e = loop.motion.insert(e, MotionEvidence{left.order});
    const LearnedMotion* q = of_order(used.motion, left.order);
    add(e->cos, left.cos_mm + (q != nullptr ? q->cos_mm : 0.0), left.u_mm);
    add(e->sin, left.sin_mm + (q != nullptr ? q->sin_mm : 0.0), left.u_mm);
  }
}

std::vector<RepeatingMotion> followed(const std::vector<LearnedMotion>& motion) {
  std::vector<RepeatingMotion> out;
  for (const LearnedMotion& one : motion) {
    TermValue term;
    term.effect = &spindle_motion();
    term.shape.order = one.order;
    term.linear = {one.cos_mm, one.sin_mm};
    out.push_back({term});
  }
  return out;
}

}  // namespace trueaxis

// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "nc/probing/approach.hpp"
#include "nc/probing/refusal_list.hpp"
#include "nc/probing/refusals.hpp"

namespace trueaxis::nc {
namespace {

/// What a pass reaches of the axis that it runs along, its run-in and run-out included.
struct Stretch {
  double low_mm, high_mm;
};
Stretch stretch_of(const ProbingPass& pass, const ProbingLimits& limits) {
  const double before = run_in(pass, limits) * (pass.end_mm - pass.start_mm);
  const auto [low, high] = std::minmax({pass.start_mm - before, pass.end_mm + before});
  return {low, high};
}

/// The places of a stretch where the radius is smallest and largest.
struct Radii {
  double thin_z_mm, thick_z_mm;
};
Radii radii_of(const ProbingPlan& plan, const Stretch& z) {
  if (plan.slope > 0.0) return {z.low_mm, z.high_mm};
  return {z.high_mm, z.low_mm};
}

void expect_along_z(std::size_t number, const ProbingPass& pass, const ProbingLimits& limits,
                    RefusalList& refusals) {
  const Stretch z = stretch_of(pass, limits);
  refusals.unless(z.low_mm >= limits.z_low_mm && z.high_mm <= limits.z_high_mm,
                  "pass {} runs from Z {:.4g} to {:.4g} mm with run-in and run-out, and Z goes "
                  "from {:.4g} to {:.4g} mm",
                  number, z.low_mm, z.high_mm, limits.z_low_mm, limits.z_high_mm);
  const double free_end = std::max(pass.start_mm, pass.end_mm);
  refusals.unless(free_end <= limits.front_mm,
                  "pass {} probes up to Z {:.4g} mm and the part ends at front_mm = {:.4g}: rapid "
                  "moves in front of it would meet what is probed",
                  number, free_end, limits.front_mm);
}

void expect_reach(const ProbingPlan& plan, double z_mm, const ProbingLimits& limits,
                  RefusalList& refusals) {
  refusals.unless(plan.size_at(z_mm) <= limits.reach_mm,
                  "the part has a radius of {:.4g} mm at Z {:.4g} mm and reach_mm is {:.4g}: "
                  "state how far part and chuck reach",
                  plan.size_at(z_mm), z_mm, limits.reach_mm);
}

void about_a_shaft(const ProbingPlan& plan, const ProbingLimits& limits, RefusalList& refusals) {
  const double clear_x = limits.clear_x_mm();
  const bool rear = std::ranges::any_of(plan.passes, &ProbingPass::rear);
  refusals.unless(!rear || -clear_x >= limits.x_low_mm,
                  "the rear side needs X {:.4g} mm and X begins at {:.4g} mm: probe from the "
                  "front only, or state what the slide can do",
                  -clear_x, limits.x_low_mm);
  for (std::size_t k = 0; k < plan.passes.size(); ++k) {
    expect_along_z(k + 1, plan.passes[k], limits, refusals);
    const auto [thin, thick] = radii_of(plan, stretch_of(plan.passes[k], limits));
    expect_reach(plan, thick, limits, refusals);
    refusals.unless(plan.size_at(thin) + limits.ball_radius_mm > limits.search_mm,
                    "the part has a radius of {:.4g} mm at Z {:.4g} mm: a probe that searches "
                    "{:.4g} mm farther would pass the axis",
                    plan.size_at(thin), thin, limits.search_mm);
  }
}

bool bore_is_stated(const ProbingLimits& limits, RefusalList& refusals) {
  refusals.unless(limits.bore_radius_mm.has_value(),
                  "a bore needs bore_radius_mm in [part]: how far from the spindle axis it is "
                  "free, from its mouth to its bottom");
  refusals.unless(limits.bore_bottom_mm.has_value(),
                  "a bore needs bore_bottom_mm in [part]: Z down to which it is free");
  refusals.unless(limits.stylus_radius_mm.has_value(),
                  "a bore needs stylus_radius_mm in [probe]: the radius of its shank");
  refusals.unless(limits.stylus_length_mm.has_value(),
                  "a bore needs stylus_length_mm in [probe]: from the centre of the ball to the "
                  "body of the probe");
  return limits.bore_radius_mm && limits.bore_bottom_mm && limits.stylus_radius_mm &&
         limits.stylus_length_mm;
}

/// The shank of a stylus along Z is in the bore from the ball to the mouth, and the body in front
/// of it.
void about_a_pass_in_a_bore(const ProbingPlan& plan, std::size_t number,
                            const ProbingLimits& limits, RefusalList& refusals) {
  const ProbingPass& pass = plan.passes[number - 1];
  const Stretch z = stretch_of(pass, limits);
  const double ball = limits.ball_radius_mm, radius = *limits.bore_radius_mm;
  expect_along_z(number, pass, limits, refusals);
  const bool ends_in_front = std::max(pass.start_mm, pass.end_mm) > limits.front_mm;
  refusals.unless(ends_in_front || z.high_mm <= limits.front_mm,
                  "the run-in of pass {} begins, or its run-out ends, at Z {:.4g} mm: outside the "
                  "bore, which ends at front_mm = {:.4g}",
                  number, z.high_mm, limits.front_mm);
  const double lowest = *limits.bore_bottom_mm + ball + limits.clearance_mm;
  refusals.unless(z.low_mm >= lowest,
                  "pass {} goes down to Z {:.4g} mm and the bore lets the ball down to {:.4g} mm "
                  "(bottom, ball and clearance)",
                  number, z.low_mm, lowest);
  const double length = limits.front_mm - z.low_mm + limits.clearance_mm;
  refusals.unless(length <= *limits.stylus_length_mm,
                  "pass {} needs a stylus of {:.4g} mm (from front_mm down to Z {:.4g} mm, and "
                  "clearance) and stylus_length_mm is {:.4g}",
                  number, length, z.low_mm, *limits.stylus_length_mm);
  const auto [thin, thick] = radii_of(plan, z);
  expect_reach(plan, thick, limits, refusals);
  refusals.unless(plan.size_at(thin) >= radius,
                  "the bore has a radius of {:.4g} mm at Z {:.4g} mm and bore_radius_mm is {:.4g}: "
                  "state the radius that is free everywhere",
                  plan.size_at(thin), thin, radius);
  // From the ball to the front the shank passes the probed surface, and then the mouth.
  const auto room_of_shank = [&](double touched_z) {
    return std::min({limits.bore_mouth_mm.value_or(radius), plan.size_at(touched_z),
                     plan.size_at(z.high_mm)}) -
           (plan.size_at(touched_z) - ball + *limits.stylus_radius_mm);
  };
  const double tight = room_of_shank(z.low_mm) < room_of_shank(z.high_mm) ? z.low_mm : z.high_mm;
  const double shank = plan.size_at(tight) - ball + *limits.stylus_radius_mm;
  refusals.unless(room_of_shank(tight) >= 0.0,
                  "the shank would be at a radius of {:.4g} mm while the ball touches at Z {:.4g} "
                  "mm, and from there to the front the bore is free to {:.4g} mm: use a thinner "
                  "shank or a larger ball, or state bore_mouth_radius_mm in [part]",
                  shank, tight, shank + room_of_shank(tight));
  const double farthest = plan.size_at(thick) - ball + limits.search_mm;
  refusals.unless(pass.rear ? -farthest >= limits.x_low_mm : farthest <= limits.x_high_mm,
                  "pass {} searches to X {:.4g} mm and X goes from {:.4g} to {:.4g} mm", number,
                  pass.rear ? -farthest : farthest, limits.x_low_mm, limits.x_high_mm);
}

void about_a_bore(const ProbingPlan& plan, const ProbingLimits& limits, RefusalList& refusals) {
  if (!bore_is_stated(limits, refusals)) return;
  refusals.unless(limits.ball_radius_mm > *limits.stylus_radius_mm,
                  "in a bore the ball must be thicker than its shank: ball_radius_mm is {:.4g} and "
                  "stylus_radius_mm {:.4g}",
                  limits.ball_radius_mm, *limits.stylus_radius_mm);
  refusals.unless(limits.bore_mouth_mm.value_or(*limits.bore_radius_mm) >= *limits.bore_radius_mm,
                  "bore_mouth_radius_mm is less than bore_radius_mm = {:.4g}, which is free from "
                  "the front to the bottom: correct one of them",
                  *limits.bore_radius_mm);
  refusals.unless(limits.inside_x_mm() >= 0.0,
                  "a ball of {:.4g} mm with {:.4g} mm of clearance does not fit into a bore that "
                  "is free to bore_radius_mm = {:.4g}: use a smaller ball or clearance",
                  limits.ball_radius_mm, limits.clearance_mm, *limits.bore_radius_mm);
  for (std::size_t k = 1; k <= plan.passes.size(); ++k)
    about_a_pass_in_a_bore(plan, k, limits, refusals);
}

void about_a_face(const ProbingPlan& plan, const ProbingLimits& limits, RefusalList& refusals) {
  const double level = plan.size_mm, length = limits.front_mm - level + limits.clearance_mm;
  refusals.unless(level <= limits.front_mm,
                  "the face is at Z {:.4g} mm and the part ends at front_mm = {:.4g}: rapid moves "
                  "in front of it would meet it",
                  level, limits.front_mm);
  refusals.unless(level == limits.front_mm || limits.stylus_length_mm,
                  "the face is {:.4g} mm below front_mm: state stylus_length_mm in [probe], from "
                  "the centre of the ball to the body of the probe",
                  limits.front_mm - level);
  refusals.unless(length <= limits.stylus_length_mm.value_or(length),
                  "the face needs a stylus of {:.4g} mm (from front_mm down to it, and clearance) "
                  "and stylus_length_mm is {:.4g}",
                  length, limits.stylus_length_mm.value_or(0.0));
  const double lowest = level + limits.ball_radius_mm - limits.search_mm;
  refusals.unless(lowest >= limits.z_low_mm,
                  "the probe searches to Z {:.4g} mm and Z begins at {:.4g} mm", lowest,
                  limits.z_low_mm);
  for (std::size_t k = 0; k < plan.passes.size(); ++k) {
    const Stretch x = stretch_of(plan.passes[k], limits);
    refusals.unless(!plan.passes[k].rear, "pass {} is on the rear side, and a face has none",
                    k + 1);
    refusals.unless(x.low_mm >= limits.x_low_mm && x.high_mm <= limits.x_high_mm,
                    "pass {} runs from X {:.4g} to {:.4g} mm with run-in and run-out, and X goes "
                    "from {:.4g} to {:.4g} mm",
                    k + 1, x.low_mm, x.high_mm, limits.x_low_mm, limits.x_high_mm);
    const double farthest = std::max(-x.low_mm, x.high_mm);
    refusals.unless(farthest <= limits.reach_mm,
                    "pass {} goes to a radius of {:.4g} mm and the part ends at reach_mm = {:.4g}: "
                    "there is no face to touch",
                    k + 1, farthest, limits.reach_mm);
  }
}

}  // namespace

void expect_room(const ProbingPlan& plan, const ProbingLimits& limits, RefusalList& refusals) {
  const double clear_x = limits.clear_x_mm(), clear_z = limits.clear_z_mm();
  refusals.unless(plan.surface != ProbedSurface::shaft || clear_x <= limits.x_high_mm,
                  "rapid moves need X {:.4g} mm (reach, ball and clearance) and X ends at {:.4g} "
                  "mm",
                  clear_x, limits.x_high_mm);
  refusals.unless(
      clear_z <= limits.z_high_mm,
      "the probe leaves at Z {:.4g} mm (front, ball and clearance) and Z ends at {:.4g} "
      "mm",
      clear_z, limits.z_high_mm);
  switch (plan.surface) {
    case ProbedSurface::shaft:
      return about_a_shaft(plan, limits, refusals);
    case ProbedSurface::bore:
      return about_a_bore(plan, limits, refusals);
    case ProbedSurface::face:
      return about_a_face(plan, limits, refusals);
  }
}

}  // namespace trueaxis::nc

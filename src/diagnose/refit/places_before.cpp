// SPDX-License-Identifier: Apache-2.0
#include "diagnose/refit/places_before.hpp"

#include <algorithm>
#include <cmath>

namespace trueaxis::diagnose_detail {
namespace {

struct Step {
  double onset_s = 0.0;
  double dx_mm = 0.0, dy_mm = 0.0, turn_rad = 0.0, tilt_x = 0.0, tilt_y = 0.0;
};

Step step_of(const Hypothesis& h, const Eigen::VectorXd& size) {
  Step out{.onset_s = h.shape.onset_s};
  const auto names = linear_parameters(h.effect->term, h.shape);
  for (Eigen::Index j = 0; j < size.size(); ++j) {
    const auto k = static_cast<std::size_t>(j);
    const std::string_view name = names[h.free.empty() ? k : h.free[k]].name;
    if (name == "dx") out.dx_mm = size(j);
    if (name == "dy") out.dy_mm = size(j);
    if (name == "turn") out.turn_rad = size(j);
    if (name == "tilt_x") out.tilt_x = size(j);
    if (name == "tilt_y") out.tilt_y = size(j);
  }
  return out;
}

/// The inverse, about the middle of the probed length.
Axis undone(const Axis& after, const Step& step, double z_mid_mm) {
  const double c = std::cos(step.turn_rad), s = std::sin(step.turn_rad);
  const double lever_mm = after.z_ref_mm - z_mid_mm;
  Axis out = after;
  out.slope_x = c * after.slope_x + s * after.slope_y - step.tilt_x;
  out.slope_y = c * after.slope_y - s * after.slope_x - step.tilt_y;
  out.x_mm = c * after.x_mm + s * after.y_mm - step.dx_mm - lever_mm * step.tilt_x;
  out.y_mm = c * after.y_mm - s * after.x_mm - step.dy_mm - lever_mm * step.tilt_y;
  return out;
}

}  // namespace

bool is_slip(const Hypothesis& h) { return h.effect && is_step(h.effect->term); }

bool is_step_at_once(const Hypothesis& h) { return is_slip(h) && h.shape.duration_s == 0.0; }

std::vector<Clamping> places_before(const LinearisationPoint& point,
                                    std::span<const Hypothesis> terms, const Eigen::VectorXd& found,
                                    const std::vector<Clamping>& after) {
  if (point.base.face) return {};
  std::vector<Step> steps;
  Eigen::Index at = 0;
  for (const Hypothesis& h : terms) {
    const auto own = static_cast<Eigen::Index>(h.columns());
    if (is_step_at_once(h)) steps.push_back(step_of(h, found.segment(at, own)));
    at += own;
  }
  std::ranges::stable_sort(steps, std::ranges::greater{}, &Step::onset_s);
  std::vector<Clamping> out, now = after;
  for (const Step& step : steps) {
    std::size_t until = point.size();
    while (until > 0 && point.time[until - 1] >= step.onset_s) --until;
    for (Clamping& clamping : now) {
      clamping.until = until;
      clamping.shape.axis = undone(clamping.shape.axis, step, point.z_mid_mm);
      clamping.slips_by_rad += step.turn_rad;
    }
    out.insert(out.begin(), now.begin(), now.end());
  }
  return out;
}

}  // namespace trueaxis::diagnose_detail

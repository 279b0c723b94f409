// SPDX-License-Identifier: Apache-2.0
#include "simulate/prober.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "trueaxis/error.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis::virtual_lathe {
namespace {

[[noreturn]] void miss(const Moment& at) {
  throw InputError("scenario",
                   fmt::format("the probe misses the part at C = {:g} deg, position = {:g} mm: "
                               "change the plan or the part",
                               at.c_rad / rad_per_deg, at.position_mm));
}

}  // namespace

/// The machine frame as the part sees it at an instant.
struct Prober::PartView {
  Vec3 origin, ex, ey, ez;
  Vec3 point(double x, double y, double z) const { return origin + x * ex + y * ey + z * ez; }
  Vec3 vector(double x, double y, double z) const { return x * ex + y * ey + z * ez; }
};

Prober::Prober(const Scenario& scenario, const Chain& chain, const Body& body,
               const Chucking& setup, double angle_rad)
    : chain_(chain),
      body_(body),
      setup_(setup),
      frame_(part_frame(scenario.part, setup)),
      span_(make_span(scenario)),
      outward_(scenario.part.bore ? -1.0 : 1.0),
      side_(setup.rear ? -1.0 : 1.0),
      ball_mm_(scenario.probe.ball_radius_mm + chain.line.extra_ball_mm),
      cos_tilt_(std::cos(chain.line.tilt_rad)),
      sin_tilt_(std::sin(chain.line.tilt_rad)),
      cos_angle_(std::cos(angle_rad)),
      sin_angle_(std::sin(angle_rad)) {
  if (body.face() && setup.rear) {
    throw InputError("scenario", "a face has no rear side: take `rear` out of the set-up");
  }
}

TrueState Prober::state_at(const Moment& moment) const {
  TrueState state;
  state.at = moment;
  state.face = body_.face();
  state.c_rad = moment.c_rad;
  state.position_mm = moment.position_mm;
  if (!chain_.machine.empty()) {
    state.u = span_.u(moment.position_mm);
    state.u_part = span_.u(moment.position_mm - (state.face ? 0.0 : setup_.z_shift_mm));
    for (const auto& term : chain_.machine) term(state);
  }
  return state;
}

// part ← spindle ← machine: turned by C, by what the part slipped, then the rigid placement undone.
Prober::PartView Prober::view_at(const TrueState& state) const {
  double turn = state.c_rad, dx = 0.0, dy = 0.0, dz = 0.0, tilt_x = 0.0, tilt_y = 0.0;
  for (const auto& term : chain_.step) {
    const PartStep step = term(state.at.t_s);
    turn -= step.turn_rad;
    dx += step.dx_mm;
    dy += step.dy_mm;
    dz += step.dz_mm;
    tilt_x += step.tilt_x_rad;
    tilt_y += step.tilt_y_rad;
  }
  const SpindleAngle angle(turn);
  const RigidFrame seat = RigidFrame::about({dx, dy, dz}, tilt_x, tilt_y);
  const auto vector = [&](const Vec3& machine) {
    const Vec3 p = seat.turned(angle.spindle_from_machine(machine));
    return Vec3{dot(p, frame_.ex), dot(p, frame_.ey), dot(p, frame_.ez)};
  };
  return {frame_.part_from_spindle(seat.part_from_spindle({})), vector({1, 0, 0}),
          vector({0, 1, 0}), vector({0, 0, 1})};
}

template <class Gap>
std::optional<double> Prober::contact(const Gap& gap, const Line& line, double centre) const {
  const auto on_line = [&](double q) { return gap(line.at(q)); };
  if (body_.face()) return root_near(on_line, centre);
  const auto ideal_on_line = [&](double q) { return body_.ideal_gap(line.at(q)); };
  const Vec3 mid = line.at(centre);
  const double radius = body_.radius_at(mid.z);
  const double reach = 2.0 * std::abs(radius) + 1.0;
  if (chain_.local_form) {
    std::optional<double> ideal = root_near(ideal_on_line, centre + radius);
    if (!ideal) ideal = root_outside(ideal_on_line, centre, reach);
    if (!ideal) return std::nullopt;
    return root_from_outside(on_line, *ideal, std::abs(radius));
  }
  if (const std::optional<double> q = root_near(on_line, centre + radius)) return q;
  return root_outside(on_line, centre, reach);
}

// Farther off than 2 √(R a) the ball is higher than any wave of amplitude a.
Crests Prober::crests(const Line& line, double centre, const Vec3& towards) const {
  const Vec3 at = line.at(body_.face() ? centre : centre + body_.radius_at(line.base.z));
  const auto ideal = [this](const Vec3& p) { return body_.ideal_gap(p); };
  const Vec3 normal = normal_at(ideal, at);
  const double reach_mm = 2.0 * std::sqrt(ball_mm_ * chain_.waves_mm);
  return {unit(towards - dot(towards, normal) * normal), std::min(reach_mm, 0.99 * ball_mm_),
          chain_.shortest_mm / 32.0};
}

template <class Gap>
CleanReading Prober::read_on(const Gap& gap, const TrueState& state, bool with_incidence) const {
  const PartView view = view_at(state);
  const bool face = body_.face();
  // The probe's own frame is the machine's turned by its angle: along its line, and across.
  const double along_mm = state.part_x_mm * cos_angle_ + state.part_y_mm * sin_angle_;
  const double h =
      chain_.line.height_mm + state.part_x_mm * sin_angle_ - state.part_y_mm * cos_angle_;
  Line line;
  double centre = 0.0;  // of the search: the axis, or the height of a face
  if (face) {
    line = {view.point(state.position_mm - state.part_x_mm, h, 0.0),
            view.vector(-sin_tilt_, 0.0, cos_tilt_)};
    centre = (body_.level_mm() - line.base.z) / line.direction.z;
  } else {
    line = {view.point(-h * sin_angle_, h * cos_angle_, state.position_mm - state.part_z_mm),
            side_ * view.vector(cos_tilt_ * cos_angle_, cos_tilt_ * sin_angle_, sin_tilt_)};
    centre = -(line.base.x * line.direction.x + line.base.y * line.direction.y);
  }
  const auto point_reading = [&](const Line& on) { return contact(gap, on, centre); };
  std::optional<double> q;
  if (ball_mm_ > 0.0 && chain_.waves_mm * ball_mm_ * std::pow(two_pi / chain_.shortest_mm, 2) > 0.5)
    q = reading_on_crests(gap, line, outward_ * ball_mm_,
                          crests(line, centre, face ? view.ex : view.ez), point_reading);
  else if (ball_mm_ > 0.0)
    q = settled_ball(gap, line, outward_ * ball_mm_, {}, point_reading).first;
  else
    q = point_reading(line);
  if (!q) miss(state.at);

  CleanReading reading;
  reading.value_mm = side_ * *q + state.across_mm + (face ? state.part_z_mm : along_mm);
  Sensed sensor{state, side_};
  if (chain_.needs_normal || with_incidence) {
    const Vec3 n = outward_ * normal_at(gap, line.at(*q));
    const double along = dot(n, line.direction);
    reading.tan_incidence = std::sqrt(std::max(0.0, 1.0 - along * along)) / std::abs(along);
    sensor.normal = {dot(n, view.ex), dot(n, view.ey), dot(n, view.ez)};
  }
  for (const auto& term : chain_.response) {
    sensor.x_mm = reading.value_mm - setup_.x_jog_mm;
    reading.value_mm = setup_.x_jog_mm + term(sensor);
  }
  return reading;
}

CleanReading Prober::read(const Moment& moment, bool with_incidence) const {
  const TrueState state = state_at(moment);
  if (body_.deformed()) {
    return read_on([this](const Vec3& p) { return body_.gap(p, setup_); }, state, with_incidence);
  }
  return read_on([this](const Vec3& p) { return body_.ideal_gap(p); }, state, with_incidence);
}

}  // namespace trueaxis::virtual_lathe

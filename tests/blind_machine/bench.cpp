// SPDX-License-Identifier: Apache-2.0
#include "blind_machine/bench.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>

namespace trueaxis::blind_machine {
namespace {

namespace vm = virtual_machine;

Vector3 apart(const Machine& machine, const vm::Ends& ends, const Visit& visit,
              const Vector3& centre) {
  const Vector3 ball = vm::transformed(ends.bed_from_table, centre);
  const Vector3 tip = vm::tip_mm(machine, ends, visit.tool_mm);
  return {ball[0] - tip[0], ball[1] - tip[1], ball[2] - tip[2]};
}

/// `low` to `high` in `count` steps.
std::vector<double> spaced(double low_deg, double high_deg, int count) {
  std::vector<double> out;
  for (int k = 0; k < count; ++k)
    out.push_back((low_deg + (high_deg - low_deg) * k / (count - 1)) * rad_per_deg);
  return out;
}

Layout layout_of(const char* name, const char* chain, std::vector<double> first, AxisName axis,
                 Vector3 first_point, Vector3 round_point) {
  Layout out{name, {}, std::move(first), axis, AxisName::C};
  std::vector<ChainTrouble> troubles;
  out.machine.name = name;
  out.machine.chain = chain;
  out.machine.axes = parse_chain(chain, troubles);
  for (MachineAxis& one : out.machine.axes)
    if (is_rotary(one.name)) one.point_mm = one.name == axis ? first_point : round_point;
  out.machine.tool.gauge_point_mm = {0, 0, 150};
  out.machine.tool.length_mm = 120;
  return out;
}

std::vector<Layout> made_layouts() {
  std::vector<Layout> all{layout_of("trunnion AC", "w C' A' Y' b X Z t", spaced(-90, 30, 5),
                                    AxisName::A, {0, 15, -40}, {5, -10, 0}),
                          layout_of("trunnion BC", "w C' B' X' b Y Z t", spaced(-80, 80, 5),
                                    AxisName::B, {12, 0, -55}, {-6, 8, 0}),
                          layout_of("turned tables", "w C' A' b X Y Z t", spaced(-60, 60, 5),
                                    AxisName::A, {0, 20, 10}, {0, 0, 0}),
                          layout_of("Z'X'A'C'Y", "w C' A' X' Z' b Y t", spaced(-100, 0, 5),
                                    AxisName::A, {0, 0, -50}, {0, 0, 0}),
                          layout_of("head-head", "w X' b Y Z C A t", spaced(-80, 80, 5),
                                    AxisName::A, {0, 4, 210}, {3, -2, 0}),
                          layout_of("table-head", "w C' b X Y Z B t", spaced(-90, 90, 5),
                                    AxisName::B, {0, 0, 230}, {4, 7, 0}),
                          layout_of("nutating table", "w C' B' b X Y Z t", spaced(0, 180, 5),
                                    AxisName::B, {0, 0, -30}, {2, -3, 0})};
  for (MachineAxis& axis : all[2].machine.axes)  // as LinuxCNC's xyzac-trt
    if (is_rotary(axis.name))
      for (double& component : axis.direction) component = -component;
  for (MachineAxis& axis : all[6].machine.axes)
    if (axis.name == AxisName::B) axis.direction = {0, std::sqrt(0.5), std::sqrt(0.5)};
  return all;
}

double determinant(const std::array<Vector3, 3>& m) {
  return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
         m[1][0] * (m[0][1] * m[2][2] - m[0][2] * m[2][1]) +
         m[2][0] * (m[0][1] * m[1][2] - m[0][2] * m[1][1]);
}

}  // namespace

const std::vector<Layout>& layouts() {
  static const std::vector<Layout> all = made_layouts();
  return all;
}

AxisPositions following(const Machine& machine, Visit visit, const Vector3& apart_mm) {
  const auto off = [&](const AxisPositions& axes) {
    Vector3 d = apart(machine, vm::ends(machine, {}, axes), visit, visit.centre_mm);
    for (std::size_t i = 0; i < 3; ++i) d[i] -= apart_mm[i];
    return d;
  };
  const Vector3 d = off(visit.axes);  // linear in X Y Z
  std::array<Vector3, 3> slope;
  for (std::size_t k = 0; k < 3; ++k) {
    AxisPositions moved = visit.axes;
    moved[k] += 1.0;
    const Vector3 e = off(moved);
    for (std::size_t i = 0; i < 3; ++i) slope[k][i] = e[i] - d[i];
  }
  const double whole = determinant(slope);
  AxisPositions out = visit.axes;
  for (std::size_t k = 0; k < 3; ++k) {
    auto one = slope;
    one[k] = d;
    out[k] -= determinant(one) / whole;
  }
  return out;
}

std::vector<std::string> plan_names() { return {"ball", "balls", "eighths", "bar"}; }

Plan plan_of(const std::string& name, const Layout& layout, std::uint64_t seed) {
  std::mt19937_64 engine(seed);
  const auto between = [&](double low, double high) {
    return low + (high - low) * std::uniform_real_distribution<>(0.0, 1.0)(engine);
  };
  Plan out{name, name == "bar", between(0.5, 2.0) * mm_per_um, {}};
  std::vector<Vector3> balls{{between(60, 130), between(-30, 30), between(20, 70)}};
  if (name == "balls") balls.push_back({between(-90, -40), between(60, 100), between(80, 120)});
  std::vector<double> tools{120.0};
  if (name == "balls" || name == "eighths") tools.push_back(190.0);
  std::vector<Vector3> to_tip{{}};
  if (out.bar) to_tip = {{100, 0, 0}, {0, 100, 0}, {0, 0, 100}, {58, 58, 58}};
  const int steps = name == "eighths" ? 8 : 12;
  for (const double tool : tools)
    for (std::size_t b = 0; b < balls.size(); ++b)
      for (const double first : layout.first_rad)
        for (int k = 0; k < steps; ++k)
          for (const Vector3& bar : to_tip) {
            Visit visit{static_cast<int>(b) + 1, balls[b], tool, {}, 0.0};
            visit.axes[index_of(layout.first)] = first;
            visit.axes[index_of(layout.round)] = two_pi * k / steps;
            Vector3 off{-bar[0], -bar[1], -bar[2]};
            for (double& one : off) one += between(-0.3, 0.3);
            visit.axes = following(layout.machine, visit, off);
            out.visits.push_back(visit);
          }
  if (name == "ball" || name == "eighths") {
    const std::vector<Visit> there = out.visits;
    out.visits.insert(out.visits.end(), there.rbegin(), there.rend());
  }
  for (std::size_t i = 0; i < out.visits.size(); ++i)
    out.visits[i].time_s = pace_s * static_cast<double>(i);
  return out;
}

std::vector<double> readings(const Machine& machine, const Plan& plan, const Fault& fault) {
  std::vector<double> out;
  AxisPositions from = plan.visits.front().axes, lost{};
  const double end_s = fault.end_s > 0.0 ? fault.end_s : std::max(1.0, plan.visits.back().time_s);
  ErrorModel errors = fault.errors;
  for (std::size_t i = 0; i < plan.visits.size(); ++i) {
    const Visit& visit = plan.visits[i];
    for (std::size_t k = 0; k < axis_count; ++k)
      if (std::abs(visit.axes[k] - from[k]) > 1e-9)
        lost[k] = visit.axes[k] < from[k] ? fault.reversal[k] : 0.0;
    from = visit.axes;
    if (fault.of_visit) {
      errors.terms = fault.errors.terms;
      const auto more = fault.of_visit(visit);
      errors.terms.insert(errors.terms.end(), more.begin(), more.end());
    }
    Vector3 centre = visit.centre_mm;
    if (fault.slip_at > 0 && i + 1 >= fault.slip_at &&
        visit.ball == plan.visits[fault.slip_at - 1].ball)
      for (std::size_t k = 0; k < 3; ++k) centre[k] += fault.slip_mm[k];
    Vector3 d = apart(machine, vm::ends(machine, errors, visit.axes, lost), visit, centre);
    for (std::size_t k = 0; k < 3; ++k) d[k] -= fault.drift_mm[k] * visit.time_s / end_s;
    if (plan.bar)
      out.push_back(std::hypot(d[0], d[1], d[2]));
    else
      out.insert(out.end(), d.begin(), d.end());
  }
  return out;
}

}  // namespace trueaxis::blind_machine

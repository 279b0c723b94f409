// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "trueaxis/machine.hpp"

/// Machines, errors and positions drawn from a seed.
namespace trueaxis::testing {

/// A layout and the chain it is drawn for.
struct Layout {
  const char* name;
  const char* chain;
  bool nutating = false;  ///< its first rotary axis of the tool, or else the table's, lies at 45°
};

inline const std::vector<Layout>& layouts() {
  static const std::vector<Layout> all{{"trunnion AC", "w C' A' Y' b X Z t"},
                                       {"trunnion BC", "w C' B' X' b Y Z t"},
                                       {"Z'X'A'C'Y", "w C' A' X' Z' b Y t"},
                                       {"head-head", "w X' b Y Z C A t"},
                                       {"nutating head", "w X' b Y Z C B t", true},
                                       {"nutating table", "w C' B' b X Y Z t", true},
                                       {"table-head", "w C' b X Y Z B t"},
                                       {"three axes", "w X' Y' b Z t"},
                                       {"four axes", "w A' b X Y Z t"},
                                       {"lathe", "w C' b Z X t"},
                                       {"six axes", "w C' X' b Y Z B A t"}};
  return all;
}

struct Draw {
  explicit Draw(std::uint64_t seed) : engine(seed) {}
  std::mt19937_64 engine;

  double between(double low, double high) {
    return low + (high - low) * std::uniform_real_distribution<double>(0.0, 1.0)(engine);
  }
  int whole(int low, int high) { return std::uniform_int_distribution<int>(low, high)(engine); }
  Vector3 vector(double size) {
    return {between(-size, size), between(-size, size), between(-size, size)};
  }

  Matrix3 rotation() {
    const double a = between(-3, 3), b = between(-1.5, 1.5), c = between(-3, 3);
    const double ca = std::cos(a), sa = std::sin(a), cb = std::cos(b), sb = std::sin(b),
                 cc = std::cos(c), sc = std::sin(c);
    return {{{cc * cb, cc * sb * sa - sc * ca, cc * sb * ca + sc * sa},
             {sc * cb, sc * sb * sa + cc * ca, sc * sb * ca - cc * sa},
             {-sb, cb * sa, cb * ca}}};
  }

  Machine machine(const Layout& layout) {
    Machine machine;
    std::vector<ChainTrouble> none;
    machine.chain = layout.chain;
    machine.axes = parse_chain(layout.chain, none);
    bool nutate = layout.nutating;
    for (MachineAxis& axis : machine.axes) {
      if (whole(0, 2) == 0)
        for (double& component : axis.direction) component = -component;
      if (!is_rotary(axis.name)) continue;
      axis.point_mm = vector(300.0);
      if (nutate && axis.name == AxisName::B) {
        axis.direction = {0.0, std::sqrt(0.5), std::sqrt(0.5)};
        nutate = false;
      }
    }
    machine.tool.gauge_point_mm = vector(400.0);
    machine.tool.length_mm = between(0.0, 250.0);
    WorkOffset offset;
    offset.bed_from_program = {rotation(), vector(200.0)};
    machine.work_offsets[0] = offset;
    return machine;
  }

  AxisPositions positions(const Machine& machine) {
    AxisPositions q{};
    for (const MachineAxis& axis : machine.axes)
      q[index_of(axis.name)] = is_rotary(axis.name) ? between(-3.0, 3.0) : between(-500.0, 500.0);
    return q;
  }

  ErrorFunction function(bool rotary, double size) {
    switch (whole(0, 3)) {
      case 0:
        return ConstantError{between(-size, size)};
      case 1:
        return PolynomialError{{between(-size, size), between(-size, size), between(-size, size)},
                               rotary ? between(-1, 1) : between(-100, 100),
                               rotary ? between(1, 3) : between(300, 600)};
      case 2:
        return FourierError{{{1.0, between(-size, size), between(-size, size)},
                             {3.0, between(-size, size), between(-size, size)}},
                            rotary ? two_pi : between(200, 500)};
      default:
        break;
    }
    TableError table;
    const double from = rotary ? between(-4, -2) : between(-600, -300);
    for (int i = 0; i < 5; ++i) {
      table.at.push_back(from + i * (rotary ? 1.5 : 200.0) + (rotary ? 0.1 : 10.0) * whole(0, 3));
      table.values.push_back(between(-size, size));
    }
    table.periodic = whole(0, 1) == 1;
    if (table.periodic) table.values.back() = table.values.front();
    return table;
  }

  /// Every component and location error that has an effect.
  ErrorModel errors(const Machine& machine, double length_mm, double angle_rad) {
    ErrorModel errors;
    errors.sign = whole(0, 1) == 0 ? ErrorSign::moving_part : ErrorSign::tool_minus_workpiece;
    for (Vector3& reference : errors.reference_mm) reference = vector(200.0);
    std::vector<std::size_t> bodies{spindle_body, workpiece_body};
    for (const MachineAxis& axis : machine.axes) bodies.push_back(index_of(axis.name));
    for (const std::size_t body : bodies) {
      for (std::size_t direction = 0; direction < 6; ++direction) {
        const double size = direction < 3 ? length_mm : angle_rad;
        const ErrorName location{false, direction, body};
        if (!without_effect(location))
          errors.terms.push_back({location, ConstantError{between(-size, size)}});
        if (body >= axis_count) continue;
        for (int times = whole(1, 2); times > 0; --times)
          errors.terms.push_back({{true, direction, body}, function(body >= 3, size)});
      }
    }
    return errors;
  }
};

/// As a literal that can be pasted.
inline std::string literal(const AxisPositions& q) {
  std::string text = "AxisPositions{";
  char number[40];
  for (std::size_t i = 0; i < axis_count; ++i) {
    std::snprintf(number, sizeof number, "%s%.17g", i == 0 ? "" : ", ", q[i]);
    text += number;
  }
  return text + "}";
}

}  // namespace trueaxis::testing

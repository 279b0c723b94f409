// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <variant>

#include "trueaxis/machine.hpp"

/// The tool in the part by 4×4 matrices multiplied out as machine.md writes them, body by body
/// from the bed. It shares the structs of the public header with the room `machine`, and no
/// function.
namespace trueaxis::testing {

using Matrix4 = std::array<std::array<double, 4>, 4>;

Matrix4 times(const Matrix4& a, const Matrix4& b);

template <class... More>
Matrix4 times(const Matrix4& a, const Matrix4& b, const More&... more) {
  return times(times(a, b), more...);
}

Matrix4 unit_matrix();

Matrix4 Tr(double x, double y, double z);
Matrix4 Tr(const Vector3& v, double factor = 1.0);

/// Rodrigues: turns by |w| about w.
Matrix4 exp(const Vector3& w);
Matrix4 exp(const Vector3& axis, double angle);

Matrix4 inverse(const Matrix4& m);

Vector3 turned(const Matrix4& m, const Vector3& v);

/// Value of an error by the table of its kinds.
double contract_value(const ErrorFunction& error, double q);

/// A mistake that a reader of the formulas could make: a test that does not see it is worthless.
enum class Planted {
  none,
  sign_of_workpiece,    ///< E where E⁻¹ belongs
  order_of_turns,       ///< exp(EA) exp(EB) exp(EC) one after the other
  errors_after_rotary,  ///< E after the rotation of a rotary axis
  pivot_of_linear,      ///< angular errors about the origin
  pivot_of_spindle,     ///< A0S about the origin
  bodies_from_tool      ///< the part's bodies multiplied from the workpiece outwards
};

struct ChainMatrices {
  const Machine& machine;
  const ErrorModel& errors;
  Planted planted = Planted::none;

  double sum(bool component, std::size_t direction, std::size_t body, double q) const {
    double value = 0.0;
    for (const ErrorTerm& term : errors.terms)
      if (term.name == ErrorName{component, direction, body})
        value += contract_value(term.function, q);
    return value;
  }
  Vector3 three(bool component, bool angular, std::size_t body, double q) const {
    const std::size_t from = angular ? 3 : 0;
    return {sum(component, from, body, q), sum(component, from + 1, body, q),
            sum(component, from + 2, body, q)};
  }

  Matrix4 E(const MachineAxis& axis, double q) const {
    const std::size_t body = index_of(axis.name);
    const Vector3 turn = three(true, true, body, q);
    Matrix4 rotation = exp(turn);
    if (planted == Planted::order_of_turns)
      rotation = times(exp({turn[0], 0, 0}), exp({0, turn[1], 0}), exp({0, 0, turn[2]}));
    const Matrix4 e = times(Tr(three(true, false, body, q)), rotation);
    const bool inverted = axis.carries_workpiece && errors.sign == ErrorSign::tool_minus_workpiece;
    return inverted != (planted == Planted::sign_of_workpiece && axis.carries_workpiece)
               ? inverse(e)
               : e;
  }

  Matrix4 A(const MachineAxis& axis, double q) const {
    const std::size_t body = index_of(axis.name), own = body % 3;
    const double s = axis.carries_workpiece ? -1.0 : 1.0;
    const bool rotary = body >= 3;
    Vector3 turn = three(false, true, body, 0.0), shift = three(false, false, body, 0.0);
    const double delta = rotary ? turn[own] : shift[own];
    if (rotary) turn[own] = 0.0;
    const Vector3 u = turned(exp(turn), axis.direction);
    const double travel = s * (q + delta);
    if (!rotary) {
      Vector3 r = errors.reference_mm[body];
      if (planted == Planted::pivot_of_linear) r = {};
      return times(Tr(u, travel), Tr(r), E(axis, q), Tr(r, -1.0));
    }
    const Vector3 p{axis.point_mm[0] + shift[0], axis.point_mm[1] + shift[1],
                    axis.point_mm[2] + shift[2]};
    if (planted == Planted::errors_after_rotary)
      return times(Tr(p), exp(u, travel), E(axis, q), Tr(p, -1.0));
    return times(Tr(p), E(axis, q), exp(u, travel), Tr(p, -1.0));
  }

  Matrix4 tool_in_part(const AxisPositions& q, const Setting& setting) const {
    Matrix4 workpiece = unit_matrix(), tool = unit_matrix();
    for (const MachineAxis& axis : machine.axes) {  // from the workpiece: the bed's is the last
      const Matrix4 a = A(axis, q[index_of(axis.name)]);
      if (!axis.carries_workpiece)
        tool = times(tool, a);
      else if (planted == Planted::bodies_from_tool)
        workpiece = times(workpiece, a);
      else
        workpiece = times(a, workpiece);
    }
    const Vector3& gauge = machine.tool.gauge_point_mm;
    const Vector3 g = planted == Planted::pivot_of_spindle ? Vector3{} : gauge;
    const Matrix4 S = times(Tr(g), Tr(three(false, false, spindle_body, 0.0)),
                            exp(three(false, true, spindle_body, 0.0)), Tr(g, -1.0));
    const Matrix4 D = times(Tr(three(false, false, workpiece_body, 0.0)),
                            exp(three(false, true, workpiece_body, 0.0)));
    Matrix4 W0 = Tr(setting.bed_from_program.origin_mm);
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) W0[i][j] = setting.bed_from_program.rotation[i][j];
    const Matrix4 tip = times(Tr(gauge), Tr(machine.tool.direction, -setting.tool_length_mm));
    return times(inverse(times(workpiece, W0, D)), tool, S, tip);
  }
};

Vector3 tip_of(const Matrix4& m);

double distance(const Vector3& a, const Vector3& b);

/// The largest difference of the rotation's entries.
double rotation_distance(const Matrix4& m, const Matrix3& r);

}  // namespace trueaxis::testing

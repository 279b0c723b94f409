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
  double sum(bool component, std::size_t direction, std::size_t body, double q) const;
  Vector3 three(bool component, bool angular, std::size_t body, double q) const;
  Matrix4 E(const MachineAxis& axis, double q) const;
  Matrix4 A(const MachineAxis& axis, double q) const;
  Matrix4 tool_in_part(const AxisPositions& q, const Setting& setting) const;
};

Vector3 tip_of(const Matrix4& m);

double distance(const Vector3& a, const Vector3& b);

/// The largest difference of the rotation's entries.
double rotation_distance(const Matrix4& m, const Matrix3& r);

}  // namespace trueaxis::testing

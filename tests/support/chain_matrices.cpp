// SPDX-License-Identifier: Apache-2.0
#include "support/chain_matrices.hpp"

namespace trueaxis::testing {

Matrix4 times(const Matrix4& a, const Matrix4& b) {
  Matrix4 c{};
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j)
      for (std::size_t k = 0; k < 4; ++k) c[i][j] += a[i][k] * b[k][j];
  return c;
}

Matrix4 unit_matrix() {
  Matrix4 m{};
  for (std::size_t i = 0; i < 4; ++i) m[i][i] = 1.0;
  return m;
}

Matrix4 Tr(double x, double y, double z) {
  Matrix4 m = unit_matrix();
  m[0][3] = x, m[1][3] = y, m[2][3] = z;
  return m;
}

Matrix4 Tr(const Vector3& v, double factor) {
  return Tr(factor * v[0], factor * v[1], factor * v[2]);
}

Matrix4 exp(const Vector3& w) {
  const double angle = std::hypot(w[0], w[1], w[2]);
  Matrix4 m = unit_matrix();
  if (angle == 0.0) return m;
  const Vector3 k{w[0] / angle, w[1] / angle, w[2] / angle};
  const double K[3][3] = {{0, -k[2], k[1]}, {k[2], 0, -k[0]}, {-k[1], k[0], 0}};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      double square = 0.0;
      for (std::size_t n = 0; n < 3; ++n) square += K[i][n] * K[n][j];
      m[i][j] += std::sin(angle) * K[i][j] + 2.0 * std::pow(std::sin(angle / 2.0), 2) * square;
    }
  }
  return m;
}

Matrix4 exp(const Vector3& axis, double angle) {
  return exp({axis[0] * angle, axis[1] * angle, axis[2] * angle});
}

Matrix4 inverse(const Matrix4& m) {
  Matrix4 out = unit_matrix();
  for (std::size_t i = 0; i < 3; ++i) {
    out[i][3] = 0.0;
    for (std::size_t j = 0; j < 3; ++j) {
      out[i][j] = m[j][i];
      out[i][3] -= m[j][i] * m[j][3];
    }
  }
  return out;
}

Vector3 turned(const Matrix4& m, const Vector3& v) {
  Vector3 out{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) out[i] += m[i][j] * v[j];
  return out;
}

double contract_value(const ErrorFunction& error, double q) {
  if (const auto* constant = std::get_if<ConstantError>(&error)) return constant->value;
  double sum = 0.0;
  if (const auto* polynomial = std::get_if<PolynomialError>(&error)) {
    for (std::size_t i = 0; i < polynomial->coefficients.size(); ++i)
      sum += polynomial->coefficients[i] *
             std::pow((q - polynomial->origin) / polynomial->scale, static_cast<double>(i));
  } else if (const auto* fourier = std::get_if<FourierError>(&error)) {
    for (const auto& [n, a, b] : fourier->terms) {
      const double angle = 2.0 * 3.14159265358979323846 * n * q / fourier->period;
      sum += a * std::cos(angle) + b * std::sin(angle);
    }
  } else if (const auto* table = std::get_if<TableError>(&error)) {
    const double first = table->at.front(), last = table->at.back();
    if (table->periodic) {
      while (q < first) q += last - first;
      while (q >= last) q -= last - first;
    }
    if (q <= first) return table->values.front();
    if (q >= last) return table->values.back();
    std::size_t i = 1;
    while (table->at[i] < q) ++i;
    const double part = (q - table->at[i - 1]) / (table->at[i] - table->at[i - 1]);
    sum = (1.0 - part) * table->values[i - 1] + part * table->values[i];
  }
  return sum;
}

double ChainMatrices::sum(bool component, std::size_t direction, std::size_t body, double q) const {
  double value = 0.0;
  for (const ErrorTerm& term : errors.terms)
    if (term.name == ErrorName{component, direction, body})
      value += contract_value(term.function, q);
  return value;
}

Vector3 ChainMatrices::three(bool component, bool angular, std::size_t body, double q) const {
  const std::size_t from = angular ? 3 : 0;
  return {sum(component, from, body, q), sum(component, from + 1, body, q),
          sum(component, from + 2, body, q)};
}

Matrix4 ChainMatrices::E(const MachineAxis& axis, double q) const {
  const std::size_t body = index_of(axis.name);
  const Vector3 turn = three(true, true, body, q);
  Matrix4 rotation = exp(turn);
  if (planted == Planted::order_of_turns)
    rotation = times(exp({turn[0], 0, 0}), exp({0, turn[1], 0}), exp({0, 0, turn[2]}));
  const Matrix4 e = times(Tr(three(true, false, body, q)), rotation);
  const bool inverted = axis.carries_workpiece && errors.sign == ErrorSign::tool_minus_workpiece;
  return inverted != (planted == Planted::sign_of_workpiece && axis.carries_workpiece) ? inverse(e)
                                                                                       : e;
}

Matrix4 ChainMatrices::A(const MachineAxis& axis, double q) const {
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

Matrix4 ChainMatrices::tool_in_part(const AxisPositions& q, const Setting& setting) const {
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

Vector3 tip_of(const Matrix4& m) { return {m[0][3], m[1][3], m[2][3]}; }

double distance(const Vector3& a, const Vector3& b) {
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

double rotation_distance(const Matrix4& m, const Matrix3& r) {
  double largest = 0.0;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) largest = std::fmax(largest, std::fabs(m[i][j] - r[i][j]));
  return largest;
}

}  // namespace trueaxis::testing

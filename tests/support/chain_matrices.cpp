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

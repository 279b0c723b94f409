// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <random>

#include "support/chain_matrices.hpp"
#include "trueaxis/fixture.hpp"

/// Fixtures and parts drawn at random, by the matrices of the test: no function of the room
/// `fixture` is used.
namespace trueaxis::testing {

class FixtureDraw {
 public:
  explicit FixtureDraw(unsigned seed) : random_(seed) {}

  double within(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  Vector3 vector(double size) {
    return {within(-size, size), within(-size, size), within(-size, size)};
  }
  /// D of a part in its fixture.
  Matrix4 displacement(double mm, double rad) { return times(Tr(vector(mm)), exp(vector(rad))); }

  DatumErrors datums(double mm, double rad) {
    DatumErrors out;
    out.offset_mm = vector(mm);
    for (std::size_t k = 0; k < 3; ++k)
      for (std::size_t i = 0; i < 3; ++i) out.turn_rad[k][i] = i == k ? 0.0 : within(-rad, rad);
    return out;
  }

  /// Tips on the datum surfaces of a part at D, each some way off where it should be.
  Locators touching(const Matrix4& D, const DatumErrors& datums) {
    const Vector3 places[] = {{15, 12, 0}, {105, 14, 0}, {60, 68, 0},
                              {20, 0, 12}, {100, 0, 14}, {0, 40, 12}};
    Locators locators;
    for (std::size_t i = 0; i < locator_count; ++i) {
      const std::size_t k = contact_direction(i);
      Locator& locator = locators[i];
      for (std::size_t j = 0; j < 3; ++j) locator.ideal_mm[j] = places[i][j] + within(-4, 4);
      locator.u_mm = within(5e-4, 5e-3);
      locator.measured_mm = transformed(D, on_surface(locator.ideal_mm, k, datums));
    }
    return locators;
  }

  static Vector3 transformed(const Matrix4& D, const Vector3& x) {
    Vector3 out = turned(D, x);
    for (std::size_t i = 0; i < 3; ++i) out[i] += D[i][3];
    return out;
  }
  static Vector3 normal(const DatumErrors& datums, std::size_t k) {
    Vector3 e{};
    e[k] = 1.0;
    return turned(exp(datums.turn_rad[k]), e);
  }

 private:
  /// A point near `ideal` on the plane n·(p − e_k (E_kk + ideal_k)) = 0.
  Vector3 on_surface(const Vector3& ideal, std::size_t k, const DatumErrors& datums) {
    const Vector3 n = normal(datums, k);
    Vector3 p = ideal;
    double across = 0.0;
    for (std::size_t j = 0; j < 3; ++j) {
      if (j == k) continue;
      p[j] += within(-0.5, 0.5);
      across += n[j] * p[j];
    }
    p[k] = ideal[k] + datums.offset_mm[k] - across / n[k];
    return p;
  }

  std::mt19937 random_;
};

/// Largest difference of an entry, mm and 1.
inline double difference(const RigidTransform& a, const Matrix4& b) {
  double most = 0.0;
  for (std::size_t i = 0; i < 3; ++i) {
    most = std::max(most, std::abs(a.origin_mm[i] - b[i][3]));
    for (std::size_t j = 0; j < 3; ++j) most = std::max(most, std::abs(a.rotation[i][j] - b[i][j]));
  }
  return most;
}

inline RigidTransform transform(const Matrix4& m) {
  RigidTransform out;
  for (std::size_t i = 0; i < 3; ++i) {
    out.rotation[i] = {m[i][0], m[i][1], m[i][2]};
    out.origin_mm[i] = m[i][3];
  }
  return out;
}

inline Matrix4 Rx(double rad) { return exp({rad, 0, 0}); }
inline Matrix4 Ry(double rad) { return exp({0, rad, 0}); }
inline Matrix4 Rz(double rad) { return exp({0, 0, rad}); }

}  // namespace trueaxis::testing

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "math/sincos.hpp"
#include "trueaxis/effect.hpp"

namespace trueaxis::kind {

/// Readings that a `fill` is given at most: its buffers lie on the stack, in the first cache.
inline constexpr std::size_t chunk_size = 256;
using Chunk = std::array<double, chunk_size>;
using Columns = std::span<double* const>;

/// What a term is linear in, in the order of its columns, and the shape parameters that it reads.
struct Parameters {
  std::vector<LinearParameter> linear = {};
  std::vector<std::string> shape = {};
};

/// The factors of cos and sin of a size.
inline void add_pair(std::string size, const std::string& unit, std::vector<LinearParameter>& to) {
  using Factor = LinearParameter::Factor;
  to.push_back({size + "_cos", unit, size, Factor::cosine});
  to.push_back({size + "_sin", unit, std::move(size), Factor::sine});
}
inline Parameters amplitude_pair(const std::string& unit, std::vector<std::string> shape = {}) {
  Parameters out{{}, std::move(shape)};
  add_pair("amplitude", unit, out.linear);
  return out;
}

inline Parameters parameters(const std::monostate&, const TermShape&) { return {}; }
inline std::size_t count(const std::monostate&, const TermShape&) { return 0; }
inline void fill(const std::monostate&, const TermContext&, const TermShape&, Columns) {}

// Functions of angle, Z and time: position_terms.cpp.
Parameters parameters(const Harmonic& term, const TermShape& shape);
Parameters parameters(const PolynomialInZ& term, const TermShape& shape);
Parameters parameters(const PeriodicInZ& term, const TermShape& shape);
Parameters parameters(const FormAtEnds& term, const TermShape& shape);
Parameters parameters(const PeriodicInTime& term, const TermShape& shape);
Parameters parameters(const GrowthInTime& term, const TermShape& shape);
void fill(const Harmonic& term, const TermContext& at, const TermShape& shape, Columns out);
void fill(const PolynomialInZ& term, const TermContext& at, const TermShape& shape, Columns out);
void fill(const PeriodicInZ& term, const TermContext& at, const TermShape& shape, Columns out);
void fill(const FormAtEnds& term, const TermContext& at, const TermShape& shape, Columns out);
void fill(const PeriodicInTime& term, const TermContext& at, const TermShape& shape, Columns out);
void fill(const GrowthInTime& term, const TermContext& at, const TermShape& shape, Columns out);

/// As many as `parameters` are linear, without their names.
std::size_t count(const Harmonic& term, const TermShape& shape);
std::size_t count(const PolynomialInZ& term, const TermShape& shape);
inline std::size_t count(const PeriodicInZ&, const TermShape&) { return 2; }
inline std::size_t count(const FormAtEnds&, const TermShape&) { return 2; }
inline std::size_t count(const PeriodicInTime&, const TermShape&) { return 2; }
inline std::size_t count(const GrowthInTime&, const TermShape&) { return 2; }

// What measures, and where the part is: measuring_terms.cpp.
Parameters parameters(const ArgumentShift& term, const TermShape& shape);
Parameters parameters(const ProbeLine& term, const TermShape& shape);
Parameters parameters(const Response& term, const TermShape& shape);
Parameters parameters(const PartStep& term, const TermShape& shape);
std::size_t count(const ArgumentShift& term, const TermShape& shape);
inline std::size_t count(const ProbeLine&, const TermShape&) { return 1; }
std::size_t count(const Response& term, const TermShape& shape);
inline std::size_t count(const PartStep& term, const TermShape&) { return term.seat ? 3 : 7; }
void fill(const ArgumentShift& term, const TermContext& at, const TermShape& shape, Columns out);
void fill(const ProbeLine& term, const TermContext& at, const TermShape& shape, Columns out);
void fill(const Response& term, const TermContext& at, const TermShape& shape, Columns out);
void fill(const PartStep& term, const TermContext& at, const TermShape& shape, Columns out);

}  // namespace trueaxis::kind

/// The contact, from X(C, Z) and its slopes alone: seen by the machine, the surface is a height X
/// over (Y, Z) whatever its kind. Its gradient along Y follows from turning it:
/// ∂X/∂C = Y + X ∂X/∂Y at Y = h, with x = X cos C − Y sin C. Columns over one chunk.
namespace trueaxis::contact {

using kind::Chunk;

/// sin and cos of an angle (rad) over the readings of `at`.
inline void sin_cos(const TermContext& at, const double* angle_rad, double* sine, double* cosine) {
  sincos({angle_rad, at.size()}, {sine, at.size()}, {cosine, at.size()});
}

/// Eq. 38.
inline void dx_dy(const TermContext& at, double* out) {
  if (at.face) {
    std::copy(at.dx_dy.begin(), at.dx_dy.end(), out);
    return;
  }
  for (std::size_t i = 0; i < at.size(); ++i) {
    out[i] = (at.dx_dc[i] - at.height_mm) / at.x_mm[i];
  }
}

/// `sign` times 1/|n_x| of the unit normal.
inline void secant(const TermContext& at, double sign, double* out) {
  dx_dy(at, out);
  for (std::size_t i = 0; i < at.size(); ++i) {
    out[i] = sign * std::sqrt(1.0 + out[i] * out[i] + at.dx_dz[i] * at.dx_dz[i]);
  }
}

/// Sign of X (a face: of Z) out of the material.
inline double away(const TermContext& at) { return at.rear == at.bore ? 1.0 : -1.0; }

/// Multiplies by dX/d(value of `port`). Form is positive away from the part's axis: at the rear
/// that is towards smaller X (Eqs. 37, 134).
inline void scale_by_dx_d(TermPort port, const TermContext& at, std::span<double* const> columns) {
  if (port == TermPort::reading || (port == TermPort::x && !at.face)) return;
  Chunk made;
  if (port == TermPort::normal) secant(at, at.rear ? -1.0 : 1.0, made.data());
  if (port == TermPort::x)
    std::transform(at.dx_dz.begin(), at.dx_dz.end(), made.begin(), std::negate<>());
  const bool axial = port == TermPort::z && at.face;  // the face comes by as much towards −Z
  if (axial) std::fill_n(made.begin(), at.size(), -1.0);
  const double* factor = port == TermPort::c             ? at.dx_dc.data()
                         : port == TermPort::z && !axial ? at.dx_dz.data()
                                                         : made.data();
  for (double* column : columns) {
    for (std::size_t i = 0; i < at.size(); ++i) column[i] *= factor[i];
  }
}

/// Position that a term along Z is written in: s for what the part has, Z for the machine.
inline std::span<const double> along_mm(TermPort port, const TermContext& at) {
  return port == TermPort::normal ? at.s_mm : at.z_mm;
}

/// s/s_end, s_end that of the outer end of what was probed.
inline void share_of_end(const TermContext& at, double* out) {
  const double end_mm = std::abs(at.z_mid_mm) + at.z_half_mm;
  for (std::size_t i = 0; i < at.size(); ++i) out[i] = at.s_mm[i] / end_mm;
}

/// u = (along − z_mid)/z_half.
inline void normalised(TermPort port, const TermContext& at, double* out) {
  const std::span<const double> along = along_mm(port, at);
  for (std::size_t i = 0; i < at.size(); ++i) out[i] = (along[i] - at.z_mid_mm) / at.z_half_mm;
}

}  // namespace trueaxis::contact

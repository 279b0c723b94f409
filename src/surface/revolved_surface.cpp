// SPDX-License-Identifier: Apache-2.0
#include "surface/revolved_surface.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "math/linear_algebra.hpp"

namespace trueaxis {
namespace {

constexpr std::array<std::string_view, 6> absolute_names{"x",       "y",      "slope_x",
                                                         "slope_y", "radius", "tan_half_angle"};
constexpr std::array<std::string_view, 3> section_names{"x", "y", "radius"};
constexpr std::array<std::string_view, 6> relative_names{"x",       "y",      "slope_x",
                                                         "slope_y", "offset", "tan_half_angle"};
constexpr std::array<std::string_view, 3> relative_section_names{"x", "y", "offset"};

}  // namespace

std::span<const std::string_view> RevolvedSurface::working_names() const {
  if (!tilts_) return relative() ? relative_section_names : section_names;
  const std::span<const std::string_view> all(relative() ? relative_names : absolute_names);
  return all.first(tapers_ ? 6 : 5);
}

std::vector<double> RevolvedSurface::working_scale_mm(std::span<const double> working) const {
  const double radius = std::max(std::abs(expand(working.data()).radius), 1e-6);
  std::vector<double> scale(parameter_count(), 1.0);
  if (tilts_) scale[2] = scale[3] = radius;
  if (tapers_) scale[5] = radius;
  return scale;
}

/// For a relative gauge: the radius that the ball's centre runs on, see expand().
double RevolvedSurface::nominal_path_radius(double tan_half_angle) const {
  return frame_.nominal_radius_mm +
         frame_.ball_mm * std::sqrt(1.0 + tan_half_angle * tan_half_angle);
}

/// Starting value of a relative gauge's offset; 0 for an absolute one.
double RevolvedSurface::gauge_shift(const ReadingBlock& readings, std::size_t count) const {
  if (!relative()) return 0.0;
  const double mean = std::accumulate(readings.reading_mm, readings.reading_mm + count, 0.0) /
                      static_cast<double>(count);
  return mean - (frame_.root == Root::front ? 1.0 : -1.0) * nominal_path_radius(0.0);
}

// The quadric |q|² = K s² + 2 t r s + r² with s = ζ + bx (x − x0) + by (y − y0), sorted by x, y and
// ζ. The axis' cosine is 1 here and x² bx² dropped. With β = bx x0 + by y0:
//   x² + y² = 2 (x0 + bx (t r − K β)) x + 2 (y0 + by (t r − K β)) y + 2 K bx xζ + 2 K by yζ
//             + r² − x0² − y0² − 2 t r β + K β² + 2 (t r − K β) ζ + t² ζ².
std::vector<double> RevolvedSurface::start(const ReadingBlock& readings, std::size_t count) const {
  const double shift = gauge_shift(readings, count);
  const double length = std::max(frame_.half_length_mm, 1e-9);
  const std::size_t unknowns = 3U + (tilts_ ? 2U : 0U) + (tapers_ ? 2U : 0U);
  double scale = 1e-12;  // the radius, so that all columns are of order one
  for (std::size_t i = 0; i < count; ++i) {
    scale = std::max(scale, std::abs(readings.reading_mm[i] - shift));
  }
  LaneSums sums;
  alignas(64) double column[8][block_size];
  const double* columns[8];
  for (std::size_t j = 0; j <= unknowns; ++j) columns[j] = column[j];
  for (std::size_t begin = 0; begin < count; begin += block_size) {
    const std::size_t filled = std::min(block_size, count - begin);
    for (std::size_t j = 0; j <= unknowns; ++j) std::fill_n(column[j], block_size, 0.0);
    for (std::size_t i = 0; i < filled; ++i) {
      const double reading = (readings.reading_mm[begin + i] - shift) / scale;
      const double x = reading * readings.cos_c[begin + i], y = reading * readings.sin_c[begin + i];
      const double zeta =
          tilts_ ? (readings.position_mm[begin + i] - frame_.position_ref_mm) / length : 0.0;
      const double row[7] = {x, y, 1.0, x * zeta, y * zeta, zeta, zeta * zeta};
      for (std::size_t j = 0; j < unknowns; ++j) column[j][i] = row[j];
      column[unknowns][i] = reading * reading;
    }
    add_products(columns, unknowns + 1, sums);
  }
  const auto n = static_cast<Eigen::Index>(unknowns);
  Eigen::MatrixXd normal(n, n);
  Eigen::VectorXd right(n);
  for (std::size_t j = 0; j < unknowns; ++j) {
    const auto row = static_cast<Eigen::Index>(j);
    for (std::size_t k = 0; k <= j; ++k) {
      normal(row, static_cast<Eigen::Index>(k)) = sums.sum(gram_index(j, k));
    }
    right(row) = sums.sum(gram_index(unknowns, j));
  }
  normal.diagonal() *= 1.0 + 1e-14;  // an undetermined direction then starts at zero
  normal.diagonal().array() += 1e-300;
  const Eigen::VectorXd c = linear::solve_normal(normal, right);

  const double mean_x = 0.5 * c(0) * scale, mean_y = 0.5 * c(1) * scale;
  const double k_bx = tilts_ ? 0.5 * c(3) * scale / length : 0.0;
  const double k_by = tilts_ ? 0.5 * c(4) * scale / length : 0.0;
  const auto or_scale = [&](double square) { return square > 0.0 ? std::sqrt(square) : scale; };
  double x0 = mean_x, y0 = mean_y, bx = k_bx, by = k_by, t = 0.0;
  double radius = or_scale(c(2) * scale * scale + x0 * x0 + y0 * y0);
  for (int round = 0; tapers_ && round < 6; ++round) {          // contracts by t·slope
    const double growth = 0.5 * c(5) * scale * scale / length;  // t r − K β
    t = (growth + k_bx * x0 + k_by * y0) / radius;
    const double k = 1.0 + t * t;
    bx = k_bx / k, by = k_by / k;
    x0 = mean_x - bx * growth, y0 = mean_y - by * growth;
    const double beta = bx * x0 + by * y0;
    radius = or_scale(c(2) * scale * scale + x0 * x0 + y0 * y0 + beta * (2.0 * growth + k * beta));
  }
  std::vector<double> working{x0, y0};
  if (tilts_) working.insert(working.end(), {bx, by});
  working.push_back(relative() ? shift : radius);
  if (tapers_) working.push_back(t);
  for (double& value : working) {
    if (!std::isfinite(value)) value = 0.0;
  }
  return working;
}

// The same without tilt, x² + y² = 2 x0 x + 2 y0 y + c0 + c1 ζ + t² ζ²; a cone that ends within the
// probed length is blunted, and the axis pulled in until the spindle axis runs inside.
std::vector<double> RevolvedSurface::level_start(const ReadingBlock& readings,
                                                 std::size_t count) const {
  const double shift = gauge_shift(readings, count);
  const double length = std::max(frame_.half_length_mm, 1e-9);
  const int columns = tapers_ ? 5 : 3;
  const auto n = static_cast<Eigen::Index>(count);
  Eigen::MatrixXd a(n, columns);
  Eigen::VectorXd b(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const double reading = readings.reading_mm[i] - shift;
    const double zeta = (readings.position_mm[i] - frame_.position_ref_mm) / length;
    a.row(i).head(3) << reading * readings.cos_c[i], reading * readings.sin_c[i], 1.0;
    if (tapers_) a.row(i).tail(2) << zeta, zeta * zeta;
    b(i) = reading * reading;
  }
  const Eigen::VectorXd c = linear::least_squares(a, b);
  double x = 0.5 * c(0), y = 0.5 * c(1);
  const double radius = relative() ? nominal_path_radius(0.0)
                                   : std::sqrt(std::max(c(2) + x * x + y * y, 1e-2 * b.maxCoeff()));
  const double widest = 0.9 * radius / length;
  const double t = tapers_ ? std::clamp(0.5 * c(3) / (length * radius), -widest, widest) : 0.0;
  const double inside = 0.8 * (radius - std::abs(t) * length) / std::max(std::hypot(x, y), 1e-300);
  x *= std::min(1.0, inside), y *= std::min(1.0, inside);
  std::vector<double> working{x, y};
  if (tilts_) working.insert(working.end(), 2, 0.0);
  working.push_back(relative() ? shift : radius);
  if (tapers_) working.push_back(t);
  return working;
}

bool RevolvedSurface::tilt_may_be_mirrored(std::span<const double> working) const {
  if (!tilts_) return false;
  const Revolved surface = probed(working);
  const double k = 1.0 + surface.tan_half_angle * surface.tan_half_angle;
  const double bend = k * surface.radius_mm * std::hypot(working[2], working[3]);
  return bend > 0.1 * frame_.half_length_mm;
}

Revolved RevolvedSurface::probed(std::span<const double> working) const {
  const std::size_t r = radius_index();
  const double t = tapers_ ? working[r + 1] : 0.0;
  return {axis(working), relative() ? nominal_path_radius(t) : working[r], t};
}

void RevolvedSurface::evaluate(std::span<const double> working, const ReadingBlock& readings,
                               PredictionBlock& out) const {
  const double offset = relative() ? working[radius_index()] : 0.0;
  evaluate_revolved(probed(working), frame_.root, offset, readings, out);
  if (relative()) std::fill_n(out.column[w_one], block_size, 1.0);
}

// dX/dp = −F_p / (2 √disc):  x: w Gx;  bx: w κ (D qx − D² bx s), κ = s + t r = K s + t r_ref;  r: w
// r;  t: w r s. With qx = Gx + D bx κ the slope column becomes D κ Gx + D² bx t κ r, and κ r = K r
// s + t r_ref r.
void RevolvedSurface::transform(std::span<const double> working, double* out) const {
  const std::size_t columns = column_count(), r = radius_index();
  std::fill_n(out, parameter_count() * columns, 0.0);
  const auto at = [&](std::size_t row, std::size_t column) -> double& {
    return out[row * columns + column];
  };
  at(0, w_gx) = 1.0;
  at(1, w_gy) = 1.0;
  if (relative()) {
    at(r, w_one) = 1.0;
  } else {
    at(r, w_r) = 1.0;
  }
  if (!tilts_) return;
  const Revolved surface = probed(working);
  const double t = surface.tan_half_angle, k = 1.0 + t * t;
  const double slope[2] = {surface.axis.slope_x, surface.axis.slope_y};
  const double d = 1.0 / std::sqrt(1.0 + slope[0] * slope[0] + slope[1] * slope[1]);
  for (std::size_t i = 0; i < 2; ++i) {
    at(2 + i, w_gx + i) = d * t * surface.radius_mm;
    at(2 + i, w_s_gx + i) = d * k;
    at(2 + i, w_r) = d * d * slope[i] * t * t * surface.radius_mm;
    at(2 + i, w_r_s) = d * d * slope[i] * t * k;
  }
  if (!tapers_) return;
  at(r + 1, w_r_s) = 1.0;
  if (relative()) at(r + 1, w_r) = frame_.ball_mm * t / std::sqrt(k);
}

Axis RevolvedSurface::axis(std::span<const double> working) const {
  return {working[0], working[1], tilts_ ? working[2] : 0.0, tilts_ ? working[3] : 0.0,
          frame_.position_ref_mm};
}

std::vector<double> RevolvedSurface::axis_jacobian(std::span<const double>) const {
  const std::size_t p = parameter_count();
  std::vector<double> jacobian(4 * p, 0.0);
  for (std::size_t i = 0; i < (tilts_ ? 4U : 2U); ++i) jacobian[i * p + i] = 1.0;
  return jacobian;
}

Revolved RevolvedSurface::shape(std::span<const double> working) const {
  const auto full = expand(working.data());
  return {axis(working), full.radius, full.tan};
}

Surface::Influences RevolvedSurface::influences(std::span<const double> working, double c_rad,
                                                double position_mm, double probe_height_mm) const {
  const Intersection at =
      intersect(probed(working), c_rad, position_mm, probe_height_mm, frame_.root);
  if (!at.hit) return {};
  return {(at.dx_dc - probe_height_mm) / at.x_mm, at.dx_dc, at.dx_dz};
}

}  // namespace trueaxis

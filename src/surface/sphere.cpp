// SPDX-License-Identifier: Apache-2.0
#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>

#include "math/linear_algebra.hpp"
#include "surface/catalogue.hpp"
#include "surface/revolved_surface.hpp"

namespace trueaxis {
namespace {

/// A ball with its centre at (x, y, z): a master ball on the spindle, the end of a ball-bar. Let e
/// be the probe line's direction in the part, a = e·(x, y), b = (−e_y, e_x)·(x, y), h = Z − z and
/// D² = R² − h² − b². The line meets it at X = a ± D, + in front (Eq. 301). R is that of the ball's
/// centre of the probe, from which its radius is subtracted.
class Sphere final : public Surface {
 public:
  explicit Sphere(const SurfaceFrame& frame)
      : frame_(frame), side_(frame.root == Root::front ? 1.0 : -1.0) {}

  std::size_t column_count() const override { return 4; }
  std::span<const std::string_view> working_names() const override {
    static constexpr std::array<std::string_view, 4> names{"x", "y", "z", "radius"};
    return names;
  }
  std::vector<double> working_scale_mm(std::span<const double>) const override {
    return {1.0, 1.0, 1.0, 1.0};
  }

  /// |p|² = 2 p·c + (R² − |c|²): linear in the centre and the bracket.
  std::vector<double> start(const ReadingBlock& readings, std::size_t count) const override {
    const auto n = static_cast<Eigen::Index>(count);
    Eigen::MatrixXd rows(n, 4);
    Eigen::VectorXd square(n);
    for (Eigen::Index i = 0; i < n; ++i) {
      const double x = readings.reading_mm[i] * readings.cos_c[i];
      const double y = readings.reading_mm[i] * readings.sin_c[i];
      const double z = readings.position_mm[i] - frame_.position_ref_mm;
      rows.row(i) << 2.0 * x, 2.0 * y, 2.0 * z, 1.0;
      square(i) = x * x + y * y + z * z;
    }
    const Eigen::Vector4d c = linear::pivoted_least_squares(rows, square);
    const double radius = std::sqrt(std::max(0.0, c(3) + c.head<3>().squaredNorm()));
    return {c(0), c(1), c(2) + frame_.position_ref_mm, radius};
  }

  void evaluate(std::span<const double> w, const ReadingBlock& readings,
                PredictionBlock& out) const override {
    out.valid = true;
    for (std::size_t i = 0; i < block_size; ++i) {
      const double c = readings.cos_c[i], s = readings.sin_c[i];
      const Meeting at = meet(w, c, s, readings.position_mm[i]);
      out.valid = out.valid && at.depth_mm > 0.0;
      out.residual[i] = readings.reading_mm[i] - at.x_mm;
      const double across = at.across_mm / at.depth_mm;
      out.column[0][i] = c + across * s;
      out.column[1][i] = s - across * c;
      out.column[2][i] = at.height_mm / at.depth_mm;
      out.column[3][i] = w[3] / at.depth_mm;
    }
    if (side_ < 0.0)
      for (std::size_t i = 0; i < block_size; ++i) {
        out.column[0][i] = 2.0 * readings.cos_c[i] - out.column[0][i];
        out.column[1][i] = 2.0 * readings.sin_c[i] - out.column[1][i];
        out.column[2][i] = -out.column[2][i];
        out.column[3][i] = -out.column[3][i];
      }
  }
  void transform(std::span<const double>, double* out) const override {
    std::fill_n(out, 16, 0.0);
    out[0] = out[5] = out[10] = out[15] = 1.0;
  }

  Reported report(std::span<const double> working) const override {
    return differentiate<4>(working, 4, [this](const auto* w, auto* out) {
      for (std::size_t i = 0; i < 3; ++i) out[i] = w[i];
      out[3] = w[3] - frame_.ball_mm;
    });
  }
  /// Through the centre, along the spindle: a ball has no direction.
  Axis axis(std::span<const double> w) const override { return {w[0], w[1], 0.0, 0.0, w[2]}; }
  std::vector<double> axis_jacobian(std::span<const double>) const override {
    std::vector<double> jacobian(16, 0.0);
    jacobian[0] = jacobian[5] = 1.0;
    return jacobian;
  }
  /// The cylinder about its equator.
  Revolved shape(std::span<const double> w) const override {
    return {axis(w), w[3] - frame_.ball_mm, 0.0};
  }
  Influences influences(std::span<const double> w, double c_rad, double position_mm,
                        double) const override {
    const Meeting at = meet(w, std::cos(c_rad), std::sin(c_rad), position_mm);
    if (!(at.depth_mm > 0.0)) return {};
    const double slope = side_ / at.depth_mm;
    return {slope * at.across_mm, slope * at.across_mm * at.x_mm, -slope * at.height_mm};
  }

 private:
  struct Meeting {
    double x_mm, across_mm, height_mm, depth_mm;  ///< X, b, h, D; D is NaN where it is missed
  };
  Meeting meet(std::span<const double> w, double c, double s, double z_mm) const {
    const double along = w[0] * c + w[1] * s, across = w[1] * c - w[0] * s, height = z_mm - w[2];
    const double depth = std::sqrt(w[3] * w[3] - height * height - across * across);
    return {along + side_ * depth, across, height, depth};
  }

  SurfaceFrame frame_;
  double side_;
};

}  // namespace

CatalogueEntry sphere_entry() {
  return entry_of<Sphere>({SurfaceKind::sphere,
                           "sphere",
                           "sphere: a master ball",
                           StreamKind::lateral,
                           true,
                           {"x0", "y0", "z0", "radius"},
                           {"mm", "mm", "mm", "mm"}});
}

}  // namespace trueaxis

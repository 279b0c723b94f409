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

/// Face n·p = d with cosines l, m, n > 0, probed in Z at (C, X): Z = c + px X cos C + py X sin C,
/// linear in the working parameters c (mm), px, py. Normal ∝ (−px, −py, 1); l = −px n, m = −py n, d
/// = c n (Eq. 11).
class Plane final : public Surface {
 public:
  explicit Plane(const SurfaceFrame& frame) : frame_(frame) {}

  std::size_t column_count() const override { return 3; }
  std::span<const std::string_view> working_names() const override {
    static constexpr std::array<std::string_view, 3> names{"height", "slope_x", "slope_y"};
    return names;
  }
  std::vector<double> working_scale_mm(std::span<const double>) const override {
    const double reach = std::max(std::abs(frame_.position_ref_mm) + frame_.half_length_mm, 1e-6);
    return {1.0, reach, reach};
  }

  std::vector<double> start(const ReadingBlock& readings, std::size_t count) const override {
    const auto n = static_cast<Eigen::Index>(count);
    const double reach = working_scale_mm({})[1];
    Eigen::MatrixXd a(n, 3);
    for (Eigen::Index i = 0; i < n; ++i) {
      const double x = readings.position_mm[i] / reach;
      a.row(i) << 1.0, x * readings.cos_c[i], x * readings.sin_c[i];
    }
    const Eigen::Map<const Eigen::VectorXd> b(readings.reading_mm, n);
    const Eigen::Vector3d c = linear::pivoted_least_squares(a, Eigen::VectorXd(b));
    return {c(0), c(1) / reach, c(2) / reach};
  }

  void evaluate(std::span<const double> w, const ReadingBlock& readings,
                PredictionBlock& out) const override {
    for (std::size_t i = 0; i < block_size; ++i) {
      const double x = readings.position_mm[i] * readings.cos_c[i];
      const double y = readings.position_mm[i] * readings.sin_c[i];
      out.column[0][i] = 1.0;
      out.column[1][i] = x;
      out.column[2][i] = y;
      out.residual[i] = readings.reading_mm[i] - (w[0] + w[1] * x + w[2] * y);
    }
    out.valid = true;
  }

  void transform(std::span<const double>, double* out) const override {
    std::fill_n(out, 9, 0.0);
    out[0] = out[4] = out[8] = 1.0;
  }

  Reported report(std::span<const double> working) const override {
    return differentiate<3>(working, 3, [this](const auto* w, auto* out) {
      using std::sqrt;
      const auto n = 1.0 / sqrt(1.0 + w[1] * w[1] + w[2] * w[2]);
      out[0] = -w[1] * n;
      out[1] = -w[2] * n;
      out[2] =
          w[0] * n - frame_.ball_mm;  // the ball's centre is r_b above the plane along the normal
    });
  }

  Axis axis(std::span<const double> w) const override { return {0.0, 0.0, -w[1], -w[2], 0.0}; }
  std::vector<double> axis_jacobian(std::span<const double>) const override {
    return {0, 0, 0, 0, 0, 0, 0, -1, 0, 0, 0, -1};
  }
  Revolved shape(std::span<const double> w) const override {
    return {{0.0, 0.0, -w[1], -w[2], w[0]}, 0.0, 0.0};
  }

  Influences influences(std::span<const double> w, double c_rad, double position_mm,
                        double) const override {
    const double across = -w[1] * std::sin(c_rad) + w[2] * std::cos(c_rad);
    return {across, position_mm * across, w[1] * std::cos(c_rad) + w[2] * std::sin(c_rad)};
  }

 private:
  SurfaceFrame frame_;
};

}  // namespace

CatalogueEntry plane_entry() {
  return entry_of<Plane>({SurfaceKind::plane,
                          "plane",
                          "face, n·p = d",
                          StreamKind::face,
                          true,
                          {"l", "m", "d"},
                          {"1", "1", "mm"}});
}

}  // namespace trueaxis
